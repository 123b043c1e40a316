#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include <openvdb/math/Coord.h>
#include <openvdb/math/Transform.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// A dense box of bits, one a voxel, 64 voxels to a word along z.
///
/// Voxel (x, y, z), counted from the box's lowest corner, is bit z % 64 of word z / 64 of row (x, y). Rows lie y after
/// y, x after x. The bits of a row's last word that are beyond the box are zero.
class BitGrid {
public:
    using Word = std::uint64_t;
    static constexpr int wordBits = 64;

    /// Sets all bits to zero. Pages that are never written take no memory. `box` is inclusive and not empty.
    /// \throw std::bad_alloc
    explicit BitGrid(const openvdb::CoordBBox& box);

    const openvdb::CoordBBox& box() const { return box_; }
    openvdb::Coord size() const { return size_; }
    int wordsPerRow() const { return wordsPerRow_; }
    std::size_t wordCount() const;
    std::size_t rowOffset(int x, int y) const
    {
        return (static_cast<std::size_t>(x) * static_cast<std::size_t>(size_.y()) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(wordsPerRow_);
    }
    Word* words() { return words_.get(); }
    const Word* words() const { return words_.get(); }
    Word* row(int x, int y) { return words_.get() + rowOffset(x, y); }
    const Word* row(int x, int y) const { return words_.get() + rowOffset(x, y); }

private:
    struct Free {
        void operator()(Word* words) const { std::free(words); }
    };
    openvdb::CoordBBox box_;
    openvdb::Coord size_;
    int wordsPerRow_;
    std::unique_ptr<Word[], Free> words_;
};

/// Returns the set bits of `bits` as a mask with this transform. It has leaves where some voxels of 8^3 are on, tiles
/// where all are. Nothing is left to prune.
/// \throw Cancelled
/// Cost: O(words of bits), in parallel.
std::shared_ptr<openvdb::MaskGrid> toMask(const BitGrid& bits, const openvdb::math::Transform::Ptr& transform,
                                          Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
