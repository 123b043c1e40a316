#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/volume/detail/block_row.h>

/// What a pass along x knows of a row of blocks before it looks at voxels: which entries are not empty, and which full.
namespace vdbcage::detail {

/// A row with the blocks on both sides that are within the segment, entry by entry along x.
struct RowView {
    RowView(const Foreground& foreground, const Segment& segment, const BlockRow& row);

    /// The place of the i-th block of the row itself, in `blocks`.
    std::size_t ownBlock(std::size_t i) const { return i + static_cast<std::size_t>(segment.blockRadius); }

    Foreground foreground;
    Segment segment;
    std::size_t ownBlocks;
    std::vector<const FlatBlock*> blocks;                                 ///< null: uniform
    std::array<std::vector<std::uint64_t>, stretchesPerPlane> some, full; ///< by x, as in a FlatBlock
};

/// One stretch of a block, 4 x 16 lines of entries along x. Bit x of lane i of word z is entry (x, z) of the i-th line.
using BlockLines = std::array<std::uint64_t, entriesPerAxis>;

/// The lines of one stretch of a row.
struct StretchLines {
    // By block of the row:
    std::vector<BlockLines> full; ///< entries that full ones nearby make full
    std::vector<BlockLines> open; ///< entries that only their voxels tell of
    // By block of the view; none if nothing is open:
    std::vector<BlockLines> fullAround, mixedAround;
};
StretchLines stretchLines(const RowView& view, std::size_t stretch);

/// The place of a line of entries.
struct Line {
    std::size_t stretch, lane, z;

    std::size_t y() const { return 4 * stretch + lane; }
    /// Its bits among those of its stretch, by x.
    std::uint16_t of(const BlockLines& lines) const { return static_cast<std::uint16_t>(lines[z] >> (16 * lane)); }
};

} // namespace vdbcage::detail
