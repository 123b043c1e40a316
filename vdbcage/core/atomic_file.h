#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// Checks, without touching anything, that a file can be written at `path`: its folder exists and can be written to,
/// and what stands there, if anything, is a file that can be replaced. \throw IoError naming `path` and the reason
VDBCAGE_API void requireWritable(const std::filesystem::path& path);

/// Writes a file that appears whole or not at all: `write` fills a temporary file in the same folder, which is then
/// renamed to `path`. If anything fails the temporary file is removed and what stood at `path` before is untouched.
/// \throw IoError naming `path` and the reason (no such folder, no permission, disk full); whatever `write` throws
VDBCAGE_API void writeFileAtomically(const std::filesystem::path& path,
                                     const std::function<void(std::ostream&)>& write);

/// The same for writers that open a file by its name (libpng, OpenVDB): `write` gets the temporary file's path, which
/// ends in the same extension.
VDBCAGE_API void writePathAtomically(const std::filesystem::path& path,
                                     const std::function<void(const std::filesystem::path&)>& write);

} // namespace vdbcage
