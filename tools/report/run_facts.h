#pragma once

#include <string>
#include <vector>

#include <tools/report/report.h>

namespace vdbcage::report {

/// What every report begins with: its form, what made it, where. `arguments` are the command's words without its name;
/// empty if it was no command.
Json runFacts(const std::string& kind, const std::vector<std::string>& arguments);

/// SHA-256 in 64 hexadecimal digits, as the program sha256sum prints it.
std::string sha256Of(const std::string& bytes);

} // namespace vdbcage::report
