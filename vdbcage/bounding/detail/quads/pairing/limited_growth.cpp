#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>

#include <utility>

namespace vdbcage::detail {

double enclosedVolume(const GuardedMesh& surface)
{
    const auto& plane = surface.guard().symmetry();
    const Vec3d apex = plane ? surface.ontoPlane(Vec3d(0.0)) : Vec3d(0.0); // half a surface is open there
    const auto below = [&](std::uint32_t f) {
        const Corners t = surface.corners(f);
        return (t[0] - apex).dot((t[1] - apex).cross(t[2] - apex)) / 6;
    };
    double sum = 0;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (!surface.isFace(f)) continue;
        sum += surface.weight(f) * below(f);
        if (!surface.isInQuad(f)) continue;
        for (const std::uint32_t other : surface.alternatesIn(f)) sum += 0.25 * below(other); // from each half
    }
    return sum;
}

bool changeWithin(GuardedMesh& surface, double maxGrowth, const std::function<bool()>& change)
{
    GuardedMesh before = surface;
    const double volume = enclosedVolume(surface);
    if (change() && !(enclosedVolume(surface) - volume > maxGrowth)) return true;
    surface = std::move(before);
    return false;
}

} // namespace vdbcage::detail
