#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include <vdbcage/bounding/fit.h>

/// The options of the commands that fit cages.
namespace vdbcage::cli {

/// The values of these options.
struct FitArguments {
    FitOptions options;
    std::string keep;             ///< "points:" and a list, or the name of a file that has one; empty: no point stays
    std::string symmetry = "off"; ///< or the axis across which the plane is: x, y or z
    std::string place;            ///< "box" or "turn"; empty: the cage is where it is to be
};

/// The points that --keep names.
struct KeptPoints {
    std::vector<std::size_t> numbers;    ///< of those that stay
    std::vector<FitOptions::Rail> rails; ///< the others

    /// Returns the greatest number; 0 if there is none.
    std::size_t greatest() const;
};

/// Gives --place in a command line its value, which may be left out: "turn" if that follows, else "box". A file that
/// follows is none.
std::vector<std::string> withPlaceValue(std::vector<std::string> words);

/// Adds the options of fits, which set `arguments`, and returns them. Both must outlive parsing.
std::vector<CLI::Option*> addFitOptions(CLI::App& app, FitArguments& arguments);

/// Refuses values that are not allowed. Reads no file. \throw InputError
void requireValid(const FitArguments& arguments);

/// Returns all files that are named.
std::vector<std::filesystem::path> filesOf(const FitArguments& arguments);

/// Returns the points that --keep names, itself or in a file. \throw InputError, IoError
KeptPoints keptPoints(const FitArguments& arguments);

} // namespace vdbcage::cli
