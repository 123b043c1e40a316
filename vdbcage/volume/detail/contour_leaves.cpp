#include <vdbcage/volume/detail/contour_leaves.h>

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

namespace vdbcage::detail {

namespace {

// The slots of one block with a border of one slot of its six neighbours, as pointers to their words.
class PaddedSlots {
public:
    PaddedSlots(const MaskTree& tree, const Coord& origin) : slots_(size * size * size, emptyWords.data())
    {
        const Block block = blockAt(tree, origin);
        for (int n = 0; n < slotsPerBlock; ++n) slots_[inner(n)] = block.slot(n);
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                Coord neighbour = origin;
                neighbour[axis] += upper ? blockSize : -blockSize;
                copyFace(blockAt(tree, neighbour), axis, upper);
            }
        }
    }
    static std::size_t inner(int n) { return at((n >> 8) + 1, ((n >> 4) & 15) + 1, (n & 15) + 1); }
    const std::uint64_t* operator[](std::size_t i) const { return slots_[i]; }

    static constexpr std::size_t stepY = 18, stepX = stepY * stepY;

private:
    static constexpr std::size_t size = 18;
    static std::size_t at(int x, int y, int z)
    {
        return static_cast<std::size_t>(x) * stepX + static_cast<std::size_t>(y) * stepY + static_cast<std::size_t>(z);
    }
    void copyFace(const Block& neighbour, int axis, bool upper)
    {
        if (neighbour.isEmpty()) return;
        for (int i = 0; i < slotsPerAxis; ++i) {
            for (int j = 0; j < slotsPerAxis; ++j) {
                std::array<int, 3> from{}, to{};
                const auto u = static_cast<std::size_t>(axis), v = (u + 1) % 3, w = (u + 2) % 3;
                from[u] = upper ? 0 : slotsPerAxis - 1;
                to[u] = upper ? slotsPerAxis + 1 : 0;
                from[v] = i;
                from[w] = j;
                to[v] = i + 1;
                to[w] = j + 1;
                slots_[at(to[0], to[1], to[2])] = neighbour.slot(slotIndex(from[0], from[1], from[2]));
            }
        }
    }

    std::vector<const std::uint64_t*> slots_;
};

// The contour within slot i of the padded slots; false if there is none. `flip` is ~0 for the complement.
bool contourWords(const PaddedSlots& slots, std::size_t i, std::uint64_t flip, Words& contour)
{
    const std::uint64_t* const own = slots[i];
    if (own == (flip != 0 ? fullWords.data() : emptyWords.data())) return false;
    const std::uint64_t *const xLower = slots[i - PaddedSlots::stepX], *const xUpper = slots[i + PaddedSlots::stepX];
    const std::uint64_t *const yLower = slots[i - PaddedSlots::stepY], *const yUpper = slots[i + PaddedSlots::stepY];
    const std::uint64_t *const zLower = slots[i - 1], *const zUpper = slots[i + 1];
    // Uniform slots share their words, so that deep inside and far outside nothing is read.
    if (own == xLower && own == xUpper && own == yLower && own == yUpper && own == zLower && own == zUpper)
        return false;
    constexpr std::uint64_t firstZ = 0x0101010101010101ULL, lastZ = firstZ << 7;
    std::uint64_t any = 0;
    for (std::size_t x = 0; x < 8; ++x) {
        const std::uint64_t word = own[x] ^ flip;
        std::uint64_t inside = (x > 0 ? own[x - 1] : xLower[7]) ^ flip;
        inside &= (x < 7 ? own[x + 1] : xUpper[0]) ^ flip;
        inside &= (word << 8) | ((yLower[x] ^ flip) >> 56);
        inside &= (word >> 8) | ((yUpper[x] ^ flip) << 56);
        inside &= ((word & ~lastZ) << 1) | (((zLower[x] ^ flip) & lastZ) >> 7);
        inside &= ((word & ~firstZ) >> 1) | (((zUpper[x] ^ flip) & firstZ) << 7);
        contour[x] = word & ~inside;
        any |= contour[x];
    }
    return any != 0;
}

ContourLeaf contourLeaf(int slot, const Words& words)
{
    ContourLeaf leaf{static_cast<std::uint16_t>(slot), bitBox(words.data()), {}};
    // The middle one of the non-empty words, and of its bits one next to the middle.
    std::array<int, 8> used{};
    std::size_t count = 0;
    for (int x = 0; x < leafSize; ++x) {
        if (words[static_cast<std::size_t>(x)] != 0) used[count++] = x;
    }
    const int x = used[count / 2];
    const std::uint64_t word = words[static_cast<std::size_t>(x)];
    const std::uint64_t upper = word >> 28;
    const int bit = upper != 0 ? 28 + __builtin_ctzll(upper) : 63 - __builtin_clzll(word);
    leaf.sample = {static_cast<std::int8_t>(x), static_cast<std::int8_t>(bit >> 3), static_cast<std::int8_t>(bit & 7)};
    return leaf;
}

ContourBlock contourOfBlock(const MaskTree& tree, const Coord& origin, std::uint64_t flip)
{
    constexpr int groupSlots = 4; // a group is 4^3 slots
    const PaddedSlots slots(tree, origin);
    ContourBlock result{origin, {}, {}, {}, {}};
    Words words;
    for (int group = 0; group < 64; ++group) {
        const Coord first(group / 16 * groupSlots, group / 4 % 4 * groupSlots, group % 4 * groupSlots);
        ContourGroup found{{}, result.leaves.size(), 0};
        for (int i = 0; i < 64; ++i) {
            const int n = slotIndex(first.x() + i / 16, first.y() + i / 4 % 4, first.z() + i % 4);
            if (!contourWords(slots, PaddedSlots::inner(n), flip, words)) continue;
            const BitBox& box = result.leaves.emplace_back(contourLeaf(n, words)).box;
            result.words.push_back(words);
            const Coord corner = origin + slotOffset(n);
            found.box.expand(corner.offsetBy(box.lower[0], box.lower[1], box.lower[2]));
            found.box.expand(corner.offsetBy(box.upper[0], box.upper[1], box.upper[2]));
        }
        found.end = result.leaves.size();
        if (found.end == found.begin) continue;
        result.groups.push_back(found);
        result.box.expand(found.box);
    }
    result.leaves.shrink_to_fit();
    result.words.shrink_to_fit();
    return result;
}

} // namespace

std::vector<ContourBlock> contourBlocks(const MaskTree& tree, ContourOf side, const Progress& progress)
{
    std::vector<Coord> origins = shellBlocks(tree);
    if (side == ContourOf::complement) {
        const std::size_t own = origins.size();
        for (std::size_t i = 0; i < own; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                for (const int step : {-blockSize, blockSize}) {
                    Coord neighbour = origins[i];
                    neighbour[axis] += step;
                    origins.push_back(neighbour);
                }
            }
        }
        std::sort(origins.begin(), origins.end());
        origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
    }
    const std::uint64_t flip = side == ContourOf::complement ? ~0ULL : 0;
    std::vector<ContourBlock> blocks(origins.size());
    std::atomic<std::size_t> done{0};
    tbb::parallel_for(std::size_t{0}, origins.size(), [&](std::size_t i) {
        progress.check(done++, origins.size());
        blocks[i] = contourOfBlock(tree, origins[i], flip);
    });
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(), [](const auto& block) { return block.leaves.empty(); }),
                 blocks.end());
    return blocks;
}

} // namespace vdbcage::detail
