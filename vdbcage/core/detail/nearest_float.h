#pragma once

namespace vdbcage::detail {

/// The float next to `value`. Volatile, because g++ 12 -O3 drops the conversion in parts of vectorized code.
inline double nearestFloat(double value)
{
    const volatile float rounded = static_cast<float>(value);
    return static_cast<double>(rounded);
}

} // namespace vdbcage::detail
