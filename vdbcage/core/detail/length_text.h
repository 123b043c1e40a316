#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

namespace vdbcage::detail {

/// Returns the text of a length or coordinate for people: with the digits that resolve `step`, and no zeros after them.
/// \pre step is above 0
inline std::string lengthText(double value, double step)
{
    constexpr int most = 15;                                         // digits of a double
    const int last = static_cast<int>(std::floor(std::log10(step))); // the power of ten of the last digit
    if (std::abs(value) < std::pow(10.0, last) / 2) return "0";
    const int first = static_cast<int>(std::floor(std::log10(std::abs(value))));
    std::array<char, 64> text{};
    if (first >= most || last < -most) {
        std::snprintf(text.data(), text.size(), "%.*g", std::clamp(first - last + 1, 1, most), value);
        return text.data();
    }
    std::snprintf(text.data(), text.size(), "%.*f", std::clamp(-last, 0, std::max(0, most - 1 - first)), value);
    std::string digits = text.data();
    if (digits.find('.') == std::string::npos) return digits;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.back() == '.') digits.pop_back();
    return digits == "-0" ? "0" : digits;
}

} // namespace vdbcage::detail
