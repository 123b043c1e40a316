#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <vdbcage/deform/binding.h>

namespace vdbcage::cli {

/// The options of the commands that bind: --coordinates and --resolution. Commands that pose also have the options of
/// an elastic material.
class CoordinateArguments {
public:
    enum class For { weights, poses };

    /// `purpose` is the help: the use of the coordinates. It must outlive parsing.
    explicit CoordinateArguments(CLI::App& app, For use, const std::string& purpose = "how the cage moves the model");

    bool familyIsGiven() const { return familyOption_->count() > 0; }
    bool resolutionIsGiven() const { return resolutionOption_->count() > 0; }
    const std::string& familyName() const { return family_; }
    /// Returns the chosen options. \throw InputError no such family; an option out of range, or of a family that has
    /// none
    CoordinateOptions options() const;
    /// Returns the same for another family than --coordinates.
    CoordinateOptions optionsOf(Coordinates family) const;
    /// Returns the same for any of all families, which may lack some of the options.
    /// \throw InputError an option out of range
    CoordinateOptions optionsOfEach(Coordinates family) const;

private:
    std::string family_ = "mvc", rotations_ = "global", loose_ = "ride";
    int resolution_;
    Elasticity elasticity_;
    CLI::Option *familyOption_, *resolutionOption_;
    std::vector<CLI::Option*> elasticOptions_;
};

} // namespace vdbcage::cli
