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
    Effort effort = Effort::fair; ///< time against tightness; decimate() gives figures
};

/// Decimates a surface that bounds the guard's model and keeps it so.
///
/// The surface is drawn towards the model. Edges are then collapsed by quadric error, each collapse under the guard:
/// its vertex is pushed outward until it is allowed, and drawn back along what it touches (fast). Then edges are split
/// and others collapsed for them (fair: 5 to 10 % tighter). With more effort edges are flipped too, and the surface is
/// perturbed in turns (best: some percent tighter still).
///
/// Quads are split, points that no face uses are dropped. More faces than asked for are left where topology (each
/// handle and each part needs some) or the guard allow no less. The same for any number of threads.
/// \pre `surface` is closed, 2-manifold and bounds the model with the guard's clearance
/// \throw InputError fewer than 4 faces asked for; not closed and 2-manifold
/// \throw Cancelled
/// Cost: O(n log n log m) for n faces and m of the model. From 20,000 to 400 faces about 0.2 s (fast), 0.5 s (fair),
/// 2 s (best) on two threads.
/// Based on: Garland and Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const BoundingDecimateOptions& options = {},
                          const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
