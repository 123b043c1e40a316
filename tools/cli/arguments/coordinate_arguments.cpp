#include <tools/cli/arguments/coordinate_arguments.h>

#include <vdbcage/core/error.h>

namespace vdbcage::cli {

namespace {

/// Returns a text such as "FAMILY is one of mvc (qmvc), green (qgc), mlc, harmonic".
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

/// Returns the families that have the property: "harmonic", "a, b".
std::string namesOf(bool FamilyInfo::*has)
{
    std::string names;
    for (const FamilyInfo& family : coordinateFamilies()) {
        if (family.*has) names += (names.empty() ? "" : ", ") + std::string(family.name);
    }
    return names;
}

} // namespace

CoordinateArguments::CoordinateArguments(CLI::App& app, For use, const std::string& purpose)
    : resolution_(CoordinateOptions(coordinatesNamed(family_)).resolution),
      familyOption_(app.add_option("--coordinates", family_, purpose + " [mvc]")->type_name("FAMILY")),
      resolutionOption_(app.add_option("--resolution", resolution_,
                                       "of " + namesOf(&FamilyInfo::hasResolution) + ": voxels along the cage [" +
                                           std::to_string(resolution_) + "]")
                            ->type_name("N"))
{
    app.add_option("--loose", loose_, "points that no face uses [ride]")->type_name("ride|stay");
    app.footer(familyHelp());
    if (use == For::weights) return;
    const std::string of = "of " + namesOf(&FamilyInfo::hasElasticity) + ": ";
    const auto add = [&](const char* name, auto& value, const std::string& help, const char* type) {
        elasticOptions_.push_back(app.add_option(name, value, of + help)->type_name(type));
    };
    const std::string bulgings = ", " + toText(Elasticity::bulgings) + " [0]";
    add("--nu", elasticity_.nu, "Poisson's ratio in (-1, 0.5) [0]", "NU");
    add("--rotations", rotations_, "how they are found [global]", "global|local");
    add("--local-bulging", elasticity_.localBulging, "where it curves" + bulgings, "N");
    add("--global-bulging", elasticity_.globalBulging, "where it moves out" + bulgings, "N");
}

CoordinateOptions CoordinateArguments::options() const
{
    return optionsOf(coordinatesNamed(family_));
}

CoordinateOptions CoordinateArguments::optionsOf(Coordinates family) const
{
    const CoordinateOptions options = optionsOfEach(family);
    const auto requireFor = [&](const CLI::Option* option, bool FamilyInfo::*has) {
        if (option->count() == 0 || familyInfo(family).*has) return;
        throw InputError(option->get_lnames().front(),
                         "only " + namesOf(has) + " coordinates have it; these are " + coordinatesName(family));
    };
    requireFor(resolutionOption_, &FamilyInfo::hasResolution);
    for (const CLI::Option* option : elasticOptions_) requireFor(option, &FamilyInfo::hasElasticity);
    return options;
}

CoordinateOptions CoordinateArguments::optionsOfEach(Coordinates family) const
{
    requireWithin(CoordinateOptions::resolutions, resolution_, "resolution");
    CoordinateOptions options(family, resolution_);
    options.elasticity = elasticity_;
    options.elasticity.rotations = rotationsNamed(rotations_);
    options.loose.motion = looseMotionNamed(loose_);
    requireElasticity(options.elasticity);
    return options;
}

} // namespace vdbcage::cli
