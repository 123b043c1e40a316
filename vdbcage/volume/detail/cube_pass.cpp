// A cube is the sum of three segments, so a dilation by it is three passes along one axis each. All three are the same
// code: a pass works along x, where the 64 voxels of a word are 64 lanes, and turns the axes as it writes, (x, y, z)
// becoming (y, z, x); three turns are none. An erosion is the dilation of the complement.
#include <vdbcage/volume/detail/cube_pass.h>

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

namespace vdbcage::detail {

namespace {

enum class Side { mask, complement };

Coord turned(const Coord& c)
{
    return {c.y(), c.z(), c.x()};
}

// Swaps the bits under `mask` with those `shift` places above.
inline void swapBits(std::uint64_t& word, std::uint64_t mask, int shift)
{
    const std::uint64_t difference = ((word >> shift) ^ word) & mask;
    word ^= difference ^ (difference << shift);
}

// The same between two words.
inline void swapBits(std::uint64_t& low, std::uint64_t& high, std::uint64_t mask, int shift)
{
    const std::uint64_t difference = ((low >> shift) ^ high) & mask;
    high ^= difference;
    low ^= difference << shift;
}

// Bit (x, y, z), in word x at 8 y + z, moves to word y at 8 z + x.
Words turned(const Words& words)
{
    Words w = words;
    // Words x, bytes y: transposed as an 8 x 8 matrix of bytes.
    for (std::size_t i = 0; i < 4; ++i) swapBits(w[i], w[i + 4], 0x00000000FFFFFFFFULL, 32);
    for (const std::size_t i : {0U, 1U, 4U, 5U}) swapBits(w[i], w[i + 2], 0x0000FFFF0000FFFFULL, 16);
    for (const std::size_t i : {0U, 2U, 4U, 6U}) swapBits(w[i], w[i + 1], 0x00FF00FF00FF00FFULL, 8);
    // Now word y holds bytes x of bits z: each word transposed as an 8 x 8 matrix of bits.
    for (std::uint64_t& word : w) {
        swapBits(word, 0x00000000F0F0F0F0ULL, 28);
        swapBits(word, 0x0000CCCC0000CCCCULL, 14);
        swapBits(word, 0x00AA00AA00AA00AAULL, 7);
    }
    return w;
}

// One pass along x. Everything is said for a dilation; for an erosion it holds for the complement.
class AxisPass {
public:
    AxisPass(const MaskTree& mask, Side side, int radius, const Progress& progress)
        : mask_(mask), flip_(side == Side::complement ? ~0ULL : 0), radius_(radius),
          leafReach_((radius + leafSize - 1) / leafSize), blockReach_((radius + blockSize - 1) / blockSize),
          progress_(progress)
    {
        if (flip_ != 0) std::swap(none_, all_);
    }

    MaskTree::Ptr run()
    {
        const std::vector<Coord> targets = targetBlocks();
        std::vector<BuiltBlock> built(targets.size());
        std::atomic<std::size_t> done{0};
        tbb::parallel_for(std::size_t{0}, targets.size(), [&](std::size_t i) {
            progress_.check(done++, targets.size());
            built[i] = build(targets[i]);
        });
        FullParts full = fullParts(mask_);
        for (auto* origins : {&full.regions, &full.blocks}) {
            for (Coord& origin : *origins) origin = turned(origin);
        }
        return assemble(full, std::move(built));
    }

private:
    bool isFull(const Block& block) const { return flip_ != 0 ? block.isEmpty() : block.isFull(); }
    bool isEmpty(const Block& block) const { return flip_ != 0 ? block.isFull() : block.isEmpty(); }

    // The blocks that are not full but have something in reach.
    std::vector<Coord> targetBlocks() const
    {
        std::vector<Coord> targets;
        for (const Coord& origin : shellBlocks(mask_)) {
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                targets.push_back(origin.offsetBy(step * blockSize, 0, 0));
            }
        }
        std::sort(targets.begin(), targets.end());
        targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
        const auto isSettled = [&](const Coord& origin) {
            if (isFull(blockAt(mask_, origin))) return true;
            for (int step = -blockReach_; step <= blockReach_; ++step) {
                if (!isEmpty(blockAt(mask_, origin.offsetBy(step * blockSize, 0, 0)))) return false;
            }
            return true;
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isSettled), targets.end());
        return targets;
    }

    BuiltBlock build(const Coord& origin) const
    {
        std::vector<Block> line;
        for (int step = -blockReach_; step <= blockReach_; ++step) {
            line.push_back(blockAt(mask_, origin.offsetBy(step * blockSize, 0, 0)));
        }
        BlockBuilder builder(turned(origin));
        std::vector<const std::uint64_t*> column(static_cast<std::size_t>(slotsPerAxis + 2 * leafReach_));
        for (int y = 0; y < slotsPerAxis; ++y) {
            for (int z = 0; z < slotsPerAxis; ++z) {
                if (!readColumn(line, y, z, column)) continue;
                for (int x = 0; x < slotsPerAxis; ++x) {
                    Words result;
                    if (smear(column, x, result)) builder.set(slotIndex(y, z, x), result.data());
                }
            }
        }
        return builder.finish();
    }

    // The slots of a column, from leafReach_ before the block to as many behind it; false if the result is empty.
    bool readColumn(const std::vector<Block>& line, int y, int z, std::vector<const std::uint64_t*>& column) const
    {
        bool any = false;
        for (std::size_t i = 0; i < column.size(); ++i) {
            const int slot = static_cast<int>(i) - leafReach_ + blockReach_ * slotsPerAxis;
            const auto block = static_cast<std::size_t>(slot / slotsPerAxis);
            column[i] = line[block].slot(slotIndex(slot % slotsPerAxis, y, z));
            any |= column[i] != emptyWords.data();
        }
        return any;
    }

    // The result at slot x of the block, turned; false if it is empty.
    bool smear(const std::vector<const std::uint64_t*>& column, int x, Words& result) const
    {
        const auto own = static_cast<std::size_t>(x + leafReach_);
        Words near{}; // ~0 where something is within the radius
        bool any = false;
        const auto reach = static_cast<std::size_t>(leafReach_);
        if (column[own] == all_) {
            near = fullWords;
            any = true;
        }
        for (std::size_t distance = 0; distance <= reach && near != fullWords; ++distance) {
            any |= column[own - distance] != none_ || column[own + distance] != none_;
            if (distance == 0) {
                smearWithin(column[own], near);
            } else {
                const int start = static_cast<int>(distance) * leafSize;
                smearFrom(column[own - distance], start, true, near);
                smearFrom(column[own + distance], start, false, near);
            }
        }
        if (!any) {
            if (flip_ == 0) return false;
            result = fullWords;
            return true;
        }
        for (std::uint64_t& word : near) word ^= flip_;
        if (near == emptyWords) return false;
        result = near == fullWords ? near : turned(near);
        return true;
    }

    // From the slot itself.
    void smearWithin(const std::uint64_t* words, Words& near) const
    {
        if (words == none_) return;
        for (int from = 0; from < leafSize; ++from) {
            const std::uint64_t word = words[from] ^ flip_;
            const int last = std::min(from + radius_, leafSize - 1);
            for (int to = std::max(from - radius_, 0); to <= last; ++to) near[static_cast<std::size_t>(to)] |= word;
        }
    }

    // From a slot that starts `distance` voxels before (or after) this one.
    void smearFrom(const std::uint64_t* words, int distance, bool before, Words& near) const
    {
        if (words == none_) return;
        // Counted from the near end of both: word i of the source reaches word `to` of the target while
        // distance - 7 + to + i <= radius, with i counted from the source's near end.
        const int most = radius_ - (distance - leafSize + 1); // largest to + i
        std::uint64_t sum = 0;
        std::array<std::uint64_t, 8> sums; // of the words 0 to i
        for (std::size_t i = 0; i < 8; ++i) {
            sum |= words[before ? 7 - i : i] ^ flip_;
            sums[i] = sum;
        }
        for (int to = 0; to <= std::min(most, leafSize - 1); ++to) {
            const auto last = static_cast<std::size_t>(std::min(most - to, leafSize - 1));
            near[static_cast<std::size_t>(before ? to : leafSize - 1 - to)] |= sums[last];
        }
    }

    const MaskTree& mask_;
    std::uint64_t flip_;
    const std::uint64_t* none_ = emptyWords.data(); // the uniform slots, as seen from this side
    const std::uint64_t* all_ = fullWords.data();
    int radius_;
    int leafReach_, blockReach_; // the radius in leaves and blocks, rounded up
    Progress progress_;
};

MaskTree::Ptr threePasses(const MaskTree& mask, Side side, int radius, const Progress& progress)
{
    const auto alongX = AxisPass(mask, side, radius, progress.part(0, 3)).run();
    const auto alongY = AxisPass(*alongX, side, radius, progress.part(1, 3)).run();
    return AxisPass(*alongY, side, radius, progress.part(2, 3)).run();
}

} // namespace

MaskTree::Ptr dilateByCube(const MaskTree& mask, int radius, const Progress& progress)
{
    return threePasses(mask, Side::mask, radius, progress);
}

MaskTree::Ptr erodeByCube(const MaskTree& mask, int radius, const Progress& progress)
{
    return threePasses(mask, Side::complement, radius, progress);
}

} // namespace vdbcage::detail
