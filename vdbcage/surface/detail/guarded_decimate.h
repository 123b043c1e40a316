#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/surface/detail/guarded_surface.h>

/// Edge collapses under the guard. Costs are found side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses edges by their quadric error, as it is where the guard allows the vertex, until `faces` are left or
/// nothing more is allowed. O(n log n) and fast.
void collapseByQuadrics(GuardedSurface& surface, std::size_t faces, Interrupter* interrupter);

/// Collapses edges by the measured growth of the integral of squared distance to the model, and pulls in the ring after
/// each collapse, until `faces` are left or nothing more is allowed. Sees what the quadrics of a coarse surface have
/// forgotten, at ten times the cost.
void collapseByMeasure(GuardedSurface& surface, std::size_t faces, Interrupter* interrupter);

} // namespace vdbcage::detail
