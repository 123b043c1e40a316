#pragma once

#include <array>

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/bound_cage.h>

namespace vdbcage::detail {

/// The integrals over the part of the unit sphere that the face covers, seen from the origin, of each corner's basis
/// function over the distance; negative where the face is seen from behind. The origin is not on the face.
std::array<double, 4> meanValueWeights(const PatchCorners& corners, bool quad);

/// The coordinates of `x` (scaled) into `row`, one a point of the cage. True: they exist everywhere.
bool meanValueRow(const BoundCage& cage, const openvdb::Vec3d& x, double* row);

} // namespace vdbcage::detail
