#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <boost/container/small_vector.hpp>
#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// A change to a surface: the star of a centre replaces some faces.
///
/// A move replaces the faces around a vertex, a flip one next to them as well, a collapse those around both ends of an
/// edge, a split those on both sides of it. The guard treats all the same.
struct StarChange {
    static constexpr std::uint32_t none = GuardedMesh::none;
    using Faces = boost::container::small_vector<std::uint32_t, 16>;

    std::uint32_t centre = none;  ///< the vertex that moves, or stays in a collapse; vertices() if it is new
    bool onPlane = false;         ///< the centre is, or comes to be, on the plane of symmetry: this is half of a star
    std::uint32_t removed = none; ///< the vertex that a collapse removes
    Faces oldFaces;               ///< those that are replaced
    Faces keptFaces;              ///< for each link edge, the old face that becomes its triangle; none: a new face
    /// Edges opposite to the centre, in the faces' direction.
    boost::container::small_vector<std::array<std::uint32_t, 2>, 16> link;
    std::size_t alternates = 0; ///< the number of faces and link edges of alternates, at the ends of the lists
};

/// Returns the star of a vertex as it is, for moving it.
StarChange starOf(const GuardedMesh& mesh, std::uint32_t v);
/// Makes the star that replaces the stars of both ends of an edge. Returns false where the link condition forbids the
/// collapse, and where the vertex would have three edges.
/// \pre the ends are in no quad
/// Based on: Dey, Edelsbrunner, Guha, Nekhayev, Topology Preserving Edge Contraction, 1999.
bool starOfCollapse(const GuardedMesh& mesh, std::uint32_t keep, std::uint32_t remove, StarChange& star);
/// Returns the star that splits the edge between two neighbours at a new vertex.
/// \pre there are no quads
StarChange starOfSplit(const GuardedMesh& mesh, std::uint32_t u, std::uint32_t v);
/// Makes the star around c that also takes in the face across its link edge from a to b. An edge from c to the face's
/// third corner replaces that edge.
///
/// Returns false where there is no such face, where c and that corner are joined already, and where both are on the
/// plane of symmetry.
/// \pre there are no quads
bool starOfFlip(const GuardedMesh& mesh, std::uint32_t c, std::uint32_t a, std::uint32_t b, StarChange& star);
/// Makes the star around a new vertex that replaces some faces. If `onPlane`, the vertex is on the plane of symmetry,
/// where the faces have a side. Returns false unless they are one disk without a vertex inside.
/// \pre they are in no quad, and hang together over edges
bool starOfFaces(const GuardedMesh& mesh, const StarChange::Faces& faces, bool onPlane, StarChange& star);

/// Makes the star around `centre` that replaces some faces, all those around it among them. If `removed` is a vertex,
/// all around it are among them too, and it is removed. Returns false unless the faces are one disk without another
/// vertex inside, or half of one that ends on the plane of symmetry.
/// \pre they are in no quad, and hang together over edges
bool starOfPatch(const GuardedMesh& mesh, std::uint32_t centre, std::uint32_t removed, const StarChange::Faces& faces,
                 StarChange& star);

/// Returns the mean normal of the old faces, of unit length or zero.
Vec3d outward(const GuardedMesh& mesh, const StarChange& star);
/// Returns `p` as a place of the centre: on the plane of symmetry if `star.onPlane`, on its rail if it has one, and
/// rounded as the guard asks.
Vec3d rounded(const GuardedMesh& mesh, const StarChange& star, const Vec3d& p);
/// Returns the triangle at link edge i with the centre at `p`.
inline Corners starCorners(const GuardedMesh& mesh, const StarChange& star, std::size_t i, const Vec3d& p)
{
    return {p, mesh.point(star.link[i][0]), mesh.point(star.link[i][1])};
}

} // namespace vdbcage::detail
