#pragma once

#include <filesystem>
#include <string>

namespace vdbcage::detail {

/// Checks that `path`, if it exists, is a regular file: pipes and devices have no size and may never end. Whether it
/// exists is left to the code that opens it.
/// \throw IoError naming the path: a directory, pipe, socket or device
void requireRegularFile(const std::filesystem::path& path);

/// Reads all of a regular file. It asks the size once, so bytes appended meanwhile are not read.
/// \throw IoError naming the path: a directory, pipe, socket or device; cannot be read; empty
std::string readFile(const std::filesystem::path& path);

} // namespace vdbcage::detail
