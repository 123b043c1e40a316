#include <vdbcage/volume/detail/contour_blocks.h>

#include <algorithm>
#include <atomic>

#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

// The entries of one block, with a border of one entry from its six neighbours.
class PaddedEntries {
public:
    PaddedEntries(const MaskTree& tree, const Coord& origin) : own_(blockAt(tree, origin))
    {
        own_.forEachEntry(
            [&](int n, const std::uint64_t* entry) { kinds_[kindIndex(n >> 8, n >> 4 & 15, n & 15)] = kindOf(entry); });
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                Coord beside = origin;
                beside[axis] += upper ? blockSize : -blockSize;
                const Block neighbour = neighbours_[index(axis, upper)] = blockAt(tree, beside);
                if (!neighbour.isEmpty()) copyFace(neighbour, axis, upper);
            }
        }
    }

    // Returns for each 4^3 entries of the block the bits 16 x + 4 y + z of those that may have contour: all except
    // uniform ones that are either empty of the set or equal to their six neighbours.
    std::array<std::uint64_t, 64> candidates(bool ofComplement) const
    {
        const std::uint8_t none = ofComplement ? full : empty;
        std::array<std::uint64_t, 64> groups{};
        for (int x = 0; x < entriesPerAxis; ++x) {
            for (int y = 0; y < entriesPerAxis; ++y) {
                const std::uint8_t* const own = &kinds_[kindIndex(x, y, 0)];
                std::array<std::uint8_t, entriesPerAxis> differs; // side by side, for vectors
                for (std::ptrdiff_t z = 0; z < entriesPerAxis; ++z) {
                    const std::uint8_t kind = own[z];
                    const int others = (own[z - stepX] ^ kind) | (own[z + stepX] ^ kind) | (own[z - stepY] ^ kind) |
                                       (own[z + stepY] ^ kind) | (own[z - 1] ^ kind) | (own[z + 1] ^ kind);
                    differs[static_cast<std::size_t>(z)] =
                        static_cast<std::uint8_t>((kind == mixed) | ((kind != none) & (others != 0)));
                }
                for (int z = 0; z < entriesPerAxis; ++z) {
                    const int group = 16 * (x >> 2) + 4 * (y >> 2) + (z >> 2),
                              entry = 16 * (x & 3) + 4 * (y & 3) + (z & 3);
                    groups[static_cast<std::size_t>(group)] |= std::uint64_t{differs[static_cast<std::size_t>(z)]}
                                                               << entry;
                }
            }
        }
        return groups;
    }

    // Returns the words of an entry, -1 to 16 along one axis, else 0 to 15.
    const std::uint64_t* words(Coord entry) const
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (entry[axis] >= 0 && entry[axis] < entriesPerAxis) continue;
            const bool upper = entry[axis] > 0;
            entry[axis] = upper ? 0 : entriesPerAxis - 1;
            return neighbours_[index(axis, upper)].entry(entryIndex(entry.x(), entry.y(), entry.z()));
        }
        return own_.entry(entryIndex(entry.x(), entry.y(), entry.z()));
    }

private:
    using Kind = std::uint8_t;
    static constexpr Kind empty = 0, full = 1, mixed = 2;
    static constexpr std::ptrdiff_t size = 18, stepY = size, stepX = size * size;

    static std::size_t kindIndex(int x, int y, int z)
    {
        return static_cast<std::size_t>((x + 1) * stepX + (y + 1) * stepY + z + 1);
    }
    static std::size_t index(std::size_t axis, bool upper) { return 2 * axis + (upper ? 1 : 0); }
    static Kind kindOf(const std::uint64_t* words)
    {
        return words == emptyWords.data() ? empty : words == fullWords.data() ? full : mixed;
    }
    void copyFace(const Block& neighbour, std::size_t axis, bool upper)
    {
        for (int i = 0; i < entriesPerAxis; ++i) {
            for (int j = 0; j < entriesPerAxis; ++j) {
                Coord source, target;
                source[axis] = upper ? 0 : entriesPerAxis - 1;
                target[axis] = upper ? entriesPerAxis : -1;
                source[(axis + 1) % 3] = target[(axis + 1) % 3] = i;
                source[(axis + 2) % 3] = target[(axis + 2) % 3] = j;
                kinds_[kindIndex(target.x(), target.y(), target.z())] =
                    kindOf(neighbour.entry(entryIndex(source.x(), source.y(), source.z())));
            }
        }
    }

    Block own_;
    std::array<Block, 6> neighbours_;
    std::array<Kind, size * size * size> kinds_{};
};

// Finds the contour within an entry; returns false if there is none. `flip` is ~0 for the complement.
bool contourWords(const PaddedEntries& entries, const Coord& entry, std::uint64_t flip, Words& contour)
{
    const auto wordsAt = [&](int x, int y, int z) { return entries.words(entry.offsetBy(x, y, z)); };
    const std::uint64_t* const own = wordsAt(0, 0, 0);
    const std::uint64_t *const xLower = wordsAt(-1, 0, 0), *const xUpper = wordsAt(1, 0, 0);
    const std::uint64_t *const yLower = wordsAt(0, -1, 0), *const yUpper = wordsAt(0, 1, 0);
    const std::uint64_t *const zLower = wordsAt(0, 0, -1), *const zUpper = wordsAt(0, 0, 1);
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

ContourLeaf contourLeaf(int entry, const Words& words)
{
    ContourLeaf leaf{static_cast<std::uint16_t>(entry), bitBox(words.data()), {}};
    // The middle one of the non-empty words, and a bit of it next to the middle.
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
    constexpr int groupEntries = 4; // a group is 4^3 entries
    const PaddedEntries entries(tree, origin);
    const auto candidates = entries.candidates(flip != 0);
    ContourBlock result{origin, {}, {}, {}, {}};
    Words words;
    for (int group = 0; group < 64; ++group) {
        const Coord first(group / 16 * groupEntries, group / 4 % 4 * groupEntries, group % 4 * groupEntries);
        ContourGroup contour{{}, result.leaves.size(), 0};
        for (std::uint64_t left = candidates[static_cast<std::size_t>(group)]; left != 0; left &= left - 1) {
            const int i = __builtin_ctzll(left);
            const Coord entry = first.offsetBy(i / 16, i / 4 % 4, i % 4);
            if (!contourWords(entries, entry, flip, words)) continue;
            const int n = entryIndex(entry.x(), entry.y(), entry.z());
            const BitBox& box = result.leaves.emplace_back(contourLeaf(n, words)).box;
            result.words.push_back(words);
            const Coord corner = origin + entryOffset(n);
            contour.box.expand(corner.offsetBy(box.lower[0], box.lower[1], box.lower[2]));
            contour.box.expand(corner.offsetBy(box.upper[0], box.upper[1], box.upper[2]));
        }
        contour.end = result.leaves.size();
        if (contour.end == contour.begin) continue;
        result.groups.push_back(contour);
        result.box.expand(contour.box);
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
            for (std::size_t axis = 0; axis < 3; ++axis) {
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
    parallelFor(std::size_t{0}, origins.size(), [&](std::size_t i) {
        progress.check(done++, origins.size());
        blocks[i] = contourOfBlock(tree, origins[i], flip);
    });
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(), [](const auto& block) { return block.leaves.empty(); }),
                 blocks.end());
    return blocks;
}

} // namespace vdbcage::detail
