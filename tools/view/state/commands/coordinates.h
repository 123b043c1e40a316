#pragma once

#include <tools/view/state/commands/line.h>
#include <tools/view/state/commands/situation.h>
#include <vdbcage/core/detail/joined.h>

/// Commands that choose how the model follows the cage.
namespace vdbcage::view {

/// Returns the names of all families, with bars between them.
inline std::string familyWords()
{
    return vdbcage::detail::joined(coordinateFamilies(), "|", [](const FamilyInfo& family) { return family.name; });
}

struct SetCoordinates {
    Coordinates family{}; ///< one of coordinateFamilies()

    static LineInfo info() { return {"coordinates", familyWords(), 1, 1, "chooses how the model follows the cage"}; }
    static SetCoordinates read(const Arguments& arguments) { return {coordinatesNamed(arguments[0])}; }
    std::string text() const { return written(coordinatesName(family)); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        document.coordinates = family;
        document.weights.reset();
    }
};

struct OpenWeights {
    std::string path;

    static LineInfo info()
    {
        return {"open-weights", "FILE", 1, 1,
                "the model follows the cage by weights of vdbcage bind or of others (.npy, .dmat: points x points of "
                "the cage)"};
    }
    static OpenWeights read(const Arguments& arguments) { return {arguments[0]}; }
    std::string text() const { return written(path); }
    void apply(Document& document, const Situation& /*now*/) const
    {
        document.weights = openWeights(path);
        document.coordinates = Coordinates::given;
    }
};

/// The material of Somigliana coordinates.
struct SetMaterial {
    Elasticity elasticity;

    static LineInfo info()
    {
        return {"material", "NU global|local LOCAL GLOBAL", 4, 4,
                "chooses for somigliana: Poisson's ratio, what turns, local and global bulging"};
    }
    static SetMaterial read(const Arguments& arguments)
    {
        Elasticity elasticity;
        elasticity.nu = numberOf(arguments[0], "nu");
        elasticity.rotations = rotationsNamed(arguments[1]);
        elasticity.localBulging = numberOf(arguments[2], "local bulging");
        elasticity.globalBulging = numberOf(arguments[3], "global bulging");
        requireElasticity(elasticity);
        return {elasticity};
    }
    std::string text() const
    {
        return written(elasticity.nu, rotationsName(elasticity.rotations), elasticity.localBulging,
                       elasticity.globalBulging);
    }
    void apply(Document& document, const Situation& /*now*/) const { document.elasticity = elasticity; }
};

} // namespace vdbcage::view
