#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/check/detail/face_triangles.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage::detail {

/// Counts the components whose inside is empty although others go around it: the winding number there is 0, but that of
/// the others is not. A component whose volume may be only rounding has no inside.
/// \pre the faces are sound, and `topology` is theirs
/// \throw Cancelled
/// Cost: O(n) for n faces; O(n log n) where some components face outward and others inward.
std::size_t countHollows(const std::vector<openvdb::Vec3d>& points, const FaceTriangles& faces,
                         const MeshTopology& topology, Interrupter* interrupter);

} // namespace vdbcage::detail
