#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

struct PairingOptions {
    double mergeAngleDegrees; ///< no quad's triangles meet at more (as GuardedMesh::limitQuadFold, which is set)
    double share;             ///< of the faces that are to be quads
    std::size_t reach;        ///< so many pairs are made anew to bring two triangles together, at most
    double mostLoss;          ///< of distance to the model that a change may cost, in parts of what a face less costs
    bool collapses;           ///< whether edges may be collapsed for it
    bool splits;              ///< whether polychords may be split for it, of twice `reach` at most
};

/// The part of the faces that are quads, 0 to 1.
double quadShare(const GuardedMesh& surface);

/// Makes pairs of faces quads, under the guard: first, flat and square ones along the directions of curvature before
/// others, all that cost no more distance to the model than a face less brings. Then, until the share is reached, the
/// other pairs; then triangles are brought together through the quads between them, each of which is split along
/// either diagonal and paired anew; then two that are so brought together, but are no quad, vanish by collapsing the
/// edge between them; and last the polychord between two triangles is split in two lengthwise, which makes them
/// quads and needs nothing of how vertices are joined, but brings more faces. Where a pair is too folded, or its other
/// diagonal in the model's way, the lower diagonal's ends are pushed outward. What moves the surface farther away than
/// `mostLoss` is undone, but for the pairs of the beginning. Serial; O(n log n log m) for n faces and
/// m of the model, and O(n) for each way that is tried to bring two triangles together, which keeps a copy to go back
/// to.
void pairUp(GuardedMesh& surface, const PairingOptions& options, Interrupter* interrupter);

} // namespace vdbcage::detail
