#include "coordinate_arguments.h"

#include <vdbcage/core/error.h>

namespace vdbcage::tool {

namespace {

/// "FAMILY is one of mvc (qmvc), green (qgc), mlc, harmonic"
std::string familyHelp()
{
    std::string text = "\nFAMILY is one of ";
    for (const FamilyInfo& family : coordinateFamilies()) {
        text += family.name;
        if (family.nameOnQuads != std::string(family.name)) text += std::string(" (") + family.nameOnQuads + ")";
        text += &family == &coordinateFamilies().back() ? "\n" : ", ";
    }
    return text;
}

} // namespace

CoordinateArguments::CoordinateArguments(CLI::App& app, const std::string& purpose)
    : resolution_(CoordinateOptions(Coordinates::harmonic).resolution),
      familyOption_(app.add_option("--coordinates", family_, purpose + " [mvc]")->type_name("FAMILY")),
      resolutionOption_(app.add_option("--resolution", resolution_,
                                       "voxels along the cage, of harmonic [" + std::to_string(resolution_) + "]")
                            ->type_name("N"))
{
    app.footer(familyHelp());
}

int CoordinateArguments::resolution() const
{
    requireWithin(CoordinateOptions::resolutions, resolution_, "resolution");
    return resolution_;
}

CoordinateOptions CoordinateArguments::options() const
{
    const CoordinateOptions options(coordinatesNamed(family_), resolution());
    if (resolutionOption_->count() > 0 && options.family != Coordinates::harmonic) {
        throw InputError("resolution: only harmonic coordinates have one; --coordinates is " + family_);
    }
    return options;
}

} // namespace vdbcage::tool
