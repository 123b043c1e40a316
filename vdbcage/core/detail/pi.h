#pragma once

namespace vdbcage::detail {

/// Half a turn, in radians. M_PI is not in the standard of C++, and std::numbers only from C++20 on.
constexpr double pi = 3.14159265358979323846;

} // namespace vdbcage::detail
