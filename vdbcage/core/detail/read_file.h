#pragma once

#include <filesystem>
#include <string>

namespace vdbcage::detail {

/// All of a regular file. Its size is asked once: what is appended meanwhile is not read.
/// \throw IoError naming the path: a directory, a pipe, socket or device, cannot be read, empty
std::string readFile(const std::filesystem::path& path);

} // namespace vdbcage::detail
