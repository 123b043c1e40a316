#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_loop.h>
#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>

namespace vdbcage::detail {

/// Collapses the rungs of a loop one after the other, each under the guard, all or none. Returns whether.
///
/// When all are collapsed, settle(kept) may move the vertices that they became, and returns whether the collapse may
/// stay. If not, or if the guard does not allow a rung, surface, table and quadrics are as before, to the bit.
/// \pre leavesQuads()
/// Cost: O(rungs), with a test by the guard for each place that is tried.
bool collapseLoop(GuardedMesh& surface, QuadTable& table, VertexQuadrics& quadrics, const QuadLoop& loop,
                  const std::function<bool(const std::vector<std::uint32_t>& kept)>& settle);

/// Returns the least cost of the rungs' collapses, by quadrics.
double collapseCost(const VertexQuadrics& quadrics, const QuadLoop& loop);

} // namespace vdbcage::detail
