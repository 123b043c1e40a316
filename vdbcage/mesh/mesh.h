#pragma once

#include <cstddef>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/BBox.h>
#include <openvdb/math/Vec3.h>
#include <openvdb/math/Vec4.h>
#include <vdbcage/core/export.h>

namespace vdbcage {

/// A polygon soup: points, and faces that index them, counter-clockwise seen from outside. Models, cages and every
/// surface between them are of this type. Nothing is promised about connectivity unless a function says so.
struct Mesh {
    std::vector<openvdb::Vec3d> points;    ///< world space, exactly as the file has them
    std::vector<openvdb::Vec3I> triangles; ///< three indices into `points`
    std::vector<openvdb::Vec4I> quads;     ///< four indices into `points`, in order around the face
    /// The triangles that the polygons of a read model have when they are split in other ways, once where polygons are
    /// equal. Quads, whose diagonals are known, have none here, large polygons few (see ReadSummary). They are no
    /// faces, but another program may see them, so cages bound them too.
    std::vector<openvdb::Vec3I> alternatives = {};
};

/// Returns the number of triangles and quads.
/// \param mesh its alternatives do not count
inline std::size_t faceCount(const Mesh& mesh)
{
    return mesh.triangles.size() + mesh.quads.size();
}

/// Returns the triangles of the mesh, then each quad as two, split by the diagonal of its corners 0 and 2.
/// \param mesh its alternatives are left out
/// Cost: O(faces).
VDBCAGE_API std::vector<openvdb::Vec3I> triangulate(const Mesh& mesh);

/// Returns triangulate(), then the triangles of every other way to split a face. These are the quads split by their
/// other diagonal, and the alternatives.
/// \param mesh any polygon soup
/// Cost: O(faces).
VDBCAGE_API std::vector<openvdb::Vec3I> everySplit(const Mesh& mesh);

/// Returns the points that no face uses, nor another split of one: their indices, ascending. They bound nothing.
/// \param mesh any polygon soup with valid indices
/// Cost: O(points + faces).
VDBCAGE_API std::vector<openvdb::Index32> loosePoints(const Mesh& mesh);

/// Returns the box of the points that faces use; empty for no faces.
/// \param mesh any polygon soup with valid indices
/// Cost: O(faces).
VDBCAGE_API openvdb::BBoxd boundingBox(const Mesh& mesh);

/// Checks that a mesh can be worked on.
/// \param mesh any polygon soup
/// \param what names the mesh in the message, such as "model"
/// \throw InputError when there is no face; an index is out of range; a point of a face is not finite; every face is
/// degenerate (a repeated index or zero area, decided exactly)
/// Cost: O(faces).
VDBCAGE_API void requireUsable(const Mesh& mesh, const char* what);

} // namespace vdbcage
