#pragma once

#include <cstdint>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// Removes two triangles that share an edge by collapsing that edge, under the guard. Returns whether.
///
/// All quads stay. If it fails, quads at the ends of the edge are left split.
bool collapseTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g);

} // namespace vdbcage::detail
