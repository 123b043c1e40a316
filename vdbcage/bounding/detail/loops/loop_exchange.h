#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Moves loops from where they gain little to where they gain more, in rounds. At most `quads` are left, or as many as
/// there were if these were more.
///
/// Some loops are collapsed, cheapest first. Then loops are split, as many as fit: those whose split brings the surface
/// nearest to the model. A round that does not bring it nearer is undone, and the next collapses fewer loops. Joints
/// keep their rings.
/// \pre no quad is paired in the surface
/// \throw Cancelled
/// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, Mesh Optimization, 1993.
void exchangeLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, int rounds, Interrupter* interrupter);

} // namespace vdbcage::detail
