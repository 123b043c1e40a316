#pragma once

#include <cstdint>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// Takes two triangles that share an edge away by collapsing that edge, under the guard. Returns whether.
///
/// All quads stay. Where it fails, quads at the ends of the edge are left split.
bool collapseTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g);

} // namespace vdbcage::detail
