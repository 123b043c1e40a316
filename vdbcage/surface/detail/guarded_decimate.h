#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/surface/detail/guarded_surface.h>

/// Edge collapses under the guard. Costs are found side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses edges by their quadric error until `faces` are left or nothing more is allowed: fast.
void collapseByQuadrics(GuardedSurface& surface, std::size_t faces, Interrupter* interrupter);

/// Collapses edges by the measured growth of the integral of squared distance to the model, until `faces` are left or
/// nothing more is allowed: tight. `thorough`: places vertices with more care and pulls in the ring after each collapse
/// (some 5 % tighter, twice the time).
void collapseByMeasure(GuardedSurface& surface, std::size_t faces, bool thorough, Interrupter* interrupter);

} // namespace vdbcage::detail
