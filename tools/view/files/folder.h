#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

/// What the file browser shows, and the files that were opened last.
namespace vdbcage::view {

struct FolderEntry {
    std::string name;
    bool isFolder = false;
    std::uintmax_t bytes = 0; ///< of a file
};

/// The folders in `folder`, then its files that end in one of `extensions` (in any case; all if there are none). Those
/// without `text` in their name, in any case, are left out. So are names that begin with a dot, unless `text` does.
/// Sorted by name, capitals or not. \throw IoError
std::vector<FolderEntry> listFolder(const std::filesystem::path& folder, const std::vector<std::string>& extensions,
                                    const std::string& text);

/// The list of recent files is kept in this file: below $XDG_CONFIG_HOME, or ~/.config. Empty if neither is known.
std::filesystem::path recentFilesPath();
/// The newest first, at most 10; those that are gone are left out. Empty if there is no such list.
std::vector<std::filesystem::path> recentFiles(const std::filesystem::path& list);
/// Puts `file` first. What cannot be written is not: it is no more than a convenience.
void addRecentFile(const std::filesystem::path& list, const std::filesystem::path& file);

} // namespace vdbcage::view
