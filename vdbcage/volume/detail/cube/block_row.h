#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/volume/detail/cube/foreground.h>
#include <vdbcage/volume/detail/cube/segment.h>
#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

/// Blocks side by side along x, which share most of their neighbours.
struct BlockRow {
    Coord first;
    std::size_t blocks;
    std::size_t start; ///< of its blocks among those of all rows
};

/// Returns the blocks that a dilation along x may change: they are not full, but have foreground within the segment.
/// \throw Cancelled
std::vector<BlockRow> rowsToDilate(const Foreground& foreground, const Segment& segment, const Progress& progress);

} // namespace vdbcage::detail
