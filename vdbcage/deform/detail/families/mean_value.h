#pragma once

#include <array>

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// Returns for each corner the integral of its basis function divided by the distance, over the part of the unit sphere
/// that the face covers, seen from the origin. It is negative where the face is seen from behind.
/// \pre the origin is not on the face
std::array<double, 4> meanValueWeights(const PatchCorners& corners, bool quad);

} // namespace vdbcage::detail
