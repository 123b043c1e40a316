#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/// Four floats at a time: one for each child of a tree's node.
namespace vdbcage::detail {

using Floats = float __attribute__((vector_size(16)));
using Lanes = std::int32_t __attribute__((vector_size(16))); ///< the result of a comparison of Floats: 0 or -1 each

inline Floats least(Floats a, Floats b)
{
    return a < b ? a : b;
}
inline Floats greatest(Floats a, Floats b)
{
    return a > b ? a : b;
}

inline float leastOf(Floats v)
{
    v = least(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
    return least(v, __builtin_shufflevector(v, v, 1, 0, 3, 2))[0];
}
inline float greatestOf(Floats v)
{
    return -leastOf(-v);
}

/// Returns a float not above, off by up to 2e-7 of the value.
inline float roundedDown(double value)
{
    return static_cast<float>(value - 1.2e-7 * std::abs(value) - 1e-40);
}
/// Returns a float not below, off by up to 2e-7 of the value.
inline float roundedUp(double value)
{
    return static_cast<float>(value + 1.2e-7 * std::abs(value) + 1e-40);
}

/// Returns the results of a comparison, a bit each.
inline unsigned bits(const Lanes& lanes)
{
#ifdef __SSE2__
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(lanes)));
#else
    return (lanes[0] & 1U) | (lanes[1] & 2U) | (lanes[2] & 4U) | (lanes[3] & 8U);
#endif
}

/// A box; the fourth components mean nothing. It is empty by default.
struct FloatBox {
    Floats lo = Floats{} + std::numeric_limits<float>::infinity(), hi = -lo;

    void expand(Floats otherLo, Floats otherHi)
    {
        lo = least(lo, otherLo);
        hi = greatest(hi, otherHi);
    }
    float area() const
    {
        const Floats size = hi - lo;
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

/// The boxes of a node's children. A child is absent where a value is NaN, or the least is above the most.
struct FourBoxes {
    std::array<Floats, 3> lo, hi;

    /// Returns which of them meet the box from `otherLo` to `otherHi`, each of which has the same value four times.
    Lanes meet(const std::array<Floats, 3>& otherLo, const std::array<Floats, 3>& otherHi) const
    {
        return (lo[0] <= otherHi[0]) & (hi[0] >= otherLo[0]) & (lo[1] <= otherHi[1]) & (hi[1] >= otherLo[1]) &
               (lo[2] <= otherHi[2]) & (hi[2] >= otherLo[2]);
    }
};

} // namespace vdbcage::detail
