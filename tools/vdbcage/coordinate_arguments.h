#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <vdbcage/deform/binding.h>

namespace vdbcage::tool {

/// The options --coordinates and --resolution of the commands that bind.
class CoordinateArguments {
public:
    /// `purpose` is the help: what the coordinates are for. Must outlive parsing.
    explicit CoordinateArguments(CLI::App& app, const std::string& purpose = "how the cage moves the model");

    bool familyIsGiven() const { return familyOption_->count() > 0; }
    const std::string& familyName() const { return family_; }
    /// \throw InputError out of range
    int resolution() const;
    /// \throw InputError no such family; a resolution out of range, or of a family that has none
    CoordinateOptions options() const;

private:
    std::string family_ = "mvc";
    int resolution_;
    CLI::Option *familyOption_, *resolutionOption_;
};

} // namespace vdbcage::tool
