#pragma once

#include <string>
#include <vector>

#include <tools/report/report.h>

namespace vdbcage::report {

/// Returns the beginning of every report: its format and kind, the program, its arguments and the machine. `arguments`
/// are the command's words without its name; empty if it was no command.
Json runFacts(const std::string& kind, const std::vector<std::string>& arguments);

/// Returns SHA-256 in 64 hexadecimal digits, as the program sha256sum prints it.
std::string sha256Of(const std::string& bytes);

} // namespace vdbcage::report
