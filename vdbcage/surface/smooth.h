#pragma once

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

struct SmoothOptions {
    static constexpr Range iterationCounts{0, 100}, alphas{0, 1}, betas{0, 1};

    int iterations = 3;
    double alpha = 0;  ///< pull towards the original position
    double beta = 0.5; ///< weight of a vertex's own correction against its neighbours'
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
