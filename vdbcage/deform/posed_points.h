#pragma once

#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The points of a cage in a pose.
struct PosedPoints {
    std::vector<openvdb::Vec3d> points; ///< in the order of the cage at rest, as Binding::pose() takes them
    bool reordered = false;             ///< whether the posed cage has them in another order
};

/// Returns the points of a cage that another program posed and wrote, in the cage's order. The faces tell the order;
/// \ref deform tells how.
/// \param cage at rest
/// \param posed a mesh of the same faces, in any order; its points may be in another order, too
/// \throw InputError when the meshes have other numbers of points or faces; when the faces are not the cage's in any
/// order of the points; when several orders of the points fit, or one except for quads that are split
/// Cost: O(n log n) in the faces for most cages. Each order is followed as far as it fits, from a place that has few
/// like it.
VDBCAGE_API PosedPoints posedPoints(const Mesh& cage, const Mesh& posed);

} // namespace vdbcage
