#include <vdbcage/volume/detail/cube/block_row.h>

#include <algorithm>
#include <cstdlib>

#include <vdbcage/volume/detail/cube/axis_permutation.h>

namespace vdbcage::detail {

namespace {

constexpr std::size_t longestRow = 4; // longer ones share more, but leave the last thread with one alone

bool isBefore(const Coord& a, const Coord& b)
{
    return permuted(a) < permuted(b); // x last
}

// Returns the blocks within the segment of a block on the shell, sorted.
std::vector<Coord> candidates(const Foreground& foreground, const Segment& segment, const Progress& progress)
{
    std::vector<Coord> shell = foreground.mask.shell();
    std::sort(shell.begin(), shell.end(), isBefore);
    progress.check(0, 1);
    std::vector<Coord> result;
    for (const Coord& origin : shell) {
        for (int step = -segment.blockRadius; step <= segment.blockRadius; ++step) {
            const Coord near = origin.offsetBy(step * blockSize, 0, 0);
            if (result.empty() || isBefore(result.back(), near)) result.push_back(near);
        }
    }
    return result;
}

// Returns whether the block `steps` blocks along x after another (before it, if below 0) has foreground within the
// segment of that one.
bool isWithin(const Foreground& foreground, const Segment& segment, const Coord& origin, int steps)
{
    const BlockEntries block = foreground.mask.at(origin.offsetBy(steps * blockSize, 0, 0));
    if (!block.flat) return !foreground.isEmpty(block);
    const std::size_t between = static_cast<std::size_t>(std::abs(steps) - 1) * entriesPerAxis;
    const std::size_t planes = std::min(segment.entryRadius - between, std::size_t{entriesPerAxis});
    const std::size_t count = stretchesPerPlane * planes, first = steps < 0 ? FlatBlock::wordCount - count : 0;
    std::uint64_t any = 0;
    for (std::size_t n = first; n < first + count; ++n) any |= foreground.some(block, n);
    return any != 0;
}

bool isToDilate(const Foreground& foreground, const Segment& segment, const Coord& origin)
{
    const BlockEntries own = foreground.mask.at(origin);
    if (foreground.isFull(own)) return false;
    if (!foreground.isEmpty(own)) return true;
    for (int step = 1; step <= segment.blockRadius; ++step) {
        if (isWithin(foreground, segment, origin, -step) || isWithin(foreground, segment, origin, step)) return true;
    }
    return false;
}

} // namespace

std::vector<BlockRow> rowsToDilate(const Foreground& foreground, const Segment& segment, const Progress& progress)
{
    std::vector<BlockRow> rows;
    std::size_t count = 0;
    for (const Coord& origin : candidates(foreground, segment, progress)) {
        if (!isToDilate(foreground, segment, origin)) continue;
        const bool continues =
            !rows.empty() && rows.back().blocks < longestRow &&
            origin == rows.back().first.offsetBy(static_cast<int>(rows.back().blocks) * blockSize, 0, 0);
        if (continues) {
            ++rows.back().blocks;
        } else {
            rows.push_back({origin, 1, count});
        }
        ++count;
    }
    return rows;
}

} // namespace vdbcage::detail
