#pragma once

#include <cstddef>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/effort.h>
#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of decimate() under a guard.
struct BoundingDecimateOptions {
    std::size_t faces = 400;      ///< triangles to end with, at least 4
    Effort effort = Effort::fair; ///< time against tightness; decimate() has figures
};

/// Decimates a surface that bounds the guard's model and keeps it so; \ref bounding describes the steps.
/// \param surface closed, 2-manifold, bounding the model with the guard's clearance; quads are split
/// \param guard of the model
/// \param options more faces are left where topology or the guard allow no less
/// \param wishes where faces should go; none by default
/// \param interrupter told of the progress; may be null
/// \throw InputError when fewer than 4 faces are asked for; when the surface is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(n log n log m) for n faces and m of the model. From 20,000 to 400 faces about 0.2 s (fast), 0.5 s (fair),
/// 2 s (best) on two threads.
/// Based on: Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const BoundingDecimateOptions& options = {},
                          const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
