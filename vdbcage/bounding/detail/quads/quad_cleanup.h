#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Brings the vertices of quads and triangles nearer to four edges, by local changes under the guard.
///
/// Edges next to quads are turned, quads collapse along a diagonal, vertices are split into quads, triangles become
/// quads. The vertices around a change are relaxed. The change stays if distance, corners and valences together are
/// then better; otherwise it is undone. Changes that leave the valences alike are tried as well, since they bring
/// irregular vertices together. The number of faces does not grow beyond `faces`; if it is larger, quads are collapsed
/// where possible. The result is the same for any number of threads.
/// \pre no quad is paired in the surface, which `table` is of
/// \throw Cancelled
/// Cost: O(n log n) for n faces, and O(n) trials of a patch each.
/// Based on: Tarini, Pietroni, Cignoni, Panozzo, Puppo, Practical Quad Mesh Simplification, 2010.
void cleanUp(GuardedMesh& surface, QuadTable& table, std::size_t faces, Interrupter* interrupter);

} // namespace vdbcage::detail
