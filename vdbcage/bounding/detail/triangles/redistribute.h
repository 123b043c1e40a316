#pragma once

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Takes vertices from where they bring little to where they bring more, in rounds.
///
/// The edges whose split brings the surface nearest to the model are split, and the surface is tightened by `sweeps`.
/// As many edges are collapsed by the quadrics that it has then, and it is tightened again. A round that did not bring
/// the surface nearer is undone, and fewer edges are split. The number of faces does not grow. The same for any number
/// of threads. It reports 0 to 100 % of a stage.
/// \throw Cancelled
/// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, Mesh Optimization, 1993.
void redistribute(GuardedMesh& surface, int rounds, int sweeps, Interrupter* interrupter);

/// Flips the edges whose flip brings the surface nearest to the model, then tightens by `sweeps`.
///
/// A vertex that a flip adds an edge to is placed anew. The number of faces stays, and the surface comes no farther.
/// The same for any number of threads.
/// \pre there are no quads
/// \throw Cancelled
void flipEdges(GuardedMesh& surface, int sweeps, Interrupter* interrupter);

} // namespace vdbcage::detail
