#pragma once

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// How smooth() without a guard rounds off; `alpha` and `beta` are those of the paper.
struct SmoothOptions {
    static constexpr Range iterationCounts{0, 100}; ///< of `iterations`
    static constexpr Range alphas{0, 1};            ///< of `alpha`
    static constexpr Range betas{0, 1};             ///< of `beta`

    int iterations = 3; ///< times that every vertex is moved; with 0 the surface stays as it is
    double alpha = 0;   ///< what a vertex is drawn back to: 0 where it was before the iteration, 1 where it began
    double beta = 0.5;  ///< share of a vertex's own correction; the rest is the mean of its neighbours' corrections
};

/// HC Laplacian smoothing: rounds a surface without shrinking it.
///
/// Connectivity and vertex order stay. Vertices that no face uses stay where they are. The same for any number of
/// threads.
/// \throw InputError an option out of range; no usable face
/// \throw Cancelled
/// Cost: O(iterations * edges), in parallel.
/// Based on: Vollmer, Mencl, Muller, Improved Laplacian Smoothing of Noisy Surface Meshes, 1999.
VDBCAGE_API Mesh smooth(const Mesh& surface, const SmoothOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
