#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <tools/view/files/folder.h>
#include <tools/view/input/verbs.h>

namespace vdbcage::view {

/// A line that takes a file, and the question for the file.
struct FileLine {
    std::string name;
    Action (*of)(const std::string& path);
    const char* title;
    std::vector<std::string> extensions; ///< empty: folders are chosen
    const char* ending = nullptr;        ///< of the suggested name, after the model's; null: files are opened
    bool isSequence = false;
};

/// The state of the file browser.
struct FileBrowser {
    bool isOpen = false;
    const FileLine* line = nullptr; ///< the line that gets the file; null: it was never open
    std::filesystem::path folder;
    std::string name;     ///< the typed name or path
    std::string filter;   ///< part of the listed names
    std::string question; ///< to be answered first: the file is there already
    std::string problem;
    std::vector<FolderEntry> entries;
    bool isStale = true; ///< `entries` must be read again
};

/// Opens the browser for a line, such as "open" or "save-cage". `suggested` is a path whose folder and name are
/// offered. \throw InputError it takes no file
void open(FileBrowser& browser, const std::string& line, const std::filesystem::path& suggested);

} // namespace vdbcage::view
