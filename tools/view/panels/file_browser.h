#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tools/view/files/folder.h>
#include <tools/view/input/verbs.h>

namespace vdbcage::view {

/// A line that takes a file, and how the file is asked for.
struct FileLine {
    std::string name;
    Action (*of)(const std::string& path);
    const char* title;
    std::vector<std::string> extensions; ///< empty: folders are chosen
    const char* ending = nullptr;        ///< of the name offered to save by: the model's, and this; null: it opens
    bool isSequence = false;
};

/// What is remembered of the file browser.
struct FileBrowser {
    bool isOpen = false;
    const FileLine* line = nullptr; ///< that is asked for in the end; null: it was never open
    std::filesystem::path folder;
    std::string name;     ///< the name that is typed, or a path
    std::string filter;   ///< part of the names that are listed
    std::string question; ///< that must be answered first: the file is there already
    std::string problem;
    std::vector<FolderEntry> entries;
    bool isStale = true; ///< `entries` are to be read anew
};

/// Opens the browser for a line, such as "open" or "save-cage". `suggested` is a path whose folder and name are
/// offered. \throw InputError it takes no file
void open(FileBrowser& browser, const std::string& line, const std::filesystem::path& suggested);

} // namespace vdbcage::view
