#pragma once

#include <algorithm>
#include <cmath>

#include <openvdb/math/BBox.h>
#include <vdbcage/core/detail/longest_side.h>

namespace vdbcage::detail {

/// Returns the float nearest to `value`. Volatile, because g++ 12 -O3 drops the conversion in parts of vectorized code.
inline double nearestFloat(double value)
{
    const volatile float rounded = static_cast<float>(value);
    return static_cast<double>(rounded);
}

inline openvdb::Vec3d nearestFloat(const openvdb::Vec3d& p)
{
    return {nearestFloat(p[0]), nearestFloat(p[1]), nearestFloat(p[2])};
}

/// Returns the largest absolute value of a coordinate in `box`.
inline double farthest(const openvdb::BBoxd& box)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box.min()[i]), std::abs(box.max()[i])});
    return largest;
}

/// Returns how far rounding to float moves a coordinate in `box`, at most: 2^-24 of the largest, plus the least
/// positive float.
inline double floatRounding(const openvdb::BBoxd& box)
{
    return farthest(box) * 0x1p-24 + 0x1p-149;
}

/// Returns whether a model in `box` is too large or too small for floats and their squares.
inline bool isBeyondFloat(const openvdb::BBoxd& box)
{
    return !(floatRounding(box) < 1e23 && longestSide(box) > 1e-30);
}

/// Returns whether a host that stores floats can hold a model of this box: rounding is far below its size.
/// \pre `box` is not empty
inline bool fitsFloat(const openvdb::BBoxd& box)
{
    return !isBeyondFloat(box) && floatRounding(box) < 1e-5 * longestSide(box);
}

} // namespace vdbcage::detail
