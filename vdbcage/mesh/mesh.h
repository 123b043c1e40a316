#pragma once

#include <cstddef>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/BBox.h>
#include <openvdb/math/Vec3.h>
#include <openvdb/math/Vec4.h>
#include <vdbcage/core/export.h>

namespace vdbcage {

/// A polygon soup: points and faces that index them, counter-clockwise seen from outside. Models, cages and every
/// surface between them are of this type; nothing is promised about connectivity unless a function says so.
struct Mesh {
    std::vector<openvdb::Vec3d> points;    ///< world space, exactly as the file has them
    std::vector<openvdb::Vec3I> triangles; ///< three indices into `points`
    std::vector<openvdb::Vec4I> quads;     ///< four indices into `points`, in order around the face
    /// Of a model that was read: triangles that its polygons would have if they were split in other ways (quads apart,
    /// whose diagonals are known; and large polygons, see ReadSummary). Those of equal polygons are there once. They
    /// are no faces, but another program may see them, so cages bound them too.
    std::vector<openvdb::Vec3I> alternatives = {};
};

/// Triangles and quads together, a quad counting once.
inline std::size_t faceCount(const Mesh& mesh)
{
    return mesh.triangles.size() + mesh.quads.size();
}

/// The triangles of the mesh, then each quad as two: split by the diagonal of its corners 0 and 2. O(faces).
VDBCAGE_API std::vector<openvdb::Vec3I> triangulate(const Mesh& mesh);

/// triangulate(), then the triangles of every other way to split a face: of the quads by their other diagonal, and the
/// alternatives. O(faces).
VDBCAGE_API std::vector<openvdb::Vec3I> everySplit(const Mesh& mesh);

/// The box of the points that faces refer to (a point no face uses does not count); empty for no faces. O(faces).
VDBCAGE_API openvdb::BBoxd boundingBox(const Mesh& mesh);

/// Checks that `mesh` can be worked on: it has faces, every index is below the number of points, every point that a
/// face uses is finite, and not every face is degenerate (repeats an index or has zero area, decided exactly).
/// `what` names the mesh in the message ("model"). O(faces). \throw InputError
VDBCAGE_API void requireUsable(const Mesh& mesh, const char* what);

} // namespace vdbcage
