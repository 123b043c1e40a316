#pragma once

#include <vdbcage/core/interrupter.h>
#include <vdbcage/surface/detail/guarded_surface.h>

namespace vdbcage::detail {

/// Makes pairs of faces quads, under the guard: flat, square ones along the directions of curvature first, then others
/// where that leaves fewer triangles. No quad's triangles meet at more than `mergeAngleDegrees` (as
/// GuardedSurface::limitQuadFold, which this sets). Where a pair is too folded, or its other diagonal in the model's
/// way, the lower diagonal's ends are pushed outward. Serial; O(n log n log m) for n faces and m of the model.
void pairUp(GuardedSurface& surface, double mergeAngleDegrees, Interrupter* interrupter);

} // namespace vdbcage::detail
