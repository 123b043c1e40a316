#include <vdbcage/bounding/detail/quads/pairing/collapse_triangles.h>

#include <algorithm>
#include <array>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>

namespace vdbcage::detail {

namespace {

using Faces = std::array<std::uint32_t, 2>; // of a quad

std::vector<Faces> splitQuadsAt(GuardedMesh& surface, const Faces& vertices)
{
    std::vector<Faces> quads;
    for (const std::uint32_t v : vertices) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            if (!surface.isInQuad(f)) continue;
            quads.push_back({f, surface.partnerOf(f)});
            surface.splitQuad(f);
        }
    }
    return quads;
}

} // namespace

bool collapseTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g)
{
    const Vec4I ids = surface.quadOf(f, g);
    const std::uint32_t keep = std::min(ids[0], ids[2]), remove = std::max(ids[0], ids[2]);
    const std::vector<Faces> quads = splitQuadsAt(surface, {keep, remove});
    StarChange star;
    if (!starOfCollapse(surface, keep, remove, star)) return false;
    const Vec3d a = surface.point(keep), b = surface.point(remove), middle = 0.5 * (a + b);
    const Vec3d up = outward(surface, star) * (a - b).length();
    const GuardedMesh before = surface;
    for (const Vec3d& at :
         {middle, a, b, middle + 0.1 * up, a + 0.1 * up, b + 0.1 * up, middle + 0.3 * up, middle + 0.6 * up}) {
        const Vec3d place = rounded(surface, star, at);
        if (!allows(surface, star, place)) continue;
        surface.apply(star, place);
        const auto merge = [&](const Faces& quad) { return mergeTriangles(surface, quad[0], quad[1]); };
        if (std::all_of(quads.begin(), quads.end(), merge)) return true;
        surface = before;
    }
    return false;
}

} // namespace vdbcage::detail
