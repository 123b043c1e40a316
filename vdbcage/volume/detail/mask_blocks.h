#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <vdbcage/core/detail/grids.h>
#include <vdbcage/volume/detail/progress.h>

/// A sparse mask seen as the nodes of its tree, as all algorithms of this room see it.
///
/// - An *upper node* is 4096^3 voxels, a child of the root.
/// - A *block* is 128^3 voxels, a lower node.
/// - An *entry* is one of the 4096 places of 8^3 voxels in a block: empty, full or a leaf.
///
/// The bits of an entry are 8 words. Word x has voxel (x, y, z) in bit 8 y + z, as OpenVDB stores them. The origins of
/// upper nodes and blocks identify them. Only active states count, not the values of a mask tree's tiles.
namespace vdbcage::detail {

using openvdb::Coord;
using openvdb::MaskTree;
using UpperNode = MaskTree::RootNodeType::ChildNodeType;
using LowerNode = UpperNode::ChildNodeType;
using MaskLeaf = MaskTree::LeafNodeType;

constexpr int leafSize = 8, blockSize = 128, upperNodeSize = 4096;
constexpr int entriesPerAxis = 16, entriesPerBlock = 4096;

using Words = std::array<std::uint64_t, 8>;
inline constexpr Words emptyWords{};
inline constexpr Words fullWords{~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL, ~0ULL};

inline constexpr int entryIndex(int x, int y, int z)
{
    return (x << 8) | (y << 4) | z;
}
/// Returns the corner of entry n, relative to its block.
inline Coord entryOffset(int n)
{
    return {(n >> 8) * leafSize, ((n >> 4) & 15) * leafSize, (n & 15) * leafSize};
}

/// One block of a mask: a node of the tree, or uniformly empty or full.
class Block {
public:
    Block() = default;
    explicit Block(const LowerNode* node) : node_(node) {}
    explicit Block(bool full) : full_(full) {}

    /// Returns whether it is uniformly full, without a node. A node can be full, if it was not pruned, or empty, too.
    bool isFull() const { return full_; }
    bool isEmpty() const { return !node_ && !full_; }

    /// Returns the 8 words of entry n: those of the leaf, or exactly emptyWords or fullWords.
    const std::uint64_t* entry(int n) const
    {
        const auto i = static_cast<openvdb::Index>(n);
        if (!node_) return full_ ? fullWords.data() : emptyWords.data();
        if (node_->isChildMaskOn(i)) return node_->getTable()[i].getChild()->buffer().data();
        return node_->isValueMaskOn(i) ? fullWords.data() : emptyWords.data();
    }

    /// Calls visit(n, entry(n)) for every entry that is not empty, in no order. A leaf without bits may be among them.
    template <class Visit>
    void forEachEntry(const Visit& visit) const
    {
        if (!node_) {
            for (int n = 0; full_ && n < entriesPerBlock; ++n) visit(n, fullWords.data());
            return;
        }
        for (auto tile = node_->cbeginValueOn(); tile; ++tile) visit(static_cast<int>(tile.pos()), fullWords.data());
        for (auto leaf = node_->cbeginChildOn(); leaf; ++leaf) {
            visit(static_cast<int>(leaf.pos()), leaf->buffer().data());
        }
    }

private:
    const LowerNode* node_ = nullptr;
    bool full_ = false;
};

/// Returns the block of `tree` with this origin.
/// Cost: O(log upper nodes).
Block blockAt(const MaskTree& tree, const Coord& origin);

/// Returns the blocks that can have a boundary voxel of the mask, sorted.
///
/// These are the nodes and the full blocks; of a full upper node, those of facesOfUpperNodes().
std::vector<Coord> shellBlocks(const MaskTree& tree);

/// Returns the blocks along those faces of the upper nodes where the neighbour is not one of them. Some may occur
/// twice.
std::vector<Coord> facesOfUpperNodes(const std::vector<Coord>& upperNodes);

/// Calls visit(origin) for each block of an upper node.
template <class Visit>
void forEachBlock(const Coord& upperNode, const Visit& visit)
{
    for (int x = 0; x < upperNodeSize; x += blockSize) {
        for (int y = 0; y < upperNodeSize; y += blockSize) {
            for (int z = 0; z < upperNodeSize; z += blockSize) visit(upperNode.offsetBy(x, y, z));
        }
    }
}

/// The parts of a tree that are full without a leaf or entry tile.
struct FullParts {
    std::vector<Coord> upperNodes;
    std::vector<Coord> blocks; ///< outside the upper nodes
};
FullParts fullParts(const MaskTree& tree);

/// A finished block for a tree.
struct BuiltBlock {
    Coord origin;
    std::unique_ptr<LowerNode> node; ///< null: uniform
    bool full = false;
};

/// A builder of one block from its entries. Several threads may set different entries.
class BlockBuilder {
public:
    explicit BlockBuilder(const Coord& origin) : origin_(origin), leaves_(entriesPerBlock), full_(entriesPerBlock, 0) {}

    /// Sets entry n to `words`. Entries that are never set are empty.
    /// \pre n was not set before
    void set(int n, const std::uint64_t* words);
    BuiltBlock finish();

private:
    Coord origin_;
    std::vector<std::unique_ptr<MaskLeaf>> leaves_;
    std::vector<char> full_;
};

/// Makes the tree of the full parts, with the built blocks in their places. It is the smallest tree of its set, without
/// empty or full nodes, so equal sets make equal trees.
/// \pre no two blocks have the same origin
MaskTree::Ptr assemble(const FullParts& full, std::vector<BuiltBlock> built);

/// Frees a tree block by block. Freeing it at once would take long without asking the interrupter.
/// \pre nobody else has the tree
/// \throw Cancelled
void release(MaskTree& tree, const Progress& progress);

/// Checks that there is room around the active voxels for the arithmetic on coordinates.
/// \throw InputError active voxels outside [-2^30, 2^30)
void requireSupportedCoordinates(const MaskTree& tree);

/// The box of the set bits of an entry.
struct BitBox {
    std::array<std::int8_t, 3> lower, upper; ///< 0 to 7, inclusive
};
/// \pre a bit is set
BitBox bitBox(const std::uint64_t* words);

/// Rounds down to a multiple of `size`.
/// \pre `size` is a power of two
inline Coord alignedTo(const Coord& c, int size)
{
    return {c.x() & ~(size - 1), c.y() & ~(size - 1), c.z() & ~(size - 1)};
}

} // namespace vdbcage::detail
