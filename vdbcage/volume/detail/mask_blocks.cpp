#include <vdbcage/volume/detail/mask_blocks.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <sstream>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

constexpr int blocksPerUpperAxis = upperNodeSize / blockSize;

template <class Visit>
void forEachNode(const MaskTree& tree, const Visit& visit)
{
    for (auto upperNode = tree.root().cbeginChildOn(); upperNode; ++upperNode) {
        for (auto block = upperNode->cbeginChildOn(); block; ++block) visit(*block);
    }
}

template <class Visit>
void forEachFullBlockTile(const MaskTree& tree, const Visit& visit)
{
    for (auto upperNode = tree.root().cbeginChildOn(); upperNode; ++upperNode) {
        for (auto tile = upperNode->cbeginValueOn(); tile; ++tile) visit(tile.getCoord());
    }
}

bool isUniformlyFull(const LowerNode& node)
{
    const Block block(&node);
    for (int n = 0; n < entriesPerBlock; ++n) {
        const std::uint64_t* const words = block.entry(n);
        if (!std::equal(fullWords.begin(), fullWords.end(), words)) return false;
    }
    return true;
}

// Visits the blocks along the face of an upper node on one side of one axis.
template <class Visit>
void forEachFaceBlock(const Coord& upperNode, std::size_t axis, bool upper, const Visit& visit)
{
    for (int i = 0; i < blocksPerUpperAxis; ++i) {
        for (int j = 0; j < blocksPerUpperAxis; ++j) {
            Coord block = upperNode;
            block[axis] += upper ? upperNodeSize - blockSize : 0;
            block[(axis + 1) % 3] += i * blockSize;
            block[(axis + 2) % 3] += j * blockSize;
            visit(block);
        }
    }
}

} // namespace

Block blockAt(const MaskTree& tree, const Coord& origin)
{
    if (const auto* node = tree.root().probeConstNode<LowerNode>(origin)) return Block(node);
    return Block(tree.isValueOn(origin));
}

std::vector<Coord> shellBlocks(const MaskTree& tree)
{
    std::vector<Coord> blocks;
    forEachNode(tree, [&](const LowerNode& node) { blocks.push_back(node.origin()); });
    forEachFullBlockTile(tree, [&](const Coord& origin) { blocks.push_back(origin); });
    std::vector<Coord> upperNodes;
    for (auto tile = tree.root().cbeginValueOn(); tile; ++tile) upperNodes.push_back(tile.getCoord());
    for (const Coord& block : facesOfUpperNodes(upperNodes)) blocks.push_back(block);
    std::sort(blocks.begin(), blocks.end());
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
}

std::vector<Coord> facesOfUpperNodes(const std::vector<Coord>& upperNodes)
{
    const std::set<Coord> all(upperNodes.begin(), upperNodes.end());
    std::vector<Coord> blocks;
    for (const Coord& upperNode : upperNodes) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const bool upper : {false, true}) {
                Coord neighbour = upperNode;
                neighbour[axis] += upper ? upperNodeSize : -upperNodeSize;
                if (all.count(neighbour) > 0) continue;
                forEachFaceBlock(upperNode, axis, upper, [&](const Coord& c) { blocks.push_back(c); });
            }
        }
    }
    return blocks;
}

FullParts fullParts(const MaskTree& tree)
{
    FullParts parts;
    for (auto tile = tree.root().cbeginValueOn(); tile; ++tile) parts.upperNodes.push_back(tile.getCoord());
    forEachFullBlockTile(tree, [&](const Coord& origin) { parts.blocks.push_back(origin); });
    forEachNode(tree, [&](const LowerNode& node) {
        if (isUniformlyFull(node)) parts.blocks.push_back(node.origin());
    });
    return parts;
}

void BlockBuilder::set(int n, const std::uint64_t* words)
{
    const auto i = static_cast<std::size_t>(n);
    if (words == emptyWords.data()) return;
    if (words == fullWords.data()) {
        full_[i] = 1;
        return;
    }
    std::uint64_t any = 0, all = ~0ULL;
    for (int x = 0; x < leafSize; ++x) {
        any |= words[x];
        all &= words[x];
    }
    if (all == ~0ULL) {
        full_[i] = 1;
    } else if (any != 0) {
        leaves_[i] = std::make_unique<MaskLeaf>(origin_ + entryOffset(n));
        std::copy(words, words + leafSize, leaves_[i]->buffer().data());
    }
}

BuiltBlock BlockBuilder::finish()
{
    BuiltBlock built{origin_, nullptr, false};
    const auto tiles = std::count(full_.begin(), full_.end(), 1);
    const bool hasLeaf = std::any_of(leaves_.begin(), leaves_.end(), [](const auto& leaf) { return leaf != nullptr; });
    if (tiles == entriesPerBlock) built.full = true;
    if (!hasLeaf && (tiles == 0 || tiles == entriesPerBlock)) return built;
    built.node = std::make_unique<LowerNode>(origin_, false, false);
    for (std::size_t i = 0; i < leaves_.size(); ++i) {
        if (leaves_[i]) {
            built.node->addChild(leaves_[i].release());
        } else if (full_[i] != 0) {
            built.node->addTile(static_cast<openvdb::Index>(i), true, true);
        }
    }
    return built;
}

MaskTree::Ptr assemble(const FullParts& full, std::vector<BuiltBlock> built)
{
    std::map<Coord, std::unique_ptr<UpperNode>> upperNodes; // null: full
    for (const Coord& origin : full.upperNodes) upperNodes[origin] = nullptr;
    const auto upperNodeOf = [&](const Coord& origin) -> UpperNode& {
        const Coord key = alignedTo(origin, upperNodeSize);
        const auto [place, isNew] = upperNodes.try_emplace(key);
        if (!place->second) place->second = std::make_unique<UpperNode>(key, !isNew, !isNew);
        return *place->second;
    };
    const auto addTile = [](UpperNode& upperNode, const Coord& origin, bool on) {
        upperNode.addTile(UpperNode::coordToOffset(origin), on, on);
    };
    for (const Coord& origin : full.blocks) addTile(upperNodeOf(origin), origin, true);
    for (BuiltBlock& block : built) {
        if (block.node) {
            upperNodeOf(block.origin).addChild(block.node.release());
        } else if (block.full || upperNodes.count(alignedTo(block.origin, upperNodeSize)) > 0) {
            addTile(upperNodeOf(block.origin), block.origin, block.full);
        }
    }
    auto tree = emptyTree<MaskTree>(false);
    for (auto& [origin, upperNode] : upperNodes) {
        if (!upperNode || (upperNode->isChildMaskOff() && upperNode->isValueMaskOn())) {
            tree->root().addTile(origin, true, true);
        } else if (!upperNode->isChildMaskOff() || !upperNode->isValueMaskOff()) { // isEmpty() considers only children
            tree->root().addChild(upperNode.get());
            static_cast<void>(upperNode.release()); // not before the root has it
        }
    }
    return tree;
}

void release(MaskTree& tree, const Progress& progress)
{
    std::size_t count = 0;
    for (auto upperNode = tree.root().cbeginChildOn(); upperNode; ++upperNode) {
        count += upperNode->getChildMask().countOn();
    }
    std::vector<LowerNode*> stolen;
    std::vector<std::unique_ptr<LowerNode>> blocks;
    stolen.reserve(count); // so that nothing is lost where memory is lacking
    blocks.reserve(count);
    tree.stealNodes(stolen);
    for (LowerNode* const block : stolen) blocks.emplace_back(block);
    std::atomic<std::size_t> done{0};
    parallelFor(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        progress.check(done++, blocks.size());
        blocks[i].reset();
    });
}

void requireSupportedCoordinates(const MaskTree& tree)
{
    constexpr int limit = 1 << 30;
    const auto outside = [](const Coord& c) {
        const auto beyond = [](int v) { return v < -limit || v >= limit; };
        return beyond(c.x()) || beyond(c.y()) || beyond(c.z());
    };
    const auto require = [&](bool isSupported, const Coord& origin) {
        if (isSupported) return;
        std::ostringstream text;
        text << "the mask has active voxels near " << origin << "; coordinates must be in [-2^30, 2^30)";
        throw InputError(text.str());
    };
    // The limit is at a border of upper nodes, so the origins are enough.
    for (auto tile = tree.root().cbeginValueOn(); tile; ++tile) require(!outside(tile.getCoord()), tile.getCoord());
    for (auto upperNode = tree.root().cbeginChildOn(); upperNode; ++upperNode) {
        require(!outside(upperNode->origin()) || upperNode->onVoxelCount() == 0, upperNode->origin());
    }
}

BitBox bitBox(const std::uint64_t* words)
{
    std::uint64_t any = 0;
    int first = -1, last = 0;
    for (int x = 0; x < leafSize; ++x) {
        if (words[x] == 0) continue;
        if (first < 0) first = x;
        last = x;
        any |= words[x];
    }
    std::uint64_t z = any | (any >> 32);
    z |= z >> 16;
    z |= z >> 8;
    const auto byte = static_cast<unsigned>(z & 0xFF);
    const auto narrow = [](int v) { return static_cast<std::int8_t>(v); };
    return {{narrow(first), narrow(__builtin_ctzll(any) / 8), narrow(__builtin_ctz(byte))},
            {narrow(last), narrow(7 - __builtin_clzll(any) / 8), narrow(31 - __builtin_clz(byte))}};
}

} // namespace vdbcage::detail
