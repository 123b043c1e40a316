#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <ostream>
#include <vector>

#include <vdbcage/core/export.h>

namespace vdbcage {

/// Checks, without touching anything, that a file can be written at `path`: its folder exists and can be written to,
/// its name is not too long, and anything there already is a file that can be replaced.
/// \throw IoError naming `path` and the reason
VDBCAGE_API void requireWritable(const std::filesystem::path& path);

/// A function that fills a file. The stream can seek. The function need not check whether the stream has failed.
using FileWriter = std::function<void(std::ostream&)>;

/// Files that appear together or not at all.
///
/// Each is written to a temporary file in the folder of its target, under a name that no other process uses on any
/// machine, and takes the target's name at `commit`. Until then no existing file is touched, and this object's
/// destructor removes the temporary files.
///
/// The new file takes the permissions (and, where the system allows it, the owner) of the one that it replaces. A
/// target that is a symbolic link stays one, and the file it leads to is replaced.
class VDBCAGE_API PendingFiles {
public:
    PendingFiles();
    ~PendingFiles();
    PendingFiles(const PendingFiles&) = delete;
    PendingFiles& operator=(const PendingFiles&) = delete;

    /// Lets `write` fill the file for `target`. Throws whatever `write` throws.
    /// \throw IoError naming `target` and the reason (no such folder, no permission, disk full)
    void add(const std::filesystem::path& target, const FileWriter& write);

    /// Renames every file to its target. If one rename fails, the targets replaced so far get their old content back.
    /// \throw IoError naming the target and the reason, and each target that could not be restored
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
