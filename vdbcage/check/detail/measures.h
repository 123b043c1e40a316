#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/check/detail/face_triangles.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// Returns the signed volume within a surface, the mean over the diagonals of its quads.
/// \pre the surface has no boundary
double volume(const std::vector<Vec3d>& points, const FaceTriangles& faces);

struct Angles {
    double least = 0, firstPercentile = 0, median = 0; ///< degrees
};
/// Returns the angles of all corners of all triangles; zeros for no faces. \throw Cancelled
Angles angles(const std::vector<Vec3d>& points, const FaceTriangles& faces, Interrupter* interrupter);

struct Distances {
    double mean = 0, most = 0, least = 0; ///< in world units
};
/// Returns the distances from the faces to the triangles of the tree; zeros for no faces.
///
/// The mean is over `samples` points spread evenly over the faces' area, on quads over both diagonals. The extremes are
/// over these points and the faces' corners. \throw Cancelled
Distances distances(const std::vector<Vec3d>& points, const FaceTriangles& faces, const TriangleBvh& tree,
                    std::size_t samples, Interrupter* interrupter);

} // namespace vdbcage::detail
