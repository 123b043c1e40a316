#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Moves points towards the mean of their neighbours so that faces no longer meet: points that were pulled through the
/// other side, or slipped over a neighbour, or lie on another one. Faces stay what they are.
///
/// Points whose faces meet most others come first. A move counts only if it leaves fewer meetings, and is taken back in
/// the end if it was not needed. Where meetings that hang together are not all cleared, their points stay where they
/// were.
/// `withinParts`: only of faces that are connected over edges; parts that overlap are not deformed then
/// \return how many points lie elsewhere now
/// \pre all indices are valid, all points finite
/// \throw Cancelled
/// Cost: O(n log n + m log n) for n faces and m meetings, times the sweeps: 8 at most.
std::size_t pullApart(Mesh& mesh, bool withinParts, Interrupter* interrupter);

} // namespace vdbcage::detail
