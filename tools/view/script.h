#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tools/view/app.h>

namespace vdbcage::view {

/// Runs the lines of a script in order: those of App, and those of describeScript(), which stand for the user's hands
/// and eyes. Paths are relative to the current folder. Stops when the App has ended. \throw InputError "FILE:LINE: "
/// and the error or the failed expectation; IoError
void runScript(App& app, const std::filesystem::path& path);

/// Runs one line. \throw Error
void runLine(App& app, const std::string& line);

/// Returns (usage, help) of each line that only scripts have.
std::vector<std::pair<std::string, std::string>> describeScript();

} // namespace vdbcage::view
