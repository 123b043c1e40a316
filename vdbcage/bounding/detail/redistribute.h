#pragma once

#include <vdbcage/bounding/detail/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Takes vertices from where they bring little to where they bring more: the edges whose split brings the surface
/// nearest to the model are split, the surface is tightened by `sweeps`, as many edges are collapsed by the quadrics
/// that it has then, and it is tightened again. Done `rounds` times; a round that did not bring the surface nearer is
/// undone, and fewer edges are split. The number of faces does not grow. TBB-parallel, deterministic.
void redistribute(GuardedMesh& surface, int rounds, int sweeps, Interrupter* interrupter);

/// Flips the edges whose flip, with the vertex that it adds an edge to placed anew, brings the surface nearest to the
/// model, then tightens by `sweeps`: the number of faces stays, and the surface comes no farther. \pre there are no
/// quads. TBB-parallel, deterministic.
void flipEdges(GuardedMesh& surface, int sweeps, Interrupter* interrupter);

} // namespace vdbcage::detail
