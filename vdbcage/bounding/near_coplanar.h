#pragma once

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Moves vertices of a bounding surface by a trifle so that its edges are flat or bend by 0.11 degrees at least, as far
/// as the guard allows; \ref bounding has the reasons.
/// \param surface closed, 2-manifold, of triangles, bounding the model with the guard's clearance
/// \param guard of the model
/// \param interrupter asked whether to stop; may be null
/// \return the surface with the same connectivity and vertex order; deterministic
/// \throw InputError when there is a quad; when the surface is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(faces).
VDBCAGE_API Mesh bendNearCoplanarEdges(const Mesh& surface, const BoundingGuard& guard,
                                       Interrupter* interrupter = nullptr);

} // namespace vdbcage
