#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <vdbcage/volume/detail/contour_leaves.h>

namespace vdbcage::detail {

/// Which voxels of one slot lie within a radius of given contour voxels: squared distances, minimised axis by axis.
///
/// T holds squared distances: int16_t up to smallRadius (the widest vectors and a minimum instruction on every
/// machine), int32_t beyond. One object a thread: it keeps its work space.
template <class T>
class LeafDistance {
public:
    explicit LeafDistance(std::int64_t squaredRadius);

    /// Starts the slot at `origin`; only voxels within `box` will be asked for.
    void start(const Coord& origin, const BitBox& box);
    /// Takes in contour voxels. Those out of reach of the box are passed over.
    void add(const ContourLeaf& leaf);
    /// The bits of `wanted` (8 words, set bits in the box) that lie within the radius of a voxel taken in.
    Words within(const Words& wanted);

private:
    static constexpr int lanes = 64; // the (y, z) of one x

    T* plane(int x) { return planes_.data() + static_cast<std::ptrdiff_t>(x + reach_) * lanes; }

    std::int64_t squaredRadius_;
    int reach_;              // no distance along one axis that matters, or that the tables are asked for, is as large
    std::vector<T> squares_; // [reach_ + d] = d^2
    std::vector<T> squareRows_;                // the same, each 8 times
    std::array<std::array<T, 8>, 256> inLeaf_; // of position i to the nearest set bit of a byte
    std::vector<T> planes_;                    // by x: squared distance in the plane to the contour voxels with this x
    std::vector<int> used_;                    // the x of the planes in use
    std::vector<char> isUsed_;
    Coord origin_;
    BitBox box_{};
};

/// The largest radius, rounded up, whose sums of squares fit 16 bits (see LeafDistance and sphere_pass.cpp).
constexpr int smallRadius = 103;

extern template class LeafDistance<std::int16_t>;
extern template class LeafDistance<std::int32_t>;

} // namespace vdbcage::detail
