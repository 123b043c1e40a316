#pragma once

#include <string>
#include <string_view>

#include <vdbcage/mesh/io/warnings.h>

namespace vdbcage::detail {

/// Returns text that begins with a byte order mark of UTF-16 as UTF-8, in `storage`, and any other bytes unchanged.
/// Lone surrogates become U+FFFD.
/// \throw IoError naming `name`: the last character is cut off
std::string_view asUtf8(std::string_view bytes, const std::string& name, std::string& storage, Warnings& warnings);

} // namespace vdbcage::detail
