#include <vdbcage/volume/detail/cube/row_view.h>

#include <vdbcage/core/detail/word_bits.h>

namespace vdbcage::detail {

RowView::RowView(const Foreground& foregroundSeen, const Segment& segmentAround, const BlockRow& row)
    : foreground(foregroundSeen), segment(segmentAround), ownBlocks(row.blocks),
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

void StretchLines::find(const RowView& view, std::size_t stretch)
{
    const auto &viewSome = view.some[stretch], &viewFull = view.full[stretch];
    // A full entry fills all entries that are at most as many entries away as the radius has whole ones.
    dilate(view, viewFull, view.segment.wholeEntries, full);
    dilate(view, viewSome, view.segment.entryRadius, open);
    isDecided = true;
    for (std::size_t i = 0; i < view.ownBlocks; ++i) {
        for (std::size_t x = 0; x < entriesPerAxis; ++x) {
            open[i][x] &= ~full[i][x];
            if (open[i][x] != 0) isDecided = false;
        }
        transposeLanes(full[i]);
        transposeLanes(open[i]);
    }
    if (isDecided) return;
    fullAround.resize(view.blocks.size());
    mixedAround.resize(view.blocks.size());
    for (std::size_t b = 0; b < view.blocks.size(); ++b) {
        for (std::size_t x = 0; x < entriesPerAxis; ++x) {
            const std::size_t viewX = entriesPerAxis * b + x;
            fullAround[b][x] = viewFull[viewX];
            mixedAround[b][x] = viewSome[viewX] & ~viewFull[viewX];
        }
        transposeLanes(fullAround[b]);
        transposeLanes(mixedAround[b]);
    }
}

// Returns the entries of the row's own blocks, each united with `radius` entries on both sides.
void StretchLines::dilate(const RowView& view, const std::vector<std::uint64_t>& entries, std::size_t radius,
                          std::vector<BlockLines>& result)
{
    united_ = entries;
    const std::size_t count = uniteAhead(united_.data(), united_.size(), 2 * radius + 1);
    result.resize(view.ownBlocks);
    std::size_t own = view.ownBlock(0) * entriesPerAxis;
    for (BlockLines& block : result) {
        for (std::uint64_t& word : block) {
            word = united_[own - radius] | united_[own + radius + 1 - count];
            ++own;
        }
    }
}

} // namespace vdbcage::detail
