#pragma once

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The options of smooth() without a guard; `alpha` and `beta` are those of the paper.
struct SmoothOptions {
    static constexpr Range iterationCounts{0, 100}; ///< of `iterations`
    static constexpr Range alphas{0, 1};            ///< of `alpha`
    static constexpr Range betas{0, 1};             ///< of `beta`

    int iterations = 3; ///< times that every vertex is moved; with 0 the surface stays as it is
    double alpha = 0;   ///< place that a vertex is drawn back to: 0 where it was before the iteration, 1 where it began
    double beta = 0.5;  ///< share of a vertex's own correction; the rest is the mean of its neighbours' corrections
};

/// Rounds a surface off by HC Laplacian smoothing, which does not shrink it.
///
/// Connectivity and vertex order stay. Vertices that no face uses stay where they are. The result is the same for any
/// number of threads.
/// \param surface any polygon soup; quads are smoothed as quads
/// \param options all in range
/// \param interrupter told of progress; may be null
/// \throw InputError when an option is out of range, or requireUsable() refuses the surface
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(iterations * edges), in parallel.
/// Based on: Vollmer, Mencl, Muller, Improved Laplacian Smoothing of Noisy Surface Meshes, 1999.
VDBCAGE_API Mesh smooth(const Mesh& surface, const SmoothOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
