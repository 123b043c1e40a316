#include <vdbcage/voxelize/detail/bit_grid.h>

#include <algorithm>
#include <array>
#include <new>
#include <vector>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/word_bits.h>

namespace vdbcage::detail {

namespace {

using Word = BitGrid::Word;
using UpperNode = openvdb::MaskTree::RootNodeType::ChildNodeType; // 4096^3
using LowerNode = UpperNode::ChildNodeType;                       // 128^3
using Leaf = LowerNode::ChildNodeType;                            // 8^3
constexpr int leafSize = Leaf::DIM;
constexpr int nodeSize = LowerNode::DIM;

/// Returns 64 bits of a row, the lowest at position `start` of the row; zero beyond both ends.
Word window(const Word* row, int wordsPerRow, int start)
{
    const int word = start >> 6, shift = start & 63;
    const auto at = [&](int i) { return i >= 0 && i < wordsPerRow ? row[i] : Word(0); };
    return shift == 0 ? at(word) : at(word) >> shift | at(word + 1) << (64 - shift);
}

/// A node of 128^3 voxels, or its uniform state.
struct Block {
    std::unique_ptr<LowerNode> node; ///< null if every voxel of the block is off, or every one on
    bool full = false;
};

class BlockBuilder {
public:
    BlockBuilder(const BitGrid& bits, const openvdb::Coord& origin) : bits_(bits), origin_(origin) {}

    Block build()
    {
        const openvdb::Coord low = openvdb::Coord::maxComponent(origin_, bits_.box().min() & ~(leafSize - 1));
        const openvdb::Coord high = openvdb::Coord::minComponent(origin_.offsetBy(nodeSize - 1), bits_.box().max());
        for (int x = low.x(); x <= high.x(); x += leafSize) {
            for (int y = low.y(); y <= high.y(); y += leafSize) {
                for (int z = origin_.z(); z <= high.z(); z += BitGrid::wordBits) addLeaves({x, y, z});
            }
        }
        if (tiles_ == LowerNode::NUM_VALUES) return {nullptr, true};
        return std::move(block_);
    }

private:
    /// Adds eight leaves in a row along z, the first at `origin`.
    void addLeaves(const openvdb::Coord& origin)
    {
        const openvdb::Coord& base = bits_.box().min();
        std::array<Word, 8> leaves[8]; // [x][y] while gathering, then [x][leaf]
        Word any = 0, all = ~Word(0);
        for (int x = 0; x < 8; ++x) {
            Word* const words = leaves[x].data();
            for (int y = 0; y < 8; ++y) {
                const int rowX = origin.x() + x - base.x(), rowY = origin.y() + y - base.y();
                const bool inside = rowX >= 0 && rowX < bits_.size().x() && rowY >= 0 && rowY < bits_.size().y();
                const Word word =
                    inside ? window(bits_.row(rowX, rowY), bits_.wordsPerRow(), origin.z() - base.z()) : Word(0);
                words[y] = word;
                any |= word;
                all &= word;
            }
        }
        if (any == 0) return;
        for (auto& slice : leaves) transposeBytes(slice);
        for (int i = 0; i < 8; ++i) {
            if ((any >> (8 * i) & 0xff) == 0) continue;
            if (!block_.node) block_.node = std::make_unique<LowerNode>(origin_, false);
            const openvdb::Coord leafOrigin = origin.offsetBy(0, 0, leafSize * i);
            if ((all >> (8 * i) & 0xff) == 0xff) {
                block_.node->addTile(1, leafOrigin, true, true);
                ++tiles_;
            } else {
                auto leaf = std::make_unique<Leaf>(leafOrigin);
                for (int x = 0; x < 8; ++x) leaf->buffer().data()[x] = leaves[x].data()[i];
                block_.node->addLeaf(leaf.release());
            }
        }
    }

    const BitGrid& bits_;
    const openvdb::Coord origin_;
    Block block_;
    openvdb::Index tiles_ = 0;
};

} // namespace

BitGrid::BitGrid(const openvdb::CoordBBox& box)
    : box_(box), size_(box.dim()), wordsPerRow_((size_.z() + wordBits - 1) / wordBits),
      words_(static_cast<Word*>(std::calloc(wordCount(), sizeof(Word))))
{
    if (!words_) throw std::bad_alloc();
}

std::size_t BitGrid::wordCount() const
{
    return rowOffset(size_.x(), 0);
}

openvdb::MaskGrid::Ptr toMask(const BitGrid& bits, const openvdb::math::Transform::Ptr& transform,
                              Interrupter* interrupter)
{
    // Blocks are numbered from `first`, the node with the lowest voxel, z fastest.
    const openvdb::Coord first = bits.box().min() & ~(nodeSize - 1);
    const openvdb::Coord last = bits.box().max() & ~(nodeSize - 1);
    const openvdb::Coord count((last.x() - first.x()) / nodeSize + 1, (last.y() - first.y()) / nodeSize + 1,
                               (last.z() - first.z()) / nodeSize + 1);
    const auto origin = [&](int i) {
        return first.offsetBy(nodeSize * (i / (count.y() * count.z())), nodeSize * (i / count.z() % count.y()),
                              nodeSize * (i % count.z()));
    };
    std::vector<Block> blocks(static_cast<std::size_t>(count.x() * count.y() * count.z()));
    parallelFor(0, static_cast<int>(blocks.size()), [&](int i) {
        throwIfInterrupted(interrupter);
        blocks[static_cast<std::size_t>(i)] = BlockBuilder(bits, origin(i)).build();
    });

    auto mask = openvdb::MaskGrid::create(emptyTree<openvdb::MaskTree>(false));
    mask->setTransform(transform);
    auto& root = mask->tree().root();
    for (int i = 0; i < static_cast<int>(blocks.size()); ++i) {
        Block& block = blocks[static_cast<std::size_t>(i)];
        if (!block.node && !block.full) continue;
        auto* upper = root.probeNode<UpperNode>(origin(i));
        if (!upper) {
            auto made = std::make_unique<UpperNode>(origin(i), false);
            root.addChild(made.get());
            upper = made.release();
        }
        if (block.full) {
            upper->addTile(2, origin(i), true, true);
        } else {
            upper->addChild(block.node.release());
        }
    }
    return mask;
}

} // namespace vdbcage::detail
