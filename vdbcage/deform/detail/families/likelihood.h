#pragma once

#include <openvdb/math/Vec3.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// Writes the coordinates of `x`, which is scaled, to `row`, one a point of the cage. None is negative. Returns false
/// if `x` is outside of the cage, or if no non-negative combination of the faces is balanced around it.
bool likelihoodRow(const UnitCage& cage, const openvdb::Vec3d& x, double* row);

} // namespace vdbcage::detail
