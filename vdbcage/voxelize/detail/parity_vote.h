#pragma once

#include <vdbcage/core/interrupter.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/face_scan.h>

namespace vdbcage::detail {

/// The inside of a model in plane x of a slab, from the crossings that were found there: adds to `surface` what at
/// least two of the three parities hold to be inside, and clears the crossings. `alongX` holds the parities along x of
/// the plane before, and then of this one; `row` is room for a row. O(words of the plane).
void voteInside(const Slab& slab, int x, BitGrid::Word* alongX, BitGrid::Word* row);

/// The same for all planes of a slab, of which `crossed` is not needed; TBB-parallel. `alongX` holds the parities along
/// x of the plane before the first, and then of the last. \throw Cancelled
void voteInside(const Slab& slab, BitGrid::Word* alongX, Interrupter* interrupter);

} // namespace vdbcage::detail
