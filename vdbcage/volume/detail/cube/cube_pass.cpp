// A cube is the sum of three segments, so a dilation by it is three passes along one axis each. All three are the same
// code: a pass works along x, where the 64 voxels of a word are 64 lanes, and permutes the axes as it writes: (x, y, z)
// becomes (y, z, x). After three passes they are as before. An erosion is the dilation of the complement.
#include <vdbcage/volume/detail/cube/cube_pass.h>

#include <atomic>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/volume/detail/cube/axis_permutation.h>
#include <vdbcage/volume/detail/cube/block_row.h>
#include <vdbcage/volume/detail/cube/line_dilation.h>
#include <vdbcage/volume/detail/cube/row_view.h>

namespace vdbcage::detail {

namespace {

// Finishes a block from the foreground found in it, which `flip` turns into the mask.
void finish(FlatBlock& block, std::uint64_t flip)
{
    for (std::size_t n = 0; n < FlatBlock::wordCount && flip != 0; ++n) {
        const std::uint64_t some = block.some[n];
        block.some[n] = ~block.full[n];
        block.full[n] = ~some;
    }
    block.words = std::vector<Words>(block.words); // no longer than needed: it is read from cache
    block.finish();
}

template <class Check>
void dilateRow(const Foreground& foreground, const Segment& segment, const BlockRow& row,
               std::unique_ptr<FlatBlock>* result, const Check& check)
{
    const RowView view(foreground, segment, row);
    for (std::size_t i = 0; i < row.blocks; ++i) {
        result[i] = std::make_unique<FlatBlock>();
        result[i]->origin = permuted(row.first.offsetBy(static_cast<int>(i) * blockSize, 0, 0));
        if (const FlatBlock* const own = view.blocks[view.ownBlock(i)]) {
            result[i]->words.reserve(own->words.size());
        }
    }
    StretchLines lines;
    LineEntries entries(view, lines);
    for (std::size_t stretch = 0; stretch < stretchesPerPlane; ++stretch) {
        lines.find(view, stretch);
        if (!lines.isDecided) entries.prefetchStretch(stretch);
        for (std::size_t i = 0; i < 4; ++i) {
            check();
            dilateLines(stretch, i, entries, result);
        }
    }
    for (std::size_t i = 0; i < row.blocks; ++i) finish(*result[i], foreground.flip);
}

// Returns the mask with its foreground dilated along x and its axes permuted.
EntrySet dilatedAlongX(const Foreground& foreground, const Segment& segment, const Progress& progress)
{
    progress.check(0, 1);
    const std::vector<BlockRow> rows = rowsToDilate(foreground, segment, progress);
    std::vector<std::unique_ptr<FlatBlock>> built(rows.empty() ? 0 : rows.back().start + rows.back().blocks);
    std::atomic<std::size_t> done{0};
    parallelFor(std::size_t{0}, rows.size(), [&](std::size_t i) {
        dilateRow(foreground, segment, rows[i], &built[rows[i].start],
                  [&] { progress.check(done++, rows.size() * entriesPerAxis); });
    });
    FullParts full = foreground.mask.full();
    for (auto* origins : {&full.upperNodes, &full.blocks}) {
        for (Coord& origin : *origins) origin = permuted(origin);
    }
    return {std::move(full), std::move(built), progress};
}

} // namespace

MaskTree::Ptr applyCube(const MaskTree& mask, std::initializer_list<CubeStep> steps, const Progress& progress)
{
    const int parts = 3 * static_cast<int>(steps.size()) + 2;
    int part = 0;
    EntrySet set(mask, progress.part(part++, parts));
    for (const CubeStep& step : steps) {
        const auto side = step.kind == CubeStep::dilation ? Foreground::Side::mask : Foreground::Side::complement;
        for (int axis = 0; axis < 3; ++axis) {
            set = dilatedAlongX(Foreground(set, side), Segment(step.radius), progress.part(part++, parts));
        }
    }
    return std::move(set).tree(progress.part(part, parts));
}

} // namespace vdbcage::detail
