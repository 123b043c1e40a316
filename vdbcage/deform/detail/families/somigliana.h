#pragma once

#include <array>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/kernels/kernel_cage.h>
#include <vdbcage/deform/detail/unit_cage.h>

namespace vdbcage::detail {

/// A triangle's frame: its normal, the direction of its first edge, and the normal cross that.
using FaceFrame = std::array<openvdb::Vec3d, 3>;

/// Of edges `a` and `b` from the first corner. All zero if the triangle has no area.
FaceFrame faceFrame(const openvdb::Vec3d& a, const openvdb::Vec3d& b);

/// Appends what the six weights of each triangle are of, in the units of the points, to `handles`.
/// \pre `posed` has the points of `cage`, whose quads count as triangulateByShorterDiagonal() splits them; `elasticity` is in range
void addSomiglianaHandles(const Mesh& cage, const std::vector<openvdb::Vec3d>& posed, const Elasticity& elasticity,
                          std::vector<openvdb::Vec3d>& handles);

/// Writes the coordinates of `x`, which is scaled, to `row`: those of the points, which are Green's, then for each
/// triangle the integral of r r^T / |r|^3 over it, over 4 pi, where r is the way from `x`: the symmetric matrix in the
/// triangle's frame, as nn, n1, n2, 11, 12, 22. Returns false if `x` is
/// outside of the cage. \pre the cage has triangles only
bool somiglianaRow(const UnitCage& cage, const openvdb::Vec3d& x, double* row);

} // namespace vdbcage::detail
