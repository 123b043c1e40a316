#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>

namespace vdbcage::detail {

namespace {

/// Returns whether four polygons would be around the quad, and the ends of its diagonal keep three edges.
bool fits(const GuardedMesh& surface, std::uint32_t f, std::uint32_t g)
{
    std::vector<std::uint32_t> around;
    for (const std::uint32_t half : {f, g}) {
        for (int i = 0; i < 3; ++i) {
            const std::uint32_t h = faceAcross(surface, half, i);
            if (h == half) {
                around.push_back(GuardedMesh::none); // across the plane of symmetry, its own image
            } else if (h != f && h != g) {
                around.push_back(polygonOf(surface, h));
            }
        }
    }
    std::sort(around.begin(), around.end());
    if (around.size() != 4 || std::adjacent_find(around.begin(), around.end()) != around.end()) return false;
    const Vec4I ids = surface.quadOf(f, g);
    for (const int end : {0, 2}) {
        std::set<std::uint32_t> polygons;
        for (const std::uint32_t h : surface.facesOf(ids[end])) polygons.insert(polygonOf(surface, h));
        const std::size_t sides = surface.isOnPlane(ids[end]) ? 2 : 1;
        if (sides * (polygons.size() - 1) < 3) return false; // one edge less afterwards
    }
    return true;
}

bool moveBy(GuardedMesh& surface, std::uint32_t v, const Vec3d& by)
{
    const StarChange star = starOf(surface, v);
    const Vec3d target = rounded(surface, star, surface.point(v) + by);
    if (!allows(surface, star, target)) return false;
    surface.apply(star, target);
    return true;
}

} // namespace

bool mergeTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g)
{
    if (!fits(surface, f, g)) return false;
    if (makeQuad(surface, f, g)) return true;
    const Vec4I ids = surface.quadOf(f, g);
    const auto corners = pointsOf(surface, ids);
    Vec3d outward = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    if (!outward.normalize(0)) return false;
    const double height = outward.dot(corners[0] - corners[1]); // of the first diagonal above the other
    const std::size_t end = height > 0 ? 1 : 0;
    const auto vertex = [&](std::size_t i) { return ids[static_cast<int>(i)]; };
    for (const double share : {0.25, 0.5, 0.75, 1.0}) {
        // Where the diagonals almost meet, the push is more than rounding takes away.
        const Vec3d push = share * (std::abs(height) + surface.guard().clearance()) * outward;
        if (!moveBy(surface, vertex(end), push)) continue;
        if (moveBy(surface, vertex(end + 2), push)) {
            if (makeQuad(surface, f, g)) return true;
            surface.apply(starOf(surface, vertex(end + 2)), corners[end + 2]);
        }
        surface.apply(starOf(surface, vertex(end)), corners[end]);
    }
    return false;
}

} // namespace vdbcage::detail
