#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/pipeline/options.h>

namespace vdbcage::cli {

/// 16 hexadecimal digits that tell the version of vdbcage, the contents of `files` and the values of `options` apart:
/// FNV-1a of all bytes. \throw IoError a file cannot be read
std::string fingerprint(const std::vector<std::filesystem::path>& files, const CageOptions& options);

} // namespace vdbcage::cli
