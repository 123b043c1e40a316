#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <vdbcage/core/detail/printable.h>
#include <vdbcage/pipeline/options.h>

#include "exit_status.h"

namespace vdbcage::tool {

/// A name or a driver's words for the terminal.
inline std::string printable(const std::filesystem::path& text)
{
    return detail::printable(text.string());
}

/// Sends what was printed on standard output on its way. \throw IoError if it does not arrive
void flushOutput();

/// One command of `vdbcage`: its arguments without its own name; returns the exit status. \throw Error, CLI::Error
int runMake(std::vector<std::string> arguments);
int runCheck(std::vector<std::string> arguments);
int runRender(std::vector<std::string> arguments);
int runBind(std::vector<std::string> arguments);
int runDeform(std::vector<std::string> arguments);
int runRepair(std::vector<std::string> arguments);
int runJobs(std::vector<std::string> arguments);
int runReport(std::vector<std::string> arguments);

/// The group of options that only --help-all lists, where a command has it.
constexpr const char* rareOptions = "Rare";

/// Adds the options of cages, which set `options`, and returns them. Must outlive parsing.
std::vector<CLI::Option*> addCageOptions(CLI::App& app, CageOptions& options);

/// Reads `arguments` into `app`, whose help is laid out one option a line. Returns false if help was asked for (and
/// printed). \throw CLI::ParseError
bool parse(CLI::App& app, std::vector<std::string> arguments);

} // namespace vdbcage::tool
