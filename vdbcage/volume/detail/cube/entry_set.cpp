#include <vdbcage/volume/detail/cube/entry_set.h>

#include <algorithm>
#include <atomic>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/word_bits.h>

namespace vdbcage::detail {

namespace {

std::unique_ptr<FlatBlock> flattened(const LowerNode& node)
{
    auto made = std::make_unique<FlatBlock>();
    FlatBlock& flat = *made;
    flat.origin = node.origin();
    flat.words.reserve(node.childCount());
    for (std::size_t i = 0; i < FlatBlock::wordCount; ++i) {
        flat.full[i] = node.getValueMask().getWord<std::uint64_t>(static_cast<openvdb::Index>(i));
    }
    flat.some = flat.full;
    for (auto leaf = node.cbeginChildOn(); leaf; ++leaf) {
        Words words;
        std::copy_n(leaf->buffer().data(), words.size(), words.begin());
        if (words == emptyWords) continue;
        const std::uint64_t bit = 1ULL << (leaf.pos() % 64);
        flat.some[leaf.pos() / 64] |= bit;
        if (words == fullWords) {
            flat.full[leaf.pos() / 64] |= bit;
        } else {
            flat.words.push_back(words);
        }
    }
    flat.finish();
    return made;
}

BuiltBlock treeBlock(const FlatBlock& flat)
{
    BuiltBlock built{flat.origin, nullptr, flat.isFull()};
    if (flat.isUniform) return built;
    // Tiles are set one by one: there are fewer if the node begins with the state of most of its entries.
    const bool full =
        std::count(flat.full.begin(), flat.full.end(), ~0ULL) > std::count(flat.some.begin(), flat.some.end(), 0ULL);
    built.node = std::make_unique<LowerNode>(flat.origin, full, full);
    auto words = flat.words.begin();
    for (std::size_t i = 0; i < FlatBlock::wordCount; ++i) {
        const int first = static_cast<int>(i) * 64;
        for (std::uint64_t tiles = full ? ~flat.some[i] : flat.full[i]; tiles != 0; tiles &= tiles - 1) {
            const int n = first + __builtin_ctzll(tiles);
            built.node->addTile(static_cast<openvdb::Index>(n), !full, !full);
        }
        for (std::uint64_t mixed = flat.some[i] & ~flat.full[i]; mixed != 0; mixed &= mixed - 1) {
            auto leaf = std::make_unique<MaskLeaf>(flat.origin + entryOffset(first + __builtin_ctzll(mixed)));
            std::copy(words->begin(), words->end(), leaf->buffer().data());
            ++words;
            built.node->addChild(leaf.release());
        }
    }
    return built;
}

} // namespace

void FlatBlock::finish()
{
    std::size_t before = 0;
    for (std::size_t i = 0; i < wordCount; ++i) {
        for (std::size_t lane = 0; lane < 4; ++lane) {
            firstWords[4 * i + lane] = static_cast<std::uint16_t>(before);
            before += bitCount(static_cast<std::uint16_t>((some[i] & ~full[i]) >> (16 * lane)));
        }
    }
    const auto isAll = [](std::uint64_t word) { return [word](std::uint64_t other) { return other == word; }; };
    isUniform = std::all_of(some.begin(), some.end(), isAll(0)) || std::all_of(full.begin(), full.end(), isAll(~0ULL));
}

EntrySet::EntrySet(const MaskTree& tree, const Progress& progress) : full_(fullParts(tree))
{
    std::vector<const LowerNode*> nodes;
    tree.getNodes(nodes);
    flat_.resize(nodes.size());
    std::atomic<std::size_t> done{0};
    parallelFor(std::size_t{0}, nodes.size(), [&](std::size_t i) {
        progress.check(done++, nodes.size());
        flat_[i] = flattened(*nodes[i]);
    });
    indexFlat();
    indexFull();
}

EntrySet::EntrySet(FullParts full, std::vector<std::unique_ptr<FlatBlock>> flat, const Progress& progress)
    : flat_(std::move(flat)), full_(std::move(full))
{
    progress.check(1, 1);
    indexFlat();
    std::unordered_set<Coord> broken; // full upper nodes that no longer are
    for (const auto& block : flat_) {
        if (!block->isFull()) broken.insert(alignedTo(block->origin, upperNodeSize));
    }
    const auto isBroken = [&](const Coord& upperNode) {
        if (broken.count(upperNode) == 0) return false;
        forEachBlock(upperNode, [&](const Coord& block) { full_.blocks.push_back(block); });
        return true;
    };
    full_.upperNodes.erase(std::remove_if(full_.upperNodes.begin(), full_.upperNodes.end(), isBroken),
                           full_.upperNodes.end());
    progress.check(1, 1);
    const auto isReplaced = [&](const Coord& block) { return blocks_.count(block) > 0; };
    full_.blocks.erase(std::remove_if(full_.blocks.begin(), full_.blocks.end(), isReplaced), full_.blocks.end());
    for (const auto& block : flat_) {
        if (block->isFull()) full_.blocks.push_back(block->origin);
    }
    progress.check(1, 1);
    indexFull();
}

std::vector<Coord> EntrySet::shell() const
{
    std::vector<Coord> origins = facesOfUpperNodes(full_.upperNodes);
    for (const auto& [origin, entries] : blocks_) origins.push_back(origin);
    return origins;
}

MaskTree::Ptr EntrySet::tree(const Progress& progress) &&
{
    std::vector<BuiltBlock> built(flat_.size());
    std::atomic<std::size_t> done{0};
    parallelFor(std::size_t{0}, flat_.size(), [&](std::size_t i) {
        progress.check(done++, flat_.size());
        built[i] = treeBlock(*flat_[i]);
        flat_[i].reset(); // for the next nodes: reusing its memory is faster than touching new pages
    });
    return assemble(full_, std::move(built));
}

void EntrySet::indexFlat()
{
    blocks_.reserve(flat_.size() + full_.blocks.size());
    for (const auto& block : flat_) {
        blocks_.emplace(block->origin,
                        block->isUniform ? BlockEntries{nullptr, block->isFull()} : BlockEntries{block.get(), false});
    }
}

void EntrySet::indexFull()
{
    upperNodes_.insert(full_.upperNodes.begin(), full_.upperNodes.end());
    for (const Coord& origin : full_.blocks) blocks_.insert_or_assign(origin, BlockEntries{nullptr, true});
}

} // namespace vdbcage::detail
