#include <vdbcage/deform/detail/weight_blocks.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/detail/interpolative.h>
#include <vdbcage/deform/detail/kernels/row_kernels.h>

namespace vdbcage::detail {

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace {

// The larger a block, the fewer of its points are held (of 100000 in a cage of 400 quads 50 % by 128, 33 % by 256), but
// the longer it takes to find the combinations of the others and to compute them: at this size 3 to 16 % of the time of
// computing the weights.
constexpr std::size_t blockSize = 256;
// Points of a group are side by side, so that the work for one weight is the same for all of them.
constexpr std::size_t groupSize = 16;
// Posing is as fast as weights come from memory, and processors do not prefetch far enough on their own. Weights are
// prefetched this many moves ahead, which takes four tenths off the time (AMD Zen).
constexpr std::size_t movesAhead = 24;
// The number of moves that are summed up at a time: rounding grows with the length of a sum.
constexpr std::size_t movesTogether = 64;

/// A move of a group: its weights are `offset` floats behind the first of the group.
struct Move {
    std::uint32_t offset;
    float x, y, z;
};

/// All moves of a group; after them, for lookAhead(), the places of the same weights in the next group.
class Moves {
public:
    void clear() { moves_.clear(); }
    void add(std::size_t column, const Vec3f& motion)
    {
        moves_.push_back({static_cast<std::uint32_t>(column * groupSize), motion.x(), motion.y(), motion.z()});
    }
    void lookAhead(std::size_t columns)
    {
        count_ = moves_.size();
        for (std::size_t i = 0; i < movesAhead && count_ > 0; ++i) {
            moves_.push_back({moves_[i].offset + static_cast<std::uint32_t>(columns * groupSize), 0, 0, 0});
        }
    }
    std::size_t size() const { return count_; }
    const Move& operator[](std::size_t i) const { return moves_[i]; }

private:
    std::vector<Move> moves_;
    std::size_t count_ = 0;
};

struct GroupSums {
    float x[groupSize] = {}, y[groupSize] = {}, z[groupSize] = {};

    Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// Returns the moves of a group whose weights begin at `weights`.
GroupSums sumUp(const float* weights, const Moves& moves)
{
    GroupSums sums;
    for (std::size_t first = 0; first < moves.size(); first += movesTogether) {
        GroupSums part;
        for (std::size_t m = first; m < std::min(moves.size(), first + movesTogether); ++m) {
            const Move& move = moves[m];
            const float* const weight = weights + move.offset;
            // As a number, since it may lie behind the last group.
            __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::uintptr_t>(weights) +
                                                             moves[m + movesAhead].offset * sizeof(float)));
            for (std::size_t i = 0; i < groupSize; ++i) {
                part.x[i] += weight[i] * move.x;
                part.y[i] += weight[i] * move.y;
                part.z[i] += weight[i] * move.z;
            }
        }
        for (std::size_t i = 0; i < groupSize; ++i) {
            sums.x[i] += part.x[i];
            sums.y[i] += part.y[i];
            sums.z[i] += part.z[i];
        }
    }
    return sums;
}

using Indices = std::vector<std::uint32_t>;

/// Sorts indices of points, `blockSize` to a block. It halves the points across the longest side of their box until
/// they fit a block, and blocks in the same way down to `packetSize`.
void sortIntoBlocks(const std::vector<Vec3d>& points, Indices::iterator begin, Indices::iterator end,
                    Interrupter* interrupter)
{
    const auto count = static_cast<std::size_t>(end - begin);
    if (count <= packetSize) {
        std::sort(begin, end);
        return;
    }
    throwIfInterrupted(interrupter);
    openvdb::BBoxd box;
    std::for_each(begin, end, [&](std::uint32_t i) { box.expand(points[i]); });
    const auto axis = static_cast<int>(box.maxExtent());
    const std::size_t unit = count > blockSize ? blockSize : packetSize;
    const std::size_t countBefore = (count + unit - 1) / unit / 2 * unit;
    const auto middle = begin + static_cast<std::ptrdiff_t>(countBefore);
    Asker ask(interrupter);
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
        ask();
        return std::pair(points[a][axis], a) < std::pair(points[b][axis], b);
    });
    const auto sortBefore = [&] { sortIntoBlocks(points, begin, middle, interrupter); };
    const auto sortBehind = [&] { sortIntoBlocks(points, middle, end, interrupter); };
    if (count > blockSize) {
        parallelInvoke(sortBefore, sortBehind);
    } else {
        sortBefore();
        sortBehind();
    }
}

/// Returns rows, where row(i) returns the i-th, in groups, each column by column.
template <typename Row>
void appendGroups(std::size_t count, std::size_t columns, const Row& row, std::vector<float>& groups)
{
    const std::size_t oldSize = groups.size();
    groups.resize(oldSize + (count + groupSize - 1) / groupSize * groupSize * columns);
    for (std::size_t i = 0; i < count; ++i) {
        float* const place = groups.data() + oldSize + i / groupSize * groupSize * columns + i % groupSize;
        const float* const weights = row(i);
        for (std::size_t k = 0; k < columns; ++k) place[k * groupSize] = weights[k];
    }
}

} // namespace

void requireWeights(std::size_t weights, std::size_t points, std::size_t handles)
{
    if (weights == points * handles) return;
    throw InputError("weights", "there are " + std::to_string(weights) + "; " + std::to_string(points) +
                                    " points and " + std::to_string(handles) + " handles need " +
                                    std::to_string(points * handles));
}

WeightBlocks::WeightBlocks(const std::vector<Vec3d>& points, const std::vector<float>& reach, const MakeRows& makeRows,
                           Interrupter* interrupter)
    : handles_(reach.size()), blocks_((points.size() + blockSize - 1) / blockSize)
{
    Indices all(points.size());
    std::iota(all.begin(), all.end(), 0U);
    sortIntoBlocks(points, all.begin(), all.end(), interrupter);
    parallelFor(std::size_t(0), blocks_.size(), [&](std::size_t b) {
        const std::size_t first = b * blockSize, count = std::min(blockSize, points.size() - first);
        const Indices indices(all.begin() + static_cast<std::ptrdiff_t>(first),
                              all.begin() + static_cast<std::ptrdiff_t>(first + count));
        std::vector<float> rows(count * handles_);
        makeRows(indices, rows);
        const InterpolativeRows few = interpolativeRows(rows, reach, tolerance, groupSize, interrupter);
        Block& block = blocks_[b];
        block.heldCount = few.kept;
        for (const std::uint32_t i : few.order) block.points.push_back(indices[i]);
        appendGroups(
            few.kept, handles_, [&](std::size_t i) { return rows.data() + few.order[i] * handles_; }, block.weights);
        appendGroups(
            few.order.size() - few.kept, few.kept - 1,
            [&](std::size_t i) { return few.factors.data() + i * (few.kept - 1); }, block.weights);
        block.weights.shrink_to_fit();
    });
}

void WeightBlocks::move(const std::vector<HandleMove>& handleMoves, double size, std::vector<Vec3d>& points) const
{
    Moves moves;
    for (const HandleMove& move : handleMoves) moves.add(move.handle, move.motion);
    moves.lookAhead(handles_);
    parallelFor(tbb::blocked_range<std::size_t>(0, blocks_.size()), [&](const auto& range) {
        std::vector<Vec3f> heldMotions;
        Moves heldMoves;
        for (std::size_t b = range.begin(); b < range.end(); ++b) {
            const Block& block = blocks_[b];
            const float* weights = block.weights.data();
            const auto eachGroup = [&](std::size_t begin, std::size_t end, std::size_t columns, const Moves& groupMoves,
                                       const auto& take) {
                for (std::size_t first = begin; first < end; first += groupSize, weights += columns * groupSize) {
                    const GroupSums sums = sumUp(weights, groupMoves);
                    for (std::size_t i = first; i < std::min(end, first + groupSize); ++i) {
                        take(points[block.points[i]], sums[i - first]);
                    }
                }
            };
            heldMotions.clear();
            eachGroup(0, block.heldCount, handles_, moves, [&](Vec3d& point, const Vec3f& motion) {
                point += size * Vec3d(motion);
                heldMotions.push_back(motion);
            });
            heldMoves.clear();
            for (std::size_t i = 1; i < block.heldCount; ++i) heldMoves.add(i - 1, heldMotions[i] - heldMotions[0]);
            heldMoves.lookAhead(block.heldCount - 1);
            eachGroup(
                block.heldCount, block.points.size(), block.heldCount - 1, heldMoves,
                [&](Vec3d& point, const Vec3f& motion) { point += size * (Vec3d(heldMotions[0]) + Vec3d(motion)); });
        }
    });
}

std::size_t WeightBlocks::bytes() const
{
    std::size_t bytes = 0;
    for (const Block& block : blocks_) bytes += block.weights.size() * sizeof(float);
    return bytes;
}

} // namespace vdbcage::detail
