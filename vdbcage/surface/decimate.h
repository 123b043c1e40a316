#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/effort.h>

namespace vdbcage {

struct DecimateOptions {
    std::size_t faces = 400; ///< triangles to end with, at least 4
};

/// Quadric error decimation to at most `faces` triangles, with optimal placement. Quads are split first. Topology is
/// kept (link condition): so the result can have more triangles than asked, which is not an error, and a closed
/// 2-manifold stays one. No triangle turns over, folds onto its neighbour or becomes a sliver as far as that can be
/// avoided; on flat ground the triangles become even. Boundaries stay in place. Points that are not moved keep their
/// exact values, points without faces are dropped. Does not depend on the size or place of the surface.
/// \throw InputError (fewer than 4 faces asked for; no usable face; not an oriented 2-manifold), Cancelled.
/// O(n log n): about 7 s for a million triangles, on one thread, and 400 bytes each.
/// Based on: Garland, Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const DecimateOptions& options = {}, Interrupter* interrupter = nullptr);

/// Decimates a surface that bounds `guard`'s model and keeps it so: it is drawn towards the model, and every collapse
/// has to pass the guard, its vertex pushed outward until it does and then drawn back along what it touches (fast).
/// Then vertices are exchanged between places (fair: 5 to 10 % tighter), and, edges flipped too, shaken and exchanged
/// in turns (best: some percent tighter still). Quads are split, points that no face uses are dropped. More than the
/// faces asked for are left where topology (each handle and each part needs some) or the guard allow no less.
/// TBB-parallel, same result for any number of threads. \pre `surface` is closed, 2-manifold and bounds the model with
/// the guard's clearance \throw InputError (fewer than 4 faces asked for; not closed and 2-manifold), Cancelled O(n log
/// n log m) for n faces and m of the model: from 20,000 to 400 faces about 0.2 s (fast), 0.5 s (fair), 2 s (best) on
/// two threads.
VDBCAGE_API Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const DecimateOptions& options,
                          Effort effort = Effort::fair, Interrupter* interrupter = nullptr);

/// Guarded decimations of one surface to any number of face counts. What these share, which is the way from the surface
/// to a few times the faces, is done once: a third to a half of the time (fair, fast). A value that can be moved.
class VDBCAGE_API GuardedDecimation {
public:
    /// `guard` must live as long as this. As decimate() otherwise. \throw InputError (not closed and 2-manifold),
    /// Cancelled
    GuardedDecimation(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter = nullptr);
    ~GuardedDecimation();
    GuardedDecimation(GuardedDecimation&&) noexcept;
    GuardedDecimation& operator=(GuardedDecimation&&) noexcept;

    /// The same as decimate(), whatever was asked for before. \throw InputError (fewer than 4 faces asked for),
    /// Cancelled; it can be asked again then
    Mesh to(const DecimateOptions& options, Effort effort = Effort::fair, Interrupter* interrupter = nullptr);

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace vdbcage
