#pragma once

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Moves vertices from where they gain little to where they gain more, in rounds.
///
/// Splits the edges whose split brings the surface nearest to the model, and tightens it by `sweeps`. Then collapses
/// that many edges by the quadrics of the new surface, and tightens again. A round that does not bring the surface
/// nearer is undone, and the next splits fewer edges. The number of faces does not grow. The result is the same for any
/// number of threads. Progress goes from 0 to 100 % of a stage.
/// \throw Cancelled
/// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, Mesh Optimization, 1993.
void redistribute(GuardedMesh& surface, int rounds, int sweeps, Interrupter* interrupter);

/// Flips the edges whose flip brings the surface nearest to the model, then tightens by `sweeps`.
///
/// A vertex that gains an edge by a flip is placed again. The number of faces stays, and the surface comes no farther
/// from the model. The result is the same for any number of threads.
/// \pre there are no quads
/// \throw Cancelled
void flipEdges(GuardedMesh& surface, int sweeps, Interrupter* interrupter);

} // namespace vdbcage::detail
