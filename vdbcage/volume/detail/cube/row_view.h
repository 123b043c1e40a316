#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/volume/detail/cube/block_row.h>

/// The entries that are full, or not empty, in a row of blocks that is dilated along x, found before any voxel is read.
namespace vdbcage::detail {

/// A row with the blocks on both sides that are within the segment, entry by entry along x.
struct RowView {
    /// The mask must outlive this.
    RowView(const Foreground& foreground, const Segment& segment, const BlockRow& row);

    /// Returns the index in `blocks` of the i-th block of the row itself.
    std::size_t ownBlock(std::size_t i) const { return i + static_cast<std::size_t>(segment.blockRadius); }

    Foreground foreground;
    Segment segment;
    std::size_t ownBlocks;
    std::vector<const FlatBlock*> blocks;                                 ///< null: uniform
    std::array<std::vector<std::uint64_t>, stretchesPerPlane> some, full; ///< by stretch and x, as in a FlatBlock
};

/// One stretch of a block by lines of entries along x: bit 16 y + x of word z is entry (x, y, z) of the stretch.
using BlockLines = std::array<std::uint64_t, entriesPerAxis>;

/// One stretch of a row by lines. It is reused from stretch to stretch, to keep its memory.
struct StretchLines {
    /// Finds the lines of a stretch.
    void find(const RowView& view, std::size_t stretch);

    // By block of the row:
    std::vector<BlockLines> full; ///< entries that full ones nearby make full
    std::vector<BlockLines> open; ///< entries that only voxels decide
    bool isDecided = true;        ///< nothing is open
    // By block of the view, unless isDecided:
    std::vector<BlockLines> fullAround, mixedAround;

private:
    void dilate(const RowView& view, const std::vector<std::uint64_t>& entries, std::size_t radius,
                std::vector<BlockLines>& result);

    std::vector<std::uint64_t> united_;
};

/// The place of a line of entries: the i-th of a stretch has y = 4 stretch + i.
struct Line {
    std::size_t stretch, i, z;

    std::size_t y() const { return 4 * stretch + i; }
    /// Returns its bits among those of its stretch, by x.
    std::uint16_t of(const BlockLines& lines) const { return static_cast<std::uint16_t>(lines[z] >> (16 * i)); }
};

} // namespace vdbcage::detail
