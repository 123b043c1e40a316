#pragma once

#include <string>
#include <string_view>

#include <vdbcage/core/export.h>

namespace vdbcage::detail {

/// `text` in one line that a terminal shows as it is, whoever chose it: names of files and options, words of drivers.
///
/// Well-formed UTF-8 stays. Control characters, and those of Unicode that end lines or turn the direction of writing,
/// become \n, \r, \t or \x and two hexadecimal digits a byte. So do bytes that are not UTF-8.
VDBCAGE_API std::string printable(std::string_view text);

} // namespace vdbcage::detail
