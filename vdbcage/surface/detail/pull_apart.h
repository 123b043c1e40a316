#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Moves points towards the mean of their neighbours so that faces no longer meet: points that were pulled through the
/// other side, slipped over a neighbour, or lie on another point. Connectivity stays.
///
/// Points whose faces meet most others come first. A move counts only if it leaves fewer meetings, and is undone in the
/// end if it was not needed. Where connected meetings are not all cleared, their points stay where they were.
/// `withinParts`: only meetings of faces that are connected over edges count, so overlapping parts are not deformed
/// \return the number of moved points
/// \pre all indices are valid, all points finite
/// \throw Cancelled
/// Cost: O(n log n + m log n) for n faces and m meetings, times the sweeps: 8 at most.
std::size_t pullApart(Mesh& mesh, bool withinParts, Interrupter* interrupter);

} // namespace vdbcage::detail
