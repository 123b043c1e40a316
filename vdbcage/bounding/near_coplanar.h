#pragma once

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Moves vertices of a bounding surface by a trifle so that its edges are flat or bend by 0.11 degrees at least, as far
/// as the guard allows.
///
/// An edge is flat if a corner of its triangles is at most 3e-5 of the model's longest side off the other's plane. Mesh
/// generators take triangles that meet under less than 0.1 degrees for one flat face. TetGen fails where these are not
/// flat, and a cage over a flat part of a model has many. Connectivity and vertex order stay. Most cages change little
/// or not at all; those of flat models get looser by about 1.5e-4 of the longest side. Deterministic.
/// \pre `surface` is closed, 2-manifold, of triangles, and bounds the guard's model with its clearance
/// \throw InputError a quad; not closed and 2-manifold
/// \throw Cancelled
/// Cost: O(faces).
VDBCAGE_API Mesh bendNearCoplanarEdges(const Mesh& surface, const BoundingGuard& guard,
                                       Interrupter* interrupter = nullptr);

} // namespace vdbcage
