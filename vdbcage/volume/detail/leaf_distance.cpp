#include <vdbcage/volume/detail/leaf_distance.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vdbcage::detail {

namespace {

// Distance from a position to an interval.
int gap(int position, int lower, int upper)
{
    return std::max({lower - position, position - upper, 0});
}

// plane = min(plane, alongY + alongZ), where alongZ has one row of 8 for all rows of the plane.
template <class T>
inline void minimise(T* __restrict plane, const T* __restrict alongY, const T* __restrict alongZ)
{
    for (int y = 0; y < 8; ++y) {
        for (int z = 0; z < 8; ++z) {
            const T sum = static_cast<T>(alongY[8 * y + z] + alongZ[z]);
            plane[8 * y + z] = sum < plane[8 * y + z] ? sum : plane[8 * y + z];
        }
    }
}

// found |= plane <= limit
template <class T>
inline void compare(T* __restrict found, const T* __restrict plane, T limit)
{
    for (int i = 0; i < 64; ++i) found[i] = static_cast<T>(found[i] | (plane[i] <= limit ? T(-1) : T(0)));
}

// Bit i of the result is the sign of lane i.
template <class T>
inline std::uint64_t bitsOf(const T* found)
{
    std::array<std::uint8_t, 64> bytes;
    for (std::size_t i = 0; i < 64; ++i) bytes[i] = static_cast<std::uint8_t>(found[i] & 1);
    std::uint64_t bits = 0;
    for (std::size_t y = 0; y < 8; ++y) {
        std::uint64_t row = 0;
        for (std::size_t z = 0; z < 8; ++z) row |= static_cast<std::uint64_t>(bytes[8 * y + z]) << (8 * z);
        // Moves bit 0 of byte z to bit 56 + z; the partial products do not meet.
        bits |= ((row * 0x0102040810204080ULL) >> 56) << (8 * y);
    }
    return bits;
}

} // namespace

template <class T>
LeafDistance<T>::LeafDistance(std::int64_t squaredRadius) : squaredRadius_(squaredRadius)
{
    // A contour leaf in reach may have voxels up to 7 further, and the slot's own far side is up to 7 away.
    reach_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(squaredRadius)))) + 16;
    for (int d = -reach_; d <= reach_; ++d) {
        squares_.push_back(static_cast<T>(d * d));
        squareRows_.insert(squareRows_.end(), 8, static_cast<T>(d * d));
    }
    for (int byte = 1; byte < 256; ++byte) {
        for (int i = 0; i < 8; ++i) {
            int nearest = 64;
            for (int bit = 0; bit < 8; ++bit) {
                if ((byte >> bit & 1) != 0) nearest = std::min(nearest, (bit - i) * (bit - i));
            }
            inLeaf_[static_cast<std::size_t>(byte)][static_cast<std::size_t>(i)] = static_cast<T>(nearest);
        }
    }
    const auto planes = static_cast<std::size_t>(2 * reach_);
    planes_.resize(planes * lanes);
    isUsed_.resize(planes, 0);
}

template <class T>
void LeafDistance<T>::start(const Coord& origin, const BitBox& box)
{
    origin_ = origin;
    box_ = box;
    for (const int x : used_) isUsed_[static_cast<std::size_t>(x + reach_)] = 0;
    used_.clear();
}

template <class T>
void LeafDistance<T>::add(const ContourLeaf& leaf)
{
    const Coord offset = leaf.origin - origin_;
    const auto axisGap = [&](std::size_t axis) {
        const int o = offset[static_cast<int>(axis)];
        return std::max({o + leaf.box.lower[axis] - box_.upper[axis], box_.lower[axis] - o - leaf.box.upper[axis], 0});
    };
    const int gapY = axisGap(1), gapZ = axisGap(2);
    const std::int64_t squaredGap = std::int64_t{gapY} * gapY + std::int64_t{gapZ} * gapZ;
    for (int i = leaf.box.lower[0]; i <= leaf.box.upper[0]; ++i) {
        std::uint64_t word = leaf.words[static_cast<std::size_t>(i)];
        const int x = offset.x() + i;
        const int gapX = gap(x, box_.lower[0], box_.upper[0]);
        if (word == 0 || squaredGap + std::int64_t{gapX} * gapX > squaredRadius_) continue;
        T* const target = plane(x);
        if (isUsed_[static_cast<std::size_t>(x + reach_)] == 0) {
            isUsed_[static_cast<std::size_t>(x + reach_)] = 1;
            used_.push_back(x);
            std::fill(target, target + lanes, std::numeric_limits<T>::max());
        }
        while (word != 0) {
            const int y = __builtin_ctzll(word) >> 3;
            const auto row = static_cast<unsigned>(word >> (8 * y)) & 0xFFU;
            word &= ~(0xFFULL << (8 * y));
            const T* alongZ = inLeaf_[row].data();
            if (offset.z() != 0) { // only the end of the row that faces the slot counts
                const int z = offset.z() + (offset.z() > 0 ? __builtin_ctz(row) : 31 - __builtin_clz(row));
                alongZ = squares_.data() + (reach_ - z);
            }
            const T* const alongY = squareRows_.data() + static_cast<std::ptrdiff_t>(8) * (reach_ - (offset.y() + y));
            minimise(target, alongY, alongZ);
        }
    }
}

template <class T>
Words LeafDistance<T>::within(const Words& wanted)
{
    Words result{};
    for (int x = box_.lower[0]; x <= box_.upper[0]; ++x) {
        const std::uint64_t want = wanted[static_cast<std::size_t>(x)];
        if (want == 0) continue;
        alignas(64) std::array<T, lanes> found{};
        for (const int planeX : used_) {
            const std::int64_t limit = squaredRadius_ - std::int64_t{x - planeX} * (x - planeX);
            if (limit >= 0) compare(found.data(), plane(planeX), static_cast<T>(limit));
        }
        result[static_cast<std::size_t>(x)] = bitsOf(found.data()) & want;
    }
    return result;
}

template class LeafDistance<std::int16_t>;
template class LeafDistance<std::int32_t>;

} // namespace vdbcage::detail
