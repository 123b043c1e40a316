#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_loop.h>

namespace vdbcage::detail {

/// Splits a loop lengthwise, under the guard: makes a new vertex on each rung, and two quads of each quad. Returns the
/// new vertices; none if the guard does not allow one of the changes. Surface and table are then half changed.
/// \pre the loop is straight, and no quad is paired in the surface
std::vector<std::uint32_t> splitLoop(GuardedMesh& surface, QuadTable& table, const QuadLoop& loop);

} // namespace vdbcage::detail
