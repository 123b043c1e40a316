#pragma once

#include <openvdb/Types.h>
#include <openvdb/math/Vec3.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Returns whether the three points are on one line or coincide, exactly, for any finite coordinates.
bool isDegenerate(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& c);

/// Returns the same for a triangle of `mesh`.
/// \pre its indices are in range
bool isDegenerate(const Mesh& mesh, const openvdb::Vec3I& triangle);

} // namespace vdbcage::detail
