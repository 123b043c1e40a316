#pragma once

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/effort.h>
#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of tighten(), which trade time against tightness.
struct TightenOptions {
    static constexpr Range sweepCounts{0, 100};        ///< of `sweeps`
    static constexpr Range perturbationCounts{0, 100}; ///< of `perturbations`
    static constexpr Range sampleCounts{1, 100};       ///< of `samples`

    int sweeps = 16; ///< times that each vertex is tried, at most
    /// Times that it is pushed out a little and tightened again, kept where tighter. If any, sweeps of small steps end
    /// it, which lay faces flat over flat parts of the model.
    int perturbations = 0;
    int samples = 4; ///< of the distance, for a face of mean size: more cost more and are a percent tighter
};

/// How a cage of this effort is tightened last: with no perturbation and fewer samples (fast), one perturbation (fair),
/// or two and more samples (best).
[[nodiscard]] VDBCAGE_API TightenOptions tightenOptions(Effort effort);

/// Pulls a bounding surface onto its model.
///
/// One vertex at a time goes to where the integral of the distance to the model over its star is least. It goes as far
/// as the guard allows, sliding along what it touches. Connectivity and vertex order stay. The mean distance never
/// grows. Quads count under both diagonals, and are split where one does not bound.
/// \pre `cage` is closed, 2-manifold and bounds the model with the guard's clearance
/// \throw InputError an option out of range; not closed and 2-manifold
/// \throw Cancelled
/// Cost: O(sweeps * (1 + perturbations) * n log m) for n faces and m of the model.
VDBCAGE_API Mesh tighten(const Mesh& cage, const BoundingGuard& guard, const TightenOptions& options = {},
                         const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
