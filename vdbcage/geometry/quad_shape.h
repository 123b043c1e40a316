#pragma once

#include <array>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// Whether a quad is convex under both diagonals, with no corner above 160 degrees (beyond, it looks like a triangle),
/// and the normals of its two triangles are apart by an angle whose cosine is above `leastCosine`, 0 or more, under
/// both. `largestDeviation` is then how far its corners are from square, in degrees.
bool isConvexQuad(const std::array<openvdb::Vec3d, 4>& corners, double leastCosine, double& largestDeviation);

/// The angle between two vectors in degrees, 0 to 180; 0 if one is zero.
double angleDegrees(const openvdb::Vec3d& a, const openvdb::Vec3d& b);

} // namespace vdbcage::detail
