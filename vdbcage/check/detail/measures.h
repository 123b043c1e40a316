#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/check/detail/face_triangles.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// The signed volume within a surface without boundary, the mean over the diagonals of its quads.
double volume(const std::vector<Vec3d>& points, const FaceTriangles& faces);

struct Angles {
    double least = 0, firstPercentile = 0, median = 0; ///< degrees
};
/// Of all corners of all triangles; zeros for no faces.
Angles angles(const std::vector<Vec3d>& points, const FaceTriangles& faces);

struct Distances {
    double mean = 0, most = 0, least = 0; ///< in world units
};
/// From the faces to the triangles of the tree: the mean over `samples` points spread evenly over the faces' area (a
/// quad's over both diagonals), the extremes over these and the faces' corners. Zeros for no faces.
Distances distances(const std::vector<Vec3d>& points, const FaceTriangles& faces, const TriangleBvh& tree,
                    std::size_t samples, Interrupter* interrupter);

} // namespace vdbcage::detail
