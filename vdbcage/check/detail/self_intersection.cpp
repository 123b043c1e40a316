#include <array>
#include <atomic>
#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <vdbcage/check/check.h>
#include <vdbcage/check/detail/cage_faces.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

using Index = std::uint32_t;

bool isEdge(const Mesh& mesh, std::size_t face, Index a, Index b)
{
    const auto follows = [&](const auto& corners, int size) {
        for (int i = 0; i < size; ++i) {
            const Index c = corners[i], d = corners[(i + 1) % size];
            if ((c == a && d == b) || (c == b && d == a)) return true;
        }
        return false;
    };
    return face < mesh.triangles.size() ? follows(mesh.triangles[face], 3)
                                        : follows(mesh.quads[face - mesh.triangles.size()], 4);
}

// Returns whether two triangles of different faces, not degenerate, share more than the corners and edges that their
// faces share.
bool collide(const CageFaces& cage, std::size_t s, std::size_t t)
{
    const Vec3I &a = cage.faces[s], &b = cage.faces[t];
    std::array<int, 3> inA{}, inB{}; // places of the shared corners
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (a[i] != b[k]) continue;
            inA[static_cast<std::size_t>(shared)] = i;
            inB[static_cast<std::size_t>(shared)] = k;
            ++shared;
        }
    }
    const std::vector<Vec3d>& p = cage.mesh.points;
    const auto turned = [&](const Vec3I& triangle, int first) {
        return Corners{p[triangle[first]], p[triangle[(first + 1) % 3]], p[triangle[(first + 2) % 3]]};
    };
    switch (shared) {
    case 0:
        return trianglesMeet(turned(a, 0), turned(b, 0));
    case 1:
        return meetBeyondCorner(turned(a, inA[0]), turned(b, inB[0]));
    case 2: {
        // Two corners that are not an edge of both faces: a diagonal lies on the other face.
        const Index u = a[inA[0]], v = a[inA[1]];
        if (!isEdge(cage.mesh, cage.faces.face(s), u, v) || !isEdge(cage.mesh, cage.faces.face(t), u, v)) return true;
        return foldOver(p[u], p[v], p[a[3 - inA[0] - inA[1]]], p[b[3 - inB[0] - inB[1]]]);
    }
    default:
        return true;
    }
}

bool isFolded(const CageFaces& cage, std::size_t quad)
{
    const openvdb::Vec4I& q = cage.mesh.quads[quad];
    const std::vector<Vec3d>& p = cage.mesh.points;
    return foldOver(p[q[0]], p[q[2]], p[q[1]], p[q[3]]) || foldOver(p[q[1]], p[q[3]], p[q[0]], p[q[2]]);
}

bool isWholeQuad(const CageFaces& cage, std::size_t face)
{
    if (!cage.faces.isQuad(face)) return false;
    for (std::size_t t = cage.faces.first(face); t < cage.faces.first(face + 1); ++t) {
        if (cage.degenerate[t]) return false;
    }
    return true;
}

bool isFoldedFace(const CageFaces& cage, std::size_t face)
{
    return isWholeQuad(cage, face) && isFolded(cage, face - cage.mesh.triangles.size());
}

// Calls visit(other) for the triangles of other faces that collide with one of the face, until it returns false.
template <typename Wanted, typename Visit>
void forCollisions(const CageFaces& cage, std::size_t face, const Wanted& wanted, const Visit& visit)
{
    bool more = true;
    for (std::size_t t = cage.faces.first(face); more && t < cage.faces.first(face + 1); ++t) {
        if (cage.degenerate[t]) continue;
        const Corners corners = cage.corners(t);
        const Box box = Box::of(corners);
        more = cage.tree.near(corners, 0, [&](const BoxTree::Item& item) {
            const Index other = cage.faces.face(item.triangle);
            if (other == face || cage.degenerate[item.triangle] || !wanted(other)) return true;
            if (!box.meets(Box::of(cage.corners(item.triangle))) || !collide(cage, t, item.triangle)) return true;
            return visit(other);
        });
    }
}

tbb::blocked_range<std::size_t> allFaces(const CageFaces& cage)
{
    return {0, cage.faces.faces(), 4};
}

// Marks the faces in pairs, each by the first pair found, when there are too many pairs to count.
void markSelfIntersections(CageFaces& cage, Interrupter* interrupter)
{
    parallelFor(allFaces(cage), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t face = range.begin(); face < range.end(); ++face) {
            throwIfInterrupted(interrupter);
            if (isSet(cage.bad[face])) continue;
            bool found = isFoldedFace(cage, face);
            if (!found) {
                forCollisions(
                    cage, face, [](Index) { return true; },
                    [&](Index other) {
                        set(cage.bad[other]);
                        found = true;
                        return false;
                    });
            }
            if (found) set(cage.bad[face]);
        }
    });
}

} // namespace

std::size_t countSelfIntersections(CageFaces& cage, Interrupter* interrupter)
{
    std::atomic<std::size_t> result{0};
    // By face: the last face that counted a pair with it. A pair of quads can collide in up to 16 ways.
    tbb::enumerable_thread_specific<std::vector<Index>> counted(
        [&] { return std::vector<Index>(cage.faces.faces(), ~Index(0)); });
    parallelFor(allFaces(cage), [&](const tbb::blocked_range<std::size_t>& range) {
        std::vector<Index>& countedBy = counted.local();
        for (std::size_t face = range.begin(); face < range.end() && result < mostSelfIntersections; ++face) {
            throwIfInterrupted(interrupter);
            std::size_t pairs = 0;
            forCollisions(
                cage, face, [&](Index other) { return other > face && countedBy[other] != face; },
                [&](Index other) {
                    countedBy[other] = static_cast<Index>(face);
                    set(cage.bad[other]);
                    ++pairs;
                    return true;
                });
            if (isFoldedFace(cage, face)) ++pairs;
            if (pairs > 0) set(cage.bad[face]);
            result += pairs;
        }
    });
    // Whether the sum reaches the limit does not depend on the order of the additions.
    if (result < mostSelfIntersections) return result;
    markSelfIntersections(cage, interrupter);
    return mostSelfIntersections;
}

} // namespace vdbcage::detail
