#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>

/// A mask between two passes along an axis. Its blocks have no nodes of a tree; bits mark empty and full entries.
namespace vdbcage::detail {

/// The number of stretches of a plane. A plane of a block has its entries of one x. A stretch is a quarter of a plane,
/// 4 x 16 entries: (y, z) is bit 16 (y % 4) + z.
constexpr int stretchesPerPlane = 4;

/// One block. Entry n is bit n % 64 of word n / 64, so word 4 x + y / 4 is one stretch of plane x.
struct FlatBlock {
    static constexpr std::size_t wordCount = entriesPerBlock / 64;

    Coord origin;
    std::array<std::uint64_t, wordCount> some{}, full{};          ///< the entries that are not empty; the full ones
    std::vector<Words> words;                                     ///< of the mixed ones, by entry
    std::array<std::uint16_t, entriesPerBlock / 16> firstWords{}; ///< by n / 16: the number of mixed entries before
    bool isUniform = true;

    /// Finds firstWords and isUniform.
    /// \pre the bits and the words are set
    void finish();
    bool isFull() const { return isUniform && full[0] != 0; }
};

/// One block of a mask: flat, or uniformly full or empty.
struct BlockEntries {
    const FlatBlock* flat = nullptr;
    bool full = false; ///< where it is uniform

    bool isFull() const { return !flat && full; }
    bool isEmpty() const { return !flat && !full; }
};

class EntrySet {
public:
    /// \throw Cancelled
    EntrySet(const MaskTree& tree, const Progress& progress);
    /// Takes the full parts, with the blocks in their places.
    /// \pre no two blocks have the same origin
    /// \throw Cancelled
    EntrySet(FullParts full, std::vector<std::unique_ptr<FlatBlock>> flat, const Progress& progress);

    BlockEntries at(const Coord& origin) const
    {
        const auto found = blocks_.find(origin);
        return found != blocks_.end() ? found->second
                                      : BlockEntries{nullptr, upperNodes_.count(alignedTo(origin, upperNodeSize)) > 0};
    }
    const FullParts& full() const { return full_; }
    /// Returns the blocks where the mask may begin or end, in no order.
    std::vector<Coord> shell() const;
    /// Makes the tree; frees the blocks on the way.
    /// \throw Cancelled
    MaskTree::Ptr tree(const Progress& progress) &&;

private:
    void indexFlat();
    void indexFull();

    std::vector<std::unique_ptr<FlatBlock>> flat_;
    FullParts full_;
    std::unordered_map<Coord, BlockEntries> blocks_;
    std::unordered_set<Coord> upperNodes_; // the full ones
};

} // namespace vdbcage::detail
