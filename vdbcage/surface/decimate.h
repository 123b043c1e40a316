#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of decimate() without a guard.
struct DecimateOptions {
    std::size_t faces = 400; ///< triangles to end with, at least 4
};

/// Quadric error decimation to at most `faces` triangles, with optimal placement.
///
/// Quads are split first. Topology is kept by the link condition, and a closed 2-manifold stays one. So the result can
/// have more triangles than asked, which is not an error. As far as can be avoided, no triangle turns over, folds onto
/// its neighbour or becomes a sliver. On flat ground the triangles become even. Boundaries stay in place. Points that
/// are not moved keep their exact values; points without faces are dropped. The size and place of the surface do not
/// matter.
/// \throw InputError fewer than 4 faces asked for; no usable face; not an oriented 2-manifold; coordinates too large to
/// subtract
/// \throw Cancelled
/// Cost: O(n log n), about 7 s for a million triangles, on one thread, and 400 bytes each.
/// Based on: Garland, Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const DecimateOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
