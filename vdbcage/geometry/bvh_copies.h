#pragma once

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_leaves.h>

namespace vdbcage::detail {

/// Keeps the first of refs with the same triangles, whose corners may be in any order; returns the end of those left.
/// \throw Cancelled
/// Cost: O(n).
LeafRef* dropCopies(const BvhTriangles& triangles, LeafRef* first, LeafRef* last, Interrupter* interrupter);

} // namespace vdbcage::detail
