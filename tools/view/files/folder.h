#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The content of the file browser, and the files that were opened last.
namespace vdbcage::view {

struct FolderEntry {
    std::string name;
    bool isFolder = false;
    std::uintmax_t bytes = 0; ///< of the file
};

/// Returns the folders in `folder`, then its files that end in one of `extensions` (in any case; all files if there are
/// none). Only names that contain `text`, in any case, are in it, and those that begin with a dot only if `text` does.
/// Sorted by name regardless of case. \throw IoError
std::vector<FolderEntry> listFolder(const std::filesystem::path& folder, const std::vector<std::string>& extensions,
                                    const std::string& text);

/// Returns the file that keeps the list of recent files: below $XDG_CONFIG_HOME, or ~/.config. Empty if neither is
/// known.
std::filesystem::path recentFilesPath();
/// Returns the newest first, at most 10, except files that are gone. Empty if there is no such list.
std::vector<std::filesystem::path> recentFiles(const std::filesystem::path& list);
/// Puts `file` first. Ignores errors of writing: the list is only a convenience.
void addRecentFile(const std::filesystem::path& list, const std::filesystem::path& file);

} // namespace vdbcage::view
