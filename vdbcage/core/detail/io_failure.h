#pragma once

#include <filesystem>
#include <new>
#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/core/export.h>

namespace vdbcage::detail {

/// \throw ResourceError if `error`, an errno, means that memory or disk space is lacking; else IoError. The text is
/// `what`, and the system's message if there is one
[[noreturn]] VDBCAGE_API void throwIoError(const std::string& what, int error);

/// Returns the result of `read`. \throw ResourceError naming `path` if there is not enough memory for it
template <typename Read>
auto withMemoryToRead(const std::filesystem::path& path, const Read& read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw ResourceError(path.string() + ": there is not enough memory to read it");
    }
}

} // namespace vdbcage::detail
