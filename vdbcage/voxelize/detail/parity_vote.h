#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/voxelize/detail/bit_grid.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/detail/slabbed_triangles.h>

namespace vdbcage::detail {

/// The parities along x with which the rays enter each slab, a plane of `planeWords` words each, and then those with
/// which they leave the last. The last are odd where rays leak, which they do where the model is open.
/// \throw Cancelled
/// Cost: O(triangles in slabs + their rows + words), in parallel.
std::vector<BitGrid::Word> paritiesAlongX(const SlabbedTriangles& triangles, int wordsPerRow, std::size_t planeWords,
                                          Interrupter* interrupter);

/// Finds the inside of a model in plane x of a slab from the crossings that were found there.
///
/// It adds to `surface` what at least two of the three parities hold to be inside, those of rays that leak left out,
/// and clears the crossings. `alongX` holds the parities along x of the plane before, and then of this one. `leakingX`
/// has the rays along x that leak. `rows` is room for two rows.
/// Cost: O(words of the plane).
void voteInside(const Slab& slab, int x, BitGrid::Word* alongX, const BitGrid::Word* leakingX, BitGrid::Word* rows);

/// The same for all planes of a slab, of which `crossed` is not needed. In parallel. `alongX` holds the parities along
/// x of the plane before the first, and then of the last.
/// \throw Cancelled
void voteInside(const Slab& slab, BitGrid::Word* alongX, const BitGrid::Word* leakingX, Interrupter* interrupter);

} // namespace vdbcage::detail
