#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

constexpr int lanes = 64;        ///< the columns of an entry: column (x, y) is lane 8 y + x
constexpr int smallRadius = 120; ///< largest radius, rounded up, for which heights fit bytes

/// Returns the voxels between a position and an interval.
inline int gap(int position, int lower, int upper)
{
    return std::max({lower - position, position - upper, 0});
}

/// The height of no voxel. Heights count from it, so differences of bytes stay above 0.
template <class T>
constexpr T none = 0;
template <>
inline constexpr std::uint8_t none<std::uint8_t> = 128;

/// Tables of a sphere for a query: heights above them and squares of distances along an axis.
struct SphereTables {
    /// \throw Cancelled
    SphereTables(std::int64_t squared, const Progress& progress);

    /// Returns heights above a contour voxel at (-dx, -dy), seen from column (x, y) of an entry: [rowPlace(dx, dy) +
    /// lane].
    template <class T>
    const T* rows() const
    {
        if constexpr (sizeof(T) == 1)
            return smallRows.data();
        else
            return largeRows.data();
    }
    /// Returns the distance in rows() to the next dx. The next dy is 8 away.
    int rowStride() const { return (2 * rowRadius + 8) * 8; }
    int rowPlace(int dx, int dy) const { return (dx + rowRadius) * rowStride() + (dy + rowRadius) * 8; }
    /// Returns the same for contour voxels anywhere in the columns of an entry at the offset (-dx, -dy), in entries.
    template <class T>
    const T* entries() const
    {
        if constexpr (sizeof(T) == 1)
            return smallEntries.data();
        else
            return largeEntries.data();
    }
    /// Returns the distance in entries() to the next dx. The next dy is 64 away.
    int entryStride() const { return (2 * entryRadius + 1) * lanes; }
    int entryPlace(int dx, int dy) const { return (dx + entryRadius) * entryStride() + (dy + entryRadius) * lanes; }

    std::int64_t squaredRadius;
    int radius; ///< rounded up
    bool isSmall;
    int entryRadius, rowRadius; ///< largest offsets that are needed, in entries and voxels
    int coordinates;

    /// Squared distances along one axis, from a coordinate in the part to its four entries. They are divided by
    /// 2^shift, rounded down (near) or up (far), and cut just above the limit.
    struct Squares {
        std::array<std::int16_t, 4> below, above; ///< to the near end of an entry below or above the coordinate, else 0
        std::array<std::int16_t, 4> far;          ///< to the far end
    };
    const Squares& squares(int coordinate) const { return squares_[static_cast<std::size_t>(coordinate + margin())]; }
    /// The same, each four times.
    struct WideSquares {
        std::array<std::int16_t, 16> below, above, far;
    };
    const WideSquares& wideSquares(int coordinate) const
    {
        return wideSquares_[static_cast<std::size_t>(coordinate + margin())];
    }
    std::int16_t limit = 0;

private:
    int margin() const { return radius + 40; }
    template <class T>
    void fillHeights(std::vector<T>& rows, std::vector<T>& entries, const Progress& progress);
    void fillSquares();

    int shift = 0;
    std::vector<std::uint8_t> smallRows, smallEntries;
    std::vector<std::int16_t> largeRows, largeEntries;
    std::vector<Squares> squares_;
    std::vector<WideSquares> wideSquares_;
};

} // namespace vdbcage::detail
