#pragma once

#include <cstddef>
#include <cstdint>

#include <vdbcage/volume/detail/mask_blocks.h>

namespace vdbcage::detail {

/// A structuring element: the voxels within `radius` along one axis.
struct Segment {
    explicit Segment(int voxels)
        : radius(voxels), wholeEntries(static_cast<std::size_t>(voxels / leafSize)), rest(voxels % leafSize),
          entryRadius(wholeEntries + (rest > 0 ? 1 : 0)), blockRadius((voxels + blockSize - 1) / blockSize)
    {
    }

    int radius;               ///< in voxels
    std::size_t wholeEntries; ///< the radius is this many entries ...
    int rest;                 ///< ... and this many voxels
    std::size_t entryRadius;  ///< in entries, rounded up
    int blockRadius;          ///< in blocks, rounded up
};

/// Replaces every value by the union of itself and the next ones, n values together (fewer at the end). Returns n, the
/// largest power of two that is at most `count`, so that two such unions, overlapping, cover `count` values.
inline std::size_t uniteAhead(std::uint64_t* values, std::size_t size, std::size_t count)
{
    std::size_t united = 1;
    for (; 2 * united <= count; united *= 2) {
        for (std::size_t i = 0; i + united < size; ++i) values[i] |= values[i + united];
    }
    return united;
}

} // namespace vdbcage::detail
