#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tools/view/app.h>

namespace vdbcage::view {

/// Does the lines of a script, one after the other: those of App, and those of describeScript(), which do what hands
/// and eyes do. Files are counted from the current folder. Stops when the App has ended. \throw InputError "FILE:LINE:
/// " and what is wrong, or not as it is expected; IoError
void runScript(App& app, const std::filesystem::path& path);

/// One line. \throw Error
void runLine(App& app, const std::string& line);

/// Lines that only scripts have: (usage, help).
std::vector<std::pair<std::string, std::string>> describeScript();

} // namespace vdbcage::view
