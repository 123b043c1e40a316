#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/core/detail/printable.h>
#include <vdbcage/pipeline/options.h>

#include <tools/cli/command_line.h>
#include <tools/cli/exit_status.h>

namespace vdbcage::cli {

/// A name or a driver's words for the terminal.
inline std::string printable(const std::filesystem::path& text)
{
    return detail::printable(text.string());
}

/// Sends what was printed on standard output on its way. \throw IoError if it does not arrive
void flushOutput();

/// Each does what it is called for and returns the exit status. \throw Error
int runMake(Call call);
int runCheck(Call call);
int runRender(Call call);
int runBind(Call call);
int runDeform(Call call);
int runRepair(Call call);
int runJobs(Call call);
int runReport(Call call);
int runMan(Call call);
int runCompletion(Call call);

/// A command line that can be tried, and what it is for.
struct Example {
    std::string purpose; ///< a sentence
    std::string line;
};

/// One command of `vdbcage`.
struct Command {
    std::string name, summary;
    int (*run)(Call);
    std::string details; ///< what its manual page has beyond the help; may be empty
    /// For its manual page. One after the other they run in a folder that has bishop.obj, creature.obj (of data/) and
    /// posed.obj, the cage as posed: a test does it.
    std::vector<Example> examples;
};

/// All of them, in the order of the help.
const std::vector<Command>& commands();

std::vector<std::string> commandNames();

/// \throw InputError there is none of this name; with a hint
const Command& commandNamed(const std::string& name);

/// What can be said to `command`.
CommandFacts describe(const Command& command);

/// Adds the options of cages, which set `options`, and returns them. Must outlive parsing.
std::vector<CLI::Option*> addCageOptions(CLI::App& app, CageOptions& options);

/// Makes the options of a cage those for a file that it is written to, which is then certified as it is.
/// \throw InputError the file cannot hold the precision that is asked for; IoError unknown extension
void setPrecisionFor(const std::filesystem::path& cage, CageOptions& options);

/// Adds --memory, for memoryLimit(). Must outlive parsing.
CLI::Option* addMemoryOption(CLI::App& app, std::string& text);

} // namespace vdbcage::cli
