#pragma once

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of smooth() under a guard.
struct BoundingSmoothOptions {
    static constexpr Range sweepCounts{0, 100}; ///< of `sweeps`

    int sweeps = 3; ///< times that every vertex is moved; more round off more
};

/// Rounds off a surface that bounds the guard's model and keeps it so, by sweeps of HC Laplacian smoothing. Each vertex
/// moves as far as the guard allows, so mostly outward where the surface is tight. Vertex order stays.
/// Quads count under both diagonals, and are split where one does not bound.
/// \param surface closed, 2-manifold, bounding the model with the guard's clearance
/// \param guard of the model
/// \param options in the ranges of their members
/// \param interrupter told of the progress; may be null
/// \throw InputError when the sweeps are out of range; when the surface is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(sweeps * n log m) for n faces and m of the model.
/// Based on: Vollmer, Mencl, Muller, Improved Laplacian Smoothing of Noisy Surface Meshes, 1999.
VDBCAGE_API Mesh smooth(const Mesh& surface, const BoundingGuard& guard, const BoundingSmoothOptions& options = {},
                        Interrupter* interrupter = nullptr);

} // namespace vdbcage
