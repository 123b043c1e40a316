#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace vdbcage::tool {

/// One command of `vdbcage`: its arguments without its own name; returns the exit status. \throw Error, CLI::Error
int runMake(std::vector<std::string> arguments);
int runCheck(std::vector<std::string> arguments);
int runRender(std::vector<std::string> arguments);
int runBind(std::vector<std::string> arguments);
int runDeform(std::vector<std::string> arguments);
int runRepair(std::vector<std::string> arguments);

/// Reads `arguments` into `app`, whose help is laid out one option a line. Returns false if help was asked for (and
/// printed). \throw CLI::ParseError
bool parse(CLI::App& app, std::vector<std::string> arguments);

/// Exit statuses.
constexpr int exitGood = 0, exitError = 1, exitNotBounding = 2, exitCancelled = 130;

} // namespace vdbcage::tool
