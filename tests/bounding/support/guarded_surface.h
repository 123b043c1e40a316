#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/mesh/mesh.h>

/// What surfaces under a guard hold, looked up face by face: no list of theirs is trusted.
namespace vdbcage::test {

inline openvdb::Vec3d randomVector(std::mt19937& random, double size = 1)
{
    std::uniform_real_distribution<double> coordinate(-size, size);
    const double x = coordinate(random), y = coordinate(random);
    return {x, y, coordinate(random)};
}

/// Returns a triangle with its corners in a cube about `centre`, of sides of twice the size.
inline detail::Corners randomTriangle(std::mt19937& random, double size, const openvdb::Vec3d& centre)
{
    const openvdb::Vec3d a = randomVector(random, size), b = randomVector(random, size);
    return {centre + a, centre + b, centre + randomVector(random, size)};
}

/// Returns the point of the model nearest to p, in the guard's units.
inline openvdb::Vec3d closestByAll(const detail::GuardModel& guard, const openvdb::Vec3d& p)
{
    openvdb::Vec3d closest(1e9);
    for (const detail::TriangleBvh::Item& item : guard.tree().items()) {
        const openvdb::Vec3d there = detail::closestPointOnTriangle(p, guard.tree().corners(item));
        if ((there - p).lengthSqr() < (closest - p).lengthSqr()) closest = there;
    }
    return closest;
}

inline double distanceByAll(const detail::GuardModel& guard, const openvdb::Vec3d& p)
{
    return (closestByAll(guard, p) - p).length();
}

/// The numbers of all faces that live, and of the alternates.
inline std::vector<std::uint32_t> facesAndAlternates(const detail::GuardedMesh& surface)
{
    std::vector<std::uint32_t> list;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (surface.isFace(f) || surface.isInQuad(f)) list.push_back(f);
    }
    return list;
}

inline bool hasCorner(const openvdb::Vec3I& t, std::uint32_t v)
{
    return t[0] == v || t[1] == v || t[2] == v;
}

/// The faces as triangles, by the numbers that the surface has for its vertices, in the guard's units. Points that no
/// face uses are among them.
inline Mesh triangleMesh(const detail::GuardedMesh& surface)
{
    Mesh mesh;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) mesh.points.push_back(surface.point(v));
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (surface.isFace(f)) mesh.triangles.push_back(surface.face(f));
    }
    return mesh;
}

/// The other corners of the faces and alternates at v, ascending.
inline std::vector<std::uint32_t> neighboursByFaces(const detail::GuardedMesh& surface, std::uint32_t v)
{
    std::set<std::uint32_t> found;
    for (const std::uint32_t f : facesAndAlternates(surface)) {
        const openvdb::Vec3I& t = surface.face(f);
        if (!hasCorner(t, v)) continue;
        for (int i = 0; i < 3; ++i) {
            if (t[i] != v) found.insert(t[i]);
        }
    }
    return {found.begin(), found.end()};
}

/// Whether vertices have the faces and alternates that have them, each once, and the counts are right.
inline bool listsAreRight(const detail::GuardedMesh& surface)
{
    using Numbers = std::vector<std::uint32_t>;
    std::vector<Numbers> faces(surface.vertices()), alternates(surface.vertices());
    std::size_t live = 0, inQuads = 0;
    for (const std::uint32_t f : facesAndAlternates(surface)) {
        live += surface.isFace(f);
        inQuads += surface.isFace(f) && surface.isInQuad(f);
        for (int i = 0; i < 3; ++i) (surface.isFace(f) ? faces : alternates)[surface.face(f)[i]].push_back(f);
    }
    const auto sorted = [](const auto& list) {
        Numbers numbers(list.begin(), list.end());
        std::sort(numbers.begin(), numbers.end());
        return numbers;
    };
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (sorted(surface.facesOf(v)) != faces[v] || sorted(surface.alternatesOf(v)) != alternates[v]) return false;
    }
    return surface.liveFaces() == live && 2 * surface.quads() == inQuads;
}

/// Whether the tree finds every face and alternate in its box, and nothing that is gone.
inline bool treeIsRight(const detail::GuardedMesh& surface)
{
    std::size_t seen = 0;
    constexpr double far = 1e9;
    const auto isThere = [&](std::uint32_t f) { return surface.isFace(f) || surface.isInQuad(f); };
    const bool allLive = surface.tree().forEachOverlap({openvdb::Vec3d(-far), openvdb::Vec3d(far)},
                                                       [&](std::uint32_t f, const detail::Box& /*box*/) {
                                                           ++seen;
                                                           return isThere(f);
                                                       });
    const std::vector<std::uint32_t> all = facesAndAlternates(surface);
    return allLive && seen == all.size() && std::all_of(all.begin(), all.end(), [&](std::uint32_t f) {
               const detail::Box box = detail::Box::of(surface.corners(f));
               bool found = false;
               surface.tree().forEachOverlap(box, [&](std::uint32_t other, const detail::Box& at) {
                   found = found || (other == f && at.lo == box.lo && at.hi == box.hi);
                   return !found;
               });
               return found;
           });
}

/// Whether both are the same to the bit, with the order of all lists; numbers that are used up do not count.
inline bool sameSurface(const detail::GuardedMesh& a, const detail::GuardedMesh& b)
{
    if (a.liveFaces() != b.liveFaces() || a.quads() != b.quads()) return false;
    const std::uint32_t faces = std::max(a.faces(), b.faces()), vertices = std::max(a.vertices(), b.vertices());
    for (std::uint32_t f = 0; f < faces; ++f) {
        const bool isA = f < a.faces() && a.isFace(f), isB = f < b.faces() && b.isFace(f);
        if (isA != isB || (isA && a.face(f) != b.face(f))) return false;
        if (isA && a.partnerOf(f) != b.partnerOf(f)) return false;
    }
    for (std::uint32_t v = 0; v < vertices; ++v) {
        const bool isA = v < a.vertices() && a.isVertex(v), isB = v < b.vertices() && b.isVertex(v);
        if (isA != isB) return false;
        if (isA && (a.point(v) != b.point(v) || a.facesOf(v) != b.facesOf(v))) return false;
    }
    return true;
}

/// A change of a surface around a vertex.
struct RandomChange {
    detail::StarChange star;
    openvdb::Vec3d start; ///< the vertex, or the middle of the edge that is split
    double size;          ///< the length of an edge there
};

/// Returns a change of v taken at random, one of the first `kinds` of moves, collapses, splits and flips, or none if it
/// is impossible. Surfaces with quads only get moves.
inline std::optional<RandomChange> randomChange(const detail::GuardedMesh& surface, std::uint32_t v,
                                                std::mt19937& random, unsigned kinds = 4)
{
    const auto neighbours = surface.neighbours(v);
    const std::uint32_t w = neighbours[random() % neighbours.size()];
    RandomChange change{starOf(surface, v), surface.point(v), (surface.point(v) - surface.point(w)).length()};
    const auto kind = surface.quads() > 0 ? 0 : random() % kinds;
    const auto edge = change.star.link[random() % change.star.link.size()];
    if (kind == 1 && !starOfCollapse(surface, v, w, change.star)) return std::nullopt;
    if (kind == 2) {
        change.star = starOfSplit(surface, v, w);
        change.start = 0.5 * (surface.point(v) + surface.point(w));
    }
    if (kind == 3 && !starOfFlip(surface, v, edge[0], edge[1], change.star)) return std::nullopt;
    return change;
}

/// Makes quads of pairs of triangles at random, of one in `oneIn` that can be.
inline void makeSomeQuads(detail::GuardedMesh& surface, std::mt19937& random, unsigned oneIn)
{
    const std::uint32_t faces = surface.faces();
    for (std::uint32_t f = 0; f < faces; ++f) {
        if (random() % oneIn != 0 || !surface.isFace(f) || surface.isInQuad(f)) continue;
        const openvdb::Vec3I t = surface.face(f);
        const int side = static_cast<int>(random() % 3);
        for (std::uint32_t g = 0; g < faces; ++g) {
            if (!surface.isFace(g) || surface.isInQuad(g) || g == f) continue;
            if (!hasCorner(surface.face(g), t[side]) || !hasCorner(surface.face(g), t[(side + 1) % 3])) continue;
            makeQuad(surface, f, g);
            break;
        }
    }
}

} // namespace vdbcage::test
