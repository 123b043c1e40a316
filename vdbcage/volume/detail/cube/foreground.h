#pragma once

#include <cstddef>
#include <cstdint>

#include <vdbcage/volume/detail/cube/entry_set.h>

namespace vdbcage::detail {

/// The voxels from which a dilation starts: those of a mask, or of its complement where the mask is eroded.
struct Foreground {
    enum class Side { mask, complement };
    Foreground(const EntrySet& entrySet, Side side) : mask(entrySet), flip(side == Side::complement ? ~0ULL : 0) {}

    bool isFull(const BlockEntries& block) const { return flip != 0 ? block.isEmpty() : block.isFull(); }
    bool isEmpty(const BlockEntries& block) const { return flip != 0 ? block.isFull() : block.isEmpty(); }

    /// Returns word n (see FlatBlock) of the entries of the block that are not empty.
    std::uint64_t some(const BlockEntries& block, std::size_t n) const
    {
        if (!block.flat) return isFull(block) ? ~0ULL : 0;
        return flip != 0 ? ~block.flat->full[n] : block.flat->some[n];
    }
    /// Returns word n of the entries that are full.
    std::uint64_t full(const BlockEntries& block, std::size_t n) const
    {
        if (!block.flat) return isFull(block) ? ~0ULL : 0;
        return flip != 0 ? ~block.flat->some[n] : block.flat->full[n];
    }

    const EntrySet& mask;
    std::uint64_t flip; ///< a word of the mask becomes one of the foreground by exclusive or
};

} // namespace vdbcage::detail
