#pragma once

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/bound_cage.h>

namespace vdbcage::detail {

/// The normal of the parallelogram of two edges `a` and `b` (counter-clockwise) that became `posedA` and `posedB`, as
/// long as it was large at rest times the root mean square of the principal stretches. Zero if the posed one is flat.
openvdb::Vec3d stretchedNormal(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& posedA,
                               const openvdb::Vec3d& posedB);

/// The coordinates of `x` (scaled) into `row`: the points', then one a triangle, then four a quad. False if `x` is
/// outside of the cage.
bool greenRow(const BoundCage& cage, const openvdb::Vec3d& x, double* row);

} // namespace vdbcage::detail
