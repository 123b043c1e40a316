#pragma once

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// The normal of the parallelogram of two edges `a` and `b`, counter-clockwise, that became `posedA` and `posedB`.
///
/// Its length is the area at rest times the root mean square of the principal stretches. It is zero if the posed
/// parallelogram is flat.
openvdb::Vec3d stretchedNormal(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& posedA,
                               const openvdb::Vec3d& posedB);

/// Writes the coordinates of `x`, which is scaled, to `row`: the points', then one a triangle, then four a quad.
/// Returns false if `x` is outside of the cage.
bool greenRow(const UnitCage& cage, const openvdb::Vec3d& x, double* row);

} // namespace vdbcage::detail
