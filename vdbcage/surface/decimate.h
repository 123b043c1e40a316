#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The options of decimate() without a guard.
struct DecimateOptions {
    std::size_t faces = 400; ///< triangles to end with, at least 4
};

/// Decimates a surface to at most DecimateOptions::faces triangles by quadric error, with optimal placement. Quads are
/// split first. Topology is kept, so the result can have more triangles than asked, which is not an error. The
/// \ref surface "page of this room" says which other properties are kept.
/// \param surface an oriented 2-manifold; it may have boundaries
/// \param options at least 4 faces
/// \param interrupter told of progress; may be null
/// \throw InputError when fewer than 4 faces are asked for, requireUsable() refuses the surface, it is no oriented
/// 2-manifold, or its coordinates are too large to subtract
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(n log n), about 7 s for a million triangles, on one thread, and 400 bytes each.
/// Based on: Garland, Heckbert, Surface Simplification Using Quadric Error Metrics, 1997.
VDBCAGE_API Mesh decimate(const Mesh& surface, const DecimateOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
