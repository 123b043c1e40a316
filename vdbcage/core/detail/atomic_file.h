#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <vector>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// Checks, without touching anything, that a file can be written at `path`. Its folder exists and can be written to,
/// and its name is not too long. What stands there, if anything, is a file that can be replaced.
/// \throw IoError naming `path` and the reason
VDBCAGE_API void requireWritable(const std::filesystem::path& path);

/// Fills a file. The stream can seek. It need not look whether the stream has failed.
using FileWriter = std::function<void(std::ostream&)>;

/// Files that appear together or not at all.
///
/// Each is written to a temporary file in the folder of its target, under a name that no other process has on any
/// machine. It takes the target's name at `commit`. Until then nothing that existed is touched, and the temporary files
/// go with this object.
///
/// A file that is replaced gives its permissions (and, where the system allows it, its owner) to the new one. A target
/// that is a symbolic link stays one, and the file it leads to is replaced.
class VDBCAGE_API PendingFiles {
public:
    PendingFiles();
    ~PendingFiles();
    PendingFiles(const PendingFiles&) = delete;
    PendingFiles& operator=(const PendingFiles&) = delete;

    /// Has `write` fill the file that is to stand at `target`. Throws whatever `write` throws.
    /// \throw IoError naming `target` and the reason (no such folder, no permission, disk full)
    void add(const std::filesystem::path& target, const FileWriter& write);

    /// Gives every file its name. If one cannot have it, those that were replaced so far get their old content back.
    /// \throw IoError naming the target and the reason, and each target that could not be put back
    void commit();

    /// Removes the temporary files. Allocates nothing.
    void clear() noexcept;

private:
    class File;
    std::vector<std::unique_ptr<File>> files_;
};

/// Writes one file: PendingFiles with one target. Throws whatever `write` throws.
/// \throw IoError as PendingFiles
VDBCAGE_API void writeFileAtomically(const std::filesystem::path& path, const FileWriter& write);

} // namespace vdbcage
