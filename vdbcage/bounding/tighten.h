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
    /// Times that the surface is pushed out a little and tightened again, kept where tighter. If there are any, sweeps
    /// of small steps come last, which lay faces flat over flat parts of the model.
    int perturbations = 0;
    int samples = 4; ///< of the distance, for a face of mean size: more cost more and are a percent tighter
};

/// Returns the options by which a cage of an effort is tightened last: no perturbation and fewer samples (fast), one
/// perturbation (fair), or two and more samples (best).
/// \param effort any
[[nodiscard]] VDBCAGE_API TightenOptions tightenOptions(Effort effort);

/// Pulls a bounding surface onto its model; \ref bounding tells how. Its mean distance never grows.
/// Quads count under both diagonals, and are split where one does not bound.
/// \param cage closed, 2-manifold, bounding the model with the guard's clearance
/// \param guard of the model
/// \param options in the ranges of their members
/// \param wishes where faces should go; none by default
/// \param interrupter told of the progress; may be null
/// \return the surface with the same connectivity and vertex order
/// \throw InputError when an option is out of range; when the surface is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(sweeps * (1 + perturbations) * n log m) for n faces and m of the model.
VDBCAGE_API Mesh tighten(const Mesh& cage, const BoundingGuard& guard, const TightenOptions& options = {},
                         const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
