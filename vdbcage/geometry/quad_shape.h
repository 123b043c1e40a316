#pragma once

#include <array>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// Whether a quad is convex under both diagonals, with no corner above 160 degrees, and nowhere folded too much.
///
/// Beyond 160 degrees it looks like a triangle. Under both diagonals the cosine of the angle between the normals of its
/// two triangles must be above `leastCosine`, 0 or more. `largestDeviation` is then how far its corners are from
/// square, in degrees.
bool isConvexQuad(const std::array<openvdb::Vec3d, 4>& corners, double leastCosine, double& largestDeviation);

/// The angle between two vectors in degrees, 0 to 180. It is 0 if one is zero.
double angleDegrees(const openvdb::Vec3d& a, const openvdb::Vec3d& b);

} // namespace vdbcage::detail
