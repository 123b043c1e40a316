#pragma once

#include <openvdb/math/BBox.h>
#include <openvdb/math/Mat3.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>

/// Changes of meshes and boxes that several parts of the search need.
namespace vdbcage::detail {

/// Returns `mesh` in other coordinates: `rows * p` for each point.
Mesh turned(Mesh mesh, const openvdb::Mat3d& rows);

/// Returns `mesh` with each quad as two triangles.
Mesh triangulated(Mesh mesh);

/// Returns `box` united with its mirror image.
openvdb::BBoxd boxWithMirrorImage(const openvdb::BBoxd& box, const SymmetryPlane& plane);

} // namespace vdbcage::detail
