#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace vdbcage::cli {

/// Returns the bytes of memory that this process can have: the least of the machine's available memory, the limits of
/// its control groups and their parents (versions 1 and 2), and its own limit (ulimit -v). A limit that cannot be read
/// does not count. `root` stands for "/".
std::size_t memoryAtHand(const std::filesystem::path& root = "/");

/// Returns the bytes that `--memory` allows. `text` is a size as 4G, 512M, 1.5G or 4000000000 (K, M, G, T: powers of
/// 1024); or auto, which is 80 % of memoryAtHand(); or off: no limit.
/// \throw InputError it is none of these
std::size_t memoryLimit(const std::string& text);

} // namespace vdbcage::cli
