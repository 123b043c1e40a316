#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/surface/detail/guarded_surface.h>

/// Edge collapses under the guard. Costs are found side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Collapses edges by their quadric error, as it is where the guard allows the vertex, until `faces` are left or
/// nothing more is allowed. O(n log n) and fast.
void collapseByQuadrics(GuardedSurface& surface, std::size_t faces, Interrupter* interrupter);

} // namespace vdbcage::detail
