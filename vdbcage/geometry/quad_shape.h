#pragma once

#include <array>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// Returns whether a quad is convex under both diagonals, with no corner above 160 degrees, and not folded too much.
///
/// With a corner beyond 160 degrees it looks like a triangle. Under both diagonals the cosine of the angle between the
/// normals of its two triangles must be above `leastCosine`, which is 0 or more. If all holds, `largestDeviation`
/// becomes the largest deviation of its corners from square, in degrees.
bool isConvexQuad(const std::array<openvdb::Vec3d, 4>& corners, double leastCosine, double& largestDeviation);

/// Returns the angle between two vectors in degrees, 0 to 180; 0 if one is zero.
double angleDegrees(const openvdb::Vec3d& a, const openvdb::Vec3d& b);

} // namespace vdbcage::detail
