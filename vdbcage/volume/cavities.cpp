// Connected components of the inactive voxels by union-find, on the tree's own nodes: a voxel component of a leaf, an
// empty entry, a run of empty blocks along x. Lines of blocks without any node belong to the outside completely.
#include <vdbcage/volume/cavities.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/volume/detail/mask_blocks.h>

namespace vdbcage {

namespace {

using namespace detail;
using openvdb::MaskGrid;

// Returns the bits of `space` that are face-connected, within the entry, to those of `seed`.
Words flood(Words seed, const Words& space)
{
    constexpr std::uint64_t firstZ = 0x0101010101010101ULL, lastZ = firstZ << 7;
    const auto spreadInWord = [](std::uint64_t word, std::uint64_t free) {
        for (;;) {
            const std::uint64_t next =
                (word | word << 8 | word >> 8 | (word & ~lastZ) << 1 | (word & ~firstZ) >> 1) & free;
            if (next == word) return word;
            word = next;
        }
    };
    for (;;) {
        const Words before = seed;
        for (std::size_t x = 0; x < 8; ++x) {
            seed[x] = spreadInWord((x > 0 ? seed[x] | seed[x - 1] : seed[x]) & space[x], space[x]);
        }
        for (std::size_t x = 8; x-- > 0;) {
            seed[x] = spreadInWord((x < 7 ? seed[x] | seed[x + 1] : seed[x]) & space[x], space[x]);
        }
        if (seed == before) return seed;
    }
}

// Returns the bits on one face of an entry, such that two faces that meet have the same places: a byte for each row, to
// be compared with one `and`.
std::uint64_t faceBits(const std::uint64_t* words, int axis, bool upper)
{
    if (axis == 0) return words[upper ? 7 : 0];
    std::uint64_t bits = 0;
    for (int x = 0; x < leafSize; ++x) {
        const std::uint64_t word = words[x];
        const std::uint64_t row =
            axis == 1 ? word >> (upper ? 56 : 0) & 0xFFU
                      : (((word >> (upper ? 7 : 0)) & 0x0101010101010101ULL) * 0x0102040810204080ULL) >> 56;
        bits |= row << (8 * x);
    }
    return bits;
}

// The empty space of one block that is a node: pieces (empty entries, components of leaves), each with its component.
class BlockSpace {
public:
    explicit BlockSpace(const LowerNode& node) : origin_(node.origin()), block_(&node), first_(entriesPerBlock + 1)
    {
        for (int n = 0; n < entriesPerBlock; ++n) {
            first_[static_cast<std::size_t>(n)] = static_cast<std::uint32_t>(pieces_.size());
            addPieces(block_.entry(n));
        }
        first_.back() = static_cast<std::uint32_t>(pieces_.size());
        UnionFind components(pieces_.size());
        const auto unite = [&](std::uint32_t a, std::uint32_t b) { components.unite(a, b); };
        for (int n = 0; n < entriesPerBlock; ++n) {
            for (const int axis : {0, 1, 2}) {
                const int step = 256 >> (4 * axis);
                if ((n / step) % entriesPerAxis + 1 < entriesPerAxis) forEachContact(n, *this, n + step, axis, unite);
            }
        }
        // Numbered in the order of their first piece.
        component_.resize(pieces_.size());
        for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
            const std::uint32_t root = components.find(i);
            component_[i] = root == i ? count_++ : component_[root];
        }
    }

    const Coord& origin() const { return origin_; }
    std::uint32_t componentCount() const { return count_; }

    /// Calls visit(own piece, other piece) where entry n here and entry m of `other`, next along `axis`, connect.
    template <class Visit>
    void forEachContact(int n, const BlockSpace& other, int m, int axis, const Visit& visit) const
    {
        for (std::uint32_t a = firstPiece(n); a < firstPiece(n + 1); ++a) {
            const std::uint64_t face = faceBits(pieces_[a].data(), axis, true);
            for (std::uint32_t b = other.firstPiece(m); b < other.firstPiece(m + 1); ++b) {
                if ((face & faceBits(other.pieces_[b].data(), axis, false)) != 0) visit(a, b);
            }
        }
    }
    /// Calls visit(component) for those that have a voxel on this side of the block.
    template <class Visit>
    void forEachOnSide(int axis, bool upper, const Visit& visit) const
    {
        const int step = 256 >> (4 * axis);
        for (int n = 0; n < entriesPerBlock; ++n) {
            if ((n / step) % entriesPerAxis != (upper ? entriesPerAxis - 1 : 0)) continue;
            for (std::uint32_t i = firstPiece(n); i < firstPiece(n + 1); ++i) {
                if (faceBits(pieces_[i].data(), axis, upper) != 0) visit(component_[i]);
            }
        }
    }
    std::uint32_t component(std::uint32_t piece) const { return component_[piece]; }

    /// Returns the block with the components filled for which isFilled(component) is true.
    template <class IsFilled>
    BuiltBlock fill(const IsFilled& isFilled) const
    {
        BlockBuilder builder(origin_);
        for (int n = 0; n < entriesPerBlock; ++n) {
            const std::uint64_t* const own = block_.entry(n);
            Words words;
            std::copy(own, own + leafSize, words.begin());
            for (std::uint32_t i = firstPiece(n); i < firstPiece(n + 1); ++i) {
                if (!isFilled(component_[i])) continue;
                for (std::size_t x = 0; x < 8; ++x) words[x] |= pieces_[i][x];
            }
            builder.set(n, words.data());
        }
        return builder.finish();
    }

private:
    std::uint32_t firstPiece(int n) const { return first_[static_cast<std::size_t>(n)]; }

    void addPieces(const std::uint64_t* words)
    {
        if (words == emptyWords.data()) {
            pieces_.push_back(fullWords);
            return;
        }
        Words space;
        for (std::size_t x = 0; x < 8; ++x) space[x] = ~words[x];
        for (std::size_t x = 0; x < 8; ++x) {
            while (space[x] != 0) {
                Words seed{};
                seed[x] = space[x] & (~space[x] + 1); // the lowest bit
                const Words& piece = pieces_.emplace_back(flood(seed, space));
                for (std::size_t i = 0; i < 8; ++i) space[i] &= ~piece[i];
            }
        }
    }

    Coord origin_;
    Block block_;
    std::vector<std::uint32_t> first_; // of each entry's pieces
    std::vector<Words> pieces_;
    std::vector<std::uint32_t> component_; // of each piece
    std::uint32_t count_ = 0;
};

// The empty space outside of nodes, as runs of blocks along x. Coordinates are counted in blocks.
class BlockRuns {
public:
    BlockRuns(const MaskTree& tree, const std::vector<BlockSpace>& nodes)
    {
        const auto occupy = [&](const Coord& origin, int blocks) {
            lines_[{origin.y() / blockSize, origin.z() / blockSize}].occupied.emplace_back(origin.x() / blockSize,
                                                                                           blocks);
        };
        const FullParts full = fullParts(tree);
        constexpr int perUpperNode = upperNodeSize / blockSize;
        for (const Coord& origin : full.upperNodes) {
            for (int y = 0; y < perUpperNode; ++y) {
                for (int z = 0; z < perUpperNode; ++z)
                    occupy(origin.offsetBy(0, y * blockSize, z * blockSize), perUpperNode);
            }
        }
        for (const Coord& origin : full.blocks) occupy(origin, 1);
        for (const BlockSpace& node : nodes) occupy(node.origin(), 1);
        for (auto& [place, line] : lines_) {
            std::sort(line.occupied.begin(), line.occupied.end());
            int begin = std::numeric_limits<int>::min();
            for (const auto& [x, blocks] : line.occupied) {
                if (x > begin) {
                    const bool isOutside = begin == std::numeric_limits<int>::min();
                    line.runs.push_back({begin, x, isOutside ? 0 : elementCount_++});
                }
                begin = std::max(begin, x + blocks);
            }
            line.runs.push_back({begin, std::numeric_limits<int>::max(), 0});
        }
    }

    /// Returns the number of elements: each bounded run is one; element 0 is the outside.
    std::uint32_t elementCount() const { return elementCount_; }
    void uniteNeighbours(UnionFind& elements) const
    {
        for (const auto& [place, line] : lines_) {
            const auto [y, z] = place;
            for (const auto& neighbour :
                 {std::pair(y - 1, z), std::pair(y + 1, z), std::pair(y, z - 1), std::pair(y, z + 1)}) {
                const auto other = lines_.find(neighbour);
                if (other == lines_.end()) {
                    for (const Run& run : line.runs) elements.unite(0, run.element);
                } else if (place < neighbour) {
                    uniteOverlaps(line.runs, other->second.runs, elements);
                }
            }
        }
    }
    /// Returns the element of an empty block; `origin` in voxels.
    std::uint32_t elementAt(const Coord& origin) const
    {
        const auto line = lines_.find({origin.y() / blockSize, origin.z() / blockSize});
        if (line == lines_.end()) return 0;
        const int x = origin.x() / blockSize;
        const auto& runs = line->second.runs;
        const auto next =
            std::upper_bound(runs.begin(), runs.end(), x, [](int v, const Run& run) { return v < run.end; });
        return next->element;
    }
    /// Calls visit(element, origin) for each block of the bounded runs.
    template <class Visit>
    void forEachInnerBlock(const Visit& visit) const
    {
        for (const auto& [place, line] : lines_) {
            for (const Run& run : line.runs) {
                for (int x = run.begin; run.element != 0 && x < run.end; ++x) {
                    visit(run.element, Coord(x * blockSize, place.first * blockSize, place.second * blockSize));
                }
            }
        }
    }

private:
    struct Run {
        int begin, end;
        std::uint32_t element;
    };
    struct Line {
        std::vector<std::pair<int, int>> occupied; // begin, count
        std::vector<Run> runs;                     // the rest, in order
    };
    static void uniteOverlaps(const std::vector<Run>& a, const std::vector<Run>& b, UnionFind& elements)
    {
        for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
            if (std::max(i->begin, j->begin) < std::min(i->end, j->end)) elements.unite(i->element, j->element);
            if (i->end < j->end) {
                ++i;
            } else {
                ++j;
            }
        }
    }
    std::map<std::pair<int, int>, Line> lines_; // by y, z
    std::uint32_t elementCount_ = 1;
};

std::vector<BlockSpace> nodeSpaces(const MaskTree& tree, Interrupter* interrupter)
{
    std::vector<const LowerNode*> nodes;
    for (auto upperNode = tree.root().cbeginChildOn(); upperNode; ++upperNode) {
        for (auto block = upperNode->cbeginChildOn(); block; ++block) nodes.push_back(&*block);
    }
    std::vector<std::unique_ptr<BlockSpace>> built(nodes.size());
    std::atomic<std::size_t> done{0};
    detail::parallelFor(std::size_t{0}, nodes.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter, static_cast<int>(60 * done++ / nodes.size()));
        built[i] = std::make_unique<BlockSpace>(*nodes[i]);
    });
    std::vector<BlockSpace> spaces;
    spaces.reserve(built.size());
    for (auto& space : built) spaces.push_back(std::move(*space));
    return spaces;
}

} // namespace

FilledMask fillCavities(const MaskGrid& mask, Interrupter* interrupter)
{
    const MaskTree& tree = mask.tree();
    requireSupportedCoordinates(tree);
    throwIfInterrupted(interrupter, 0);
    const std::vector<BlockSpace> nodes = nodeSpaces(tree, interrupter);

    const BlockRuns runs(tree, nodes);
    std::uint32_t elementCount = runs.elementCount();
    std::map<Coord, std::size_t> nodeAt;
    std::vector<std::uint32_t> firstElement; // of each node's components
    for (const BlockSpace& node : nodes) {
        nodeAt.emplace(node.origin(), nodeAt.size());
        firstElement.push_back(elementCount);
        elementCount += node.componentCount();
    }
    UnionFind elements(elementCount);
    runs.uniteNeighbours(elements);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        throwIfInterrupted(interrupter, 60 + static_cast<int>(20 * i / nodes.size()));
        for (int axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                Coord neighbour = nodes[i].origin();
                neighbour[static_cast<std::size_t>(axis)] += upper ? blockSize : -blockSize;
                const auto other = nodeAt.find(neighbour);
                if (other == nodeAt.end()) {
                    if (!blockAt(tree, neighbour).isEmpty()) continue;
                    const std::uint32_t run = runs.elementAt(neighbour);
                    nodes[i].forEachOnSide(axis, upper,
                                           [&](std::uint32_t c) { elements.unite(run, firstElement[i] + c); });
                } else if (upper) {
                    const BlockSpace& a = nodes[i];
                    const BlockSpace& b = nodes[other->second];
                    const int step = 256 >> (4 * axis);
                    for (int n = 0; n < entriesPerBlock; ++n) {
                        if ((n / step) % entriesPerAxis != entriesPerAxis - 1) continue;
                        a.forEachContact(n, b, n - (entriesPerAxis - 1) * step, axis,
                                         [&](std::uint32_t p, std::uint32_t q) {
                                             elements.unite(firstElement[i] + a.component(p),
                                                            firstElement[other->second] + b.component(q));
                                         });
                    }
                }
            }
        }
    }

    // From here on the data are only read, by several threads: the roots are looked up once.
    std::vector<char> isCavity(elementCount);
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < elementCount; ++i) {
        const std::uint32_t root = elements.find(i);
        isCavity[i] = root != 0 ? 1 : 0;
        if (root == i && root != 0) ++count;
    }
    std::vector<BuiltBlock> built(nodes.size());
    detail::parallelFor(std::size_t{0}, nodes.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter, 80);
        built[i] = nodes[i].fill([&](std::uint32_t c) { return isCavity[firstElement[i] + c] != 0; });
    });
    runs.forEachInnerBlock([&](std::uint32_t element, const Coord& origin) {
        if (isCavity[element] != 0) built.push_back({origin, nullptr, true});
    });
    return {maskGridLike(mask, assemble(fullParts(tree), std::move(built))), count};
}

} // namespace vdbcage
