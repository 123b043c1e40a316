#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace vdbcage::cli {

/// How much memory this process can have, in bytes: the least of what the machine has available, what its control
/// groups and those around them allow (versions 1 and 2), and its own limit (ulimit -v). What cannot be read counts as
/// no limit. `root` stands for "/".
std::size_t memoryAtHand(const std::filesystem::path& root = "/");

/// The bytes that `--memory` allows. `text` is a size as 4G, 512M, 1.5G or 4000000000 (K, M, G, T: powers of 1024); or
/// auto, which is 80 % of memoryAtHand(); or off: no limit.
/// \throw InputError it is none of these
std::size_t memoryLimit(const std::string& text);

} // namespace vdbcage::cli
