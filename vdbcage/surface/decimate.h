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
/// kept (link condition), no triangle flips its normal or becomes a sliver as far as that can be avoided; so the
/// result can have more triangles than asked, which is not an error. A closed 2-manifold stays one.
/// \throw InputError (the surface is not an oriented 2-manifold), Cancelled. O(n log n).
/// Based on: Garland, Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const DecimateOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
