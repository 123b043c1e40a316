#pragma once

#include <charconv>
#include <string>

namespace vdbcage::detail {

/// Returns the shortest decimal digits that read back as the same value, in any locale; or nan, inf, -inf.
inline std::string numberText(double value)
{
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof(digits), value).ptr};
}

} // namespace vdbcage::detail
