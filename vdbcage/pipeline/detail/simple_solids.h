#pragma once

#include <optional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>

/// Solids of few faces around a model.
namespace vdbcage::detail {

/// Returns `mesh` in other coordinates: `rows * p` for each point.
Mesh turned(Mesh mesh, const openvdb::Mat3d& rows);

/// Returns `mesh` with each quad as two triangles.
Mesh triangulated(Mesh mesh);

double longestSide(const openvdb::BBoxd& box);

/// Returns `box` united with its mirror image.
openvdb::BBoxd boxWithMirrorImage(const openvdb::BBoxd& box, const SymmetryPlane& plane);

/// Makes the six faces of `box`, facing outward.
Mesh boxMesh(const openvdb::BBoxd& box);

/// Makes the smallest tetrahedron around `box` of which three faces lie in those of the box and the fourth goes through
/// a corner.
Mesh tetrahedronMesh(const openvdb::BBoxd& box);

} // namespace vdbcage::detail
