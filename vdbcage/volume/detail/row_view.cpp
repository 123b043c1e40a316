#include <vdbcage/volume/detail/row_view.h>

#include <algorithm>

#include <vdbcage/core/detail/word_bits.h>

namespace vdbcage::detail {

RowView::RowView(const Foreground& foreground_, const Segment& segment_, const BlockRow& row)
    : foreground(foreground_), segment(segment_), ownBlocks(row.blocks),
      blocks(row.blocks + 2 * static_cast<std::size_t>(segment.blockRadius))
{
    for (auto* stretches : {&some, &full}) {
        for (auto& stretch : *stretches) stretch.resize(entriesPerAxis * blocks.size());
    }
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const int step = static_cast<int>(b) - segment.blockRadius;
        const BlockEntries block = foreground.mask.at(row.first.offsetBy(step * blockSize, 0, 0));
        blocks[b] = block.flat;
        for (std::size_t n = 0; n < FlatBlock::wordCount; ++n) {
            const std::size_t stretch = n % stretchesPerPlane, x = entriesPerAxis * b + n / stretchesPerPlane;
            some[stretch][x] = foreground.some(block, n);
            full[stretch][x] = foreground.full(block, n);
        }
    }
}

namespace {

// The entries of the row's own blocks, each united with `radius` on both sides.
std::vector<BlockLines> dilatedEntries(const RowView& view, std::vector<std::uint64_t> values, std::size_t radius)
{
    const std::size_t count = uniteAhead(values.data(), values.size(), 2 * radius + 1);
    std::vector<BlockLines> result(view.ownBlocks);
    std::size_t own = view.ownBlock(0) * entriesPerAxis;
    for (BlockLines& block : result) {
        for (std::uint64_t& entries : block) {
            entries = values[own - radius] | values[own + radius + 1 - count];
            ++own;
        }
    }
    return result;
}

} // namespace

StretchLines stretchLines(const RowView& view, std::size_t stretch)
{
    const auto &some = view.some[stretch], &full = view.full[stretch];
    StretchLines lines;
    // A full entry fills all that are as many entries away as the radius has whole ones.
    lines.full = dilatedEntries(view, full, view.segment.wholeEntries);
    lines.open = dilatedEntries(view, some, view.segment.entryRadius);
    bool isDecided = true;
    for (std::size_t i = 0; i < view.ownBlocks; ++i) {
        for (std::size_t x = 0; x < entriesPerAxis; ++x) {
            lines.open[i][x] &= ~lines.full[i][x];
            if (lines.open[i][x] != 0) isDecided = false;
        }
        transposeLanes(lines.full[i]);
        transposeLanes(lines.open[i]);
    }
    if (isDecided) return lines;
    lines.fullAround.resize(view.blocks.size());
    lines.mixedAround.resize(view.blocks.size());
    for (std::size_t b = 0; b < view.blocks.size(); ++b) {
        for (std::size_t x = 0; x < entriesPerAxis; ++x) {
            const std::size_t i = entriesPerAxis * b + x;
            lines.fullAround[b][x] = full[i];
            lines.mixedAround[b][x] = some[i] & ~full[i];
        }
        transposeLanes(lines.fullAround[b]);
        transposeLanes(lines.mixedAround[b]);
    }
    return lines;
}

} // namespace vdbcage::detail
