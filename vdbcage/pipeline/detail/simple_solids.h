#pragma once

#include <optional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/symmetry.h>

/// Solids of few faces around a model.
namespace vdbcage::detail {

/// `mesh` in other coordinates: `rows * p` of each point.
Mesh turned(Mesh mesh, const openvdb::Mat3d& rows);

/// `mesh` with each quad as two triangles.
Mesh triangulated(Mesh mesh);

double longestSide(const openvdb::BBoxd& box);

/// `box` united with its mirror image.
openvdb::BBoxd boxWithMirrorImage(const openvdb::BBoxd& box, const SymmetryPlane& plane);

/// The six faces of `box`, facing outward.
Mesh boxMesh(const openvdb::BBoxd& box);

/// A tetrahedron around `box`: three of its faces lie in those of the box, the fourth goes through a corner. The
/// smallest of its kind.
Mesh tetrahedronMesh(const openvdb::BBoxd& box);

} // namespace vdbcage::detail
