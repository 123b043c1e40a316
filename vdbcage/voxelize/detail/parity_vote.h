#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/slabbed_triangles.h>

namespace vdbcage::detail {

/// Returns the parities along x with which the rays enter each slab, a plane of `planeWords` words each, and then those
/// with which they leave the last slab. The latter are odd where rays leak because the model is open.
/// \throw Cancelled
/// Cost: O(triangles in slabs + their rows + words), in parallel.
std::vector<BitGrid::Word> paritiesAlongX(const SlabbedTriangles& triangles, int wordsPerRow, std::size_t planeWords,
                                          Interrupter* interrupter);

/// Finds the inside of a model in plane x of a slab from the crossings there.
///
/// It adds to `surface` the voxels where at least two of the three parities are odd and of rays that do not leak, and
/// clears the crossings. `alongX` has the parities along x of the plane before, and afterwards of this one. `leakingX`
/// has the leaking rays along x. `rows` has room for two rows.
/// Cost: O(words of the plane).
void voteInside(const Slab& slab, int x, BitGrid::Word* alongX, const BitGrid::Word* leakingX, BitGrid::Word* rows);

/// Does the same for all planes of a slab, in parallel; `crossed` need not be set. `alongX` has the parities along x of
/// the plane before the first, and afterwards of the last.
/// \throw Cancelled
void voteInside(const Slab& slab, BitGrid::Word* alongX, const BitGrid::Word* leakingX, Interrupter* interrupter);

} // namespace vdbcage::detail
