#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/pipeline/options.h>

namespace vdbcage::cli {

/// Returns 16 hexadecimal digits that differ for different versions of vdbcage, contents of `files` or values of
/// `options`: FNV-1a of all bytes. \throw IoError a file cannot be read
std::string fingerprint(const std::vector<std::filesystem::path>& files, const CageOptions& options);

} // namespace vdbcage::cli
