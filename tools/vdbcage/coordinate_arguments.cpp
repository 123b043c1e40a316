#include "coordinate_arguments.h"

#include <vdbcage/core/error.h>

namespace vdbcage::tool {

namespace {

/// "mvc (qmvc), green (qgc), mlc or harmonic [mvc]"
std::string familyHelp()
{
    const std::vector<FamilyInfo>& families = coordinateFamilies();
    std::string text;
    for (std::size_t i = 0; i < families.size(); ++i) {
        const std::string name = families[i].name, onQuads = families[i].nameOnQuads;
        text += (i == 0 ? "" : i + 1 < families.size() ? ", " : " or ") + name;
        if (onQuads != name) text += " (" + onQuads + ")";
    }
    return text + " [mvc]";
}

} // namespace

CoordinateArguments::CoordinateArguments(CLI::App& app, const std::string& purpose)
    : resolution_(CoordinateOptions(Coordinates::harmonic).resolution),
      familyOption_(app.add_option("--coordinates", family_, purpose + familyHelp())->type_name("FAMILY")),
      resolutionOption_(app.add_option("--resolution", resolution_,
                                       "voxels along the cage, of harmonic [" + std::to_string(resolution_) + "]")
                            ->type_name("N"))
{
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
