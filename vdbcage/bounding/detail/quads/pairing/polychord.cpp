// Based on: Daniels, Silva, Shepherd, Cohen, "Quadrilateral Mesh Simplification", 2008 (polychords).
// Differs: here they begin and end at triangles, and are split.

#include <vdbcage/bounding/detail/quads/pairing/polychord.h>

#include <set>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>

namespace vdbcage::detail {

namespace {

/// Returns a vector from a face's side, from a to b, away from the face, half as long as the side: between the planes
/// of both faces where they meet in a ridge, along the next face in a valley.
Vec3d asideOf(const GuardedMesh& surface, std::uint32_t f, std::uint32_t next, std::uint32_t a, std::uint32_t b)
{
    const Vec3d along = surface.point(b) - surface.point(a);
    const Vec3d normal = areaNormal(surface, next);
    Vec3d over = along.cross(areaNormal(surface, f)), into = along.cross(normal);
    if (!over.normalize(0) || !into.normalize(0)) return Vec3d(0.0);
    Vec3d direction = over.dot(normal) > 0 ? over + into : into;
    if (!direction.normalize(0)) return Vec3d(0.0);
    return 0.5 * along.length() * direction;
}

constexpr std::array heights{0.0, 0.03, 0.1, 0.3}; // for places that may be too near, in parts of a side

/// Splits side i and merges the triangles before it. \pre the quads are split, and the sides before this one
bool splitSide(GuardedMesh& surface, const Polychord& polychord, std::size_t i, double push)
{
    const auto merge = [&](std::uint32_t f, std::uint32_t g) { return mergeTriangles(surface, f, g); };
    const auto at = [&](std::uint32_t from, std::uint32_t to) { return faceAt(surface, from, to); };
    const auto [a, b] = polychord.sides[i];
    const std::uint32_t behind = at(a, b), ahead = at(b, a);
    const bool isFirst = i == 0, isLast = i == polychord.quads.size(), onPlane = ahead == GuardedMesh::none;
    // The new vertex replaces the part before the side and the whole face after it.
    StarChange::Faces faces{behind};
    if (!isLast) {
        faces.insert(faces.end(), polychord.quads[i].begin(), polychord.quads[i].end());
    } else if (!onPlane) {
        faces.push_back(ahead);
    }
    Vec3d middle = 0.5 * (surface.point(a) + surface.point(b));
    if (isFirst && !onPlane) middle += push * asideOf(surface, behind, ahead, a, b);
    if (isLast && !onPlane) middle += push * asideOf(surface, ahead, behind, b, a);
    const std::uint32_t first = cornerOpposite(surface, behind, a, b);
    const std::uint32_t last = onPlane ? GuardedMesh::none : cornerOpposite(surface, ahead, b, a);
    StarChange star;
    if (!starOfFaces(surface, faces, onPlane, star)) return false;
    if (!applyNear(surface, star, middle, (surface.point(a) - surface.point(b)).length(), heights)) return false;
    if (isFirst) {
        if (!merge(at(b, first), at(first, a))) return false;
    } else {
        const auto [c, d] = polychord.sides[i - 1];
        if (!merge(at(c, a), at(a, star.centre))) return false;
        if (!merge(at(star.centre, b), at(b, d))) return false;
    }
    return !isLast || onPlane || merge(at(a, last), at(last, b));
}

} // namespace

std::optional<Polychord> polychordFrom(const GuardedMesh& surface, std::uint32_t triangle, int i, std::size_t maxQuads)
{
    const Vec3I& t = surface.face(triangle);
    Polychord polychord{{{t[i], t[(i + 1) % 3]}}, {}};
    std::set<std::uint32_t> passed{triangle};
    for (;;) {
        const auto [a, b] = polychord.sides.back();
        const std::uint32_t next = faceAt(surface, b, a);
        if (next == GuardedMesh::none) return polychord; // the plane
        if (!passed.insert(polygonOf(surface, next)).second) return std::nullopt;
        if (!surface.isInQuad(next)) return polychord;
        if (polychord.quads.size() == maxQuads) return std::nullopt;
        const std::uint32_t other = surface.partnerOf(next);
        const Vec4I ids = surface.quadOf(next, other);
        int side = 0;
        while (ids[side] != b) ++side;
        polychord.quads.push_back({next, other});
        polychord.sides.push_back({ids[(side + 2) % 4], ids[(side + 3) % 4]});
    }
}

bool splitPolychord(GuardedMesh& surface, const Polychord& polychord, double maxGrowth)
{
    for (const double push : {0.3, 0.6, 1.0}) { // corners of 147, 118, and 90 degrees
        const bool isDone = changeWithin(surface, maxGrowth, [&] {
            for (const auto& quad : polychord.quads) surface.splitQuad(quad[0]);
            for (std::size_t i = 0; i < polychord.sides.size(); ++i) {
                if (!splitSide(surface, polychord, i, push)) return false;
            }
            return true;
        });
        if (isDone) return true;
    }
    return false;
}

} // namespace vdbcage::detail
