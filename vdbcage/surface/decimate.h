#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

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

} // namespace vdbcage
