#pragma once

#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Where the points of a cage are in a pose.
struct PosedPoints {
    std::vector<openvdb::Vec3d> points; ///< in the order of the cage at rest, as Binding::pose() takes them
    bool reordered = false;             ///< the posed cage has them in another order
};

/// Finds the points of `posed`, the cage as another program posed and wrote it, in the order of `cage`.
///
/// The faces tell the order. Where those of `posed` are the cage's, in any order and with any first corner, the points
/// are taken as they are. Then quads may also be split into triangles, and triangles that are a quad of the other mesh
/// be joined. Else the points are put into the order that makes the faces the cage's, if there is only one. A cage that
/// is topologically symmetric, as a box is, has several. Quads that a reader split, as they are concave, count as whole
/// (see Mesh::alternatives). Coordinates are not looked at, and faces turned inside out are other faces.
/// \throw InputError other numbers of points or faces; faces that are not the cage's in any order of the points; several
/// orders of the points that fit, or one that fits but for quads that are split
/// Cost: O(n log n) in the faces for most cages. Each order is followed as far as it fits, from a place that has few
/// like it.
VDBCAGE_API PosedPoints posedPoints(const Mesh& cage, const Mesh& posed);

} // namespace vdbcage
