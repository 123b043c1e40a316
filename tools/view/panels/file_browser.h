#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tools/view/files/folder.h>

namespace vdbcage::view {

/// What is remembered of the file browser.
struct FileBrowser {
    std::string verb; ///< of the line that is asked for in the end; empty: closed
    std::string title, button;
    std::vector<std::string> extensions; ///< empty: folders are chosen
    bool saves = false;
    std::filesystem::path folder;
    std::string name;     ///< the name that is typed, or a path
    std::string filter;   ///< part of the names that are listed
    std::string question; ///< that must be answered first: the file is there already
    std::string problem;
    std::vector<FolderEntry> entries;
    bool isStale = true; ///< `entries` are to be read anew

    bool isOpen() const { return !verb.empty(); }
};

/// Opens the browser for the line that begins with `verb`, such as "open" or "save-cage". `suggested` is a path whose
/// folder and name are offered. \throw InputError no such verb
void open(FileBrowser& browser, const std::string& verb, const std::filesystem::path& suggested);

} // namespace vdbcage::view
