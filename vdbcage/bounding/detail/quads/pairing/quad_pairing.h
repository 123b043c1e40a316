#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

struct PairingOptions {
    double mergeAngleDegrees; ///< no quad's triangles meet at more (as GuardedMesh::limitQuadFold, which is set)
    double share;             ///< of the faces, to become quads
    std::size_t maxPathPairs; ///< pairs of faces on an alternating path; polychords have at most twice as many quads
    double maxLoss;           ///< distance to the model that a change may cost, in parts of a mean face's
    bool collapses;           ///< whether edges may be collapsed at the end of a path
    bool splits;              ///< whether polychords may be split
};

/// Returns the part of the faces that are quads, 0 to 1.
double quadShare(const GuardedMesh& surface);

/// Pairs triangles to quads, under the guard.
///
/// It first merges all candidates that cost no more distance to the model than one face less is worth, best first. The
/// other stages go on until the share is reached:
/// - merge the other candidates,
/// - make quads of triangles that alternating paths bring together, then remove others by a collapse,
/// - split polychords between two triangles, which adds faces.
/// Changes that cost more than `maxLoss` are undone, except merges of candidates. Serial.
/// \throw Cancelled
/// Cost: O(n log n log m) for n faces and m of the model, and O(n) for each path or polychord that is tried.
void pairUp(GuardedMesh& surface, const PairingOptions& options, Interrupter* interrupter);

} // namespace vdbcage::detail
