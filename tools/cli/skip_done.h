#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tools/report/report.h>

/// For --skip-done: reports tell which jobs were done.
namespace vdbcage::cli {

/// Returns 16 hexadecimal digits that differ for different versions of vdbcage, contents of `files`, or names and
/// values of `options`: FNV-1a of all bytes. \throw IoError a file cannot be read
std::string fingerprint(const std::vector<std::filesystem::path>& files,
                        const std::vector<std::pair<std::string, std::string>>& options);

/// Requires a report if `skipsDone`. \throw InputError
void requireReport(bool skipsDone, const std::filesystem::path& reportFile);

/// Returns whether the report has all of `facts`, which are its fields, and all of `results` exist.
/// \throw IoError the report cannot be read
bool wasDone(const std::filesystem::path& reportFile, const report::Json& facts,
             const std::vector<std::filesystem::path>& results);

} // namespace vdbcage::cli
