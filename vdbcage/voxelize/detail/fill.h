#pragma once

#include <vdbcage/core/interrupter.h>
#include <vdbcage/voxelize/detail/bit_grid.h>

namespace vdbcage::detail {

/// Sets every voxel of `bits` that no path of zero voxels, across faces, joins to the outside of the box.
/// \throw Cancelled
/// Cost: O(words of bits + enclosed and hidden voxels). It takes memory only where a voxel lies between set ones both
/// along y and along z.
void fillEnclosed(BitGrid& bits, Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
