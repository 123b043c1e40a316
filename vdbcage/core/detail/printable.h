#pragma once

#include <string>
#include <string_view>

#include <vdbcage/core/export.h>

namespace vdbcage::detail {

/// Returns `text` from outside, such as names of files and messages of drivers, as one line that is safe on a terminal.
///
/// Well-formed UTF-8 stays. Control characters, characters of Unicode that end lines or turn the direction of writing,
/// and bytes that are not UTF-8 become \n, \r, \t or \x and two hexadecimal digits a byte.
VDBCAGE_API std::string printable(std::string_view text);

} // namespace vdbcage::detail
