#pragma once

#include <openvdb/math/BBox.h>
#include <vdbcage/mesh/mesh.h>

/// Solids of few faces around a model.
namespace vdbcage::detail {

/// Makes the six faces of `box`, facing outward.
Mesh boxMesh(const openvdb::BBoxd& box);

/// Makes the smallest tetrahedron around `box` of which three faces lie in those of the box and the fourth goes through
/// a corner.
Mesh tetrahedronMesh(const openvdb::BBoxd& box);

} // namespace vdbcage::detail
