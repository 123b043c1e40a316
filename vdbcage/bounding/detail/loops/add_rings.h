#pragma once

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Splits loops until each joint has the rings that are wanted, as far as the guard allows.
/// \throw Cancelled
void addRings(GuardedMesh& surface, QuadTable& table, Interrupter* interrupter);

} // namespace vdbcage::detail
