#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Takes loops from where they bring little to where they bring more, in rounds. At most `quads` are left, or as many
/// as there were if these were more.
///
/// Some loops are collapsed, cheapest first. Then loops are split, as many as fit: those whose split brings the surface
/// nearest to the model. A round that did not bring it nearer is undone, and fewer loops go in the next. Joints
/// keep their rings.
/// \pre no quad is paired in the surface
/// \throw Cancelled
/// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, Mesh Optimization, 1993.
void exchangeLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, int rounds, Interrupter* interrupter);

} // namespace vdbcage::detail
