#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>

/// A mask between two passes along an axis: blocks without the nodes of a tree, whose slots are known by single bits.
namespace vdbcage::detail {

/// 4 x 16 slots of one x in a block, for one of the 4 stretches of 4 y: slot (y, z) at bit 16 (y % 4) + z.
constexpr int stretchesPerPlane = 4;

/// One block. Slot n is bit n % 64 of word n / 64, so that word 4 x + y / 4 is one stretch of plane x.
struct FlatBlock {
    static constexpr std::size_t wordCount = slotsPerBlock / 64;

    Coord origin;
    std::array<std::uint64_t, wordCount> some{}, full{};        ///< which slots are not empty; which are full
    std::vector<Words> words;                                   ///< of the mixed ones, by slot
    std::array<std::uint16_t, slotsPerBlock / 16> firstWords{}; ///< by n / 16: how many mixed slots are before
    bool isUniform = true;

    /// To be called when the bits and the words are set: finds the rest.
    void finish();
    bool isFull() const { return isUniform && full[0] != 0; }
};

/// One block of a mask: flat, or uniformly full or empty.
struct Slots {
    const FlatBlock* flat = nullptr;
    bool full = false; ///< where it is uniform

    bool isFull() const { return !flat && full; }
    bool isEmpty() const { return !flat && !full; }
};

/// A mask by its blocks.
class SlotSet {
public:
    /// \throw Cancelled, as the others
    SlotSet(const MaskTree& tree, const Progress& progress);
    /// The full parts, with the blocks (each origin once) in their places.
    SlotSet(FullParts full, std::vector<std::unique_ptr<FlatBlock>> flat, const Progress& progress);

    Slots at(const Coord& origin) const
    {
        const auto found = blocks_.find(origin);
        return found != blocks_.end() ? found->second
                                      : Slots{nullptr, regions_.count(alignedTo(origin, regionSize)) > 0};
    }
    const FullParts& full() const { return full_; }
    /// The blocks where the mask may begin or end, in no order.
    std::vector<Coord> shell() const;
    /// Frees the blocks on the way.
    MaskTree::Ptr tree(const Progress& progress) &&;

private:
    void indexFlat();
    void indexFull();

    std::vector<std::unique_ptr<FlatBlock>> flat_;
    FullParts full_;
    std::unordered_map<Coord, Slots> blocks_;
    std::unordered_set<Coord> regions_; // the full ones
};

} // namespace vdbcage::detail
