#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/core/detail/printable.h>

#include <tools/cli/command_line.h>
#include <tools/cli/exit_status.h>

namespace vdbcage::cli {

/// Makes a name or a driver's text printable on a terminal.
inline std::string printable(const std::filesystem::path& text)
{
    return detail::printable(text.string());
}

/// Run a command and return the exit status. \throw Error
int runMake(Call call);
int runCheck(Call call);
int runRender(Call call);
int runBind(Call call);
int runDeform(Call call);
int runFit(Call call);
int runRepair(Call call);
int runJobs(Call call);
int runReport(Call call);
int runMan(Call call);
int runCompletion(Call call);

/// A command line to try, and its purpose.
struct Example {
    std::string purpose; ///< a sentence
    std::string line;
};

/// A command of `vdbcage`.
struct Command {
    std::string name, summary;
    int (*run)(Call);
    std::string details; ///< additions of its manual page to the help; may be empty
    /// For its manual page. A test runs all in order in a folder that has bishop.obj, creature.obj (of data/) and
    /// posed.obj, the posed cage.
    std::vector<Example> examples;
};

/// Returns all commands, in the order of the help.
const std::vector<Command>& commands();

std::vector<std::string> commandNames();

/// Returns the command of this name. \throw InputError there is none; with a hint
const Command& commandNamed(const std::string& name);

/// Returns the description of `command`.
CommandFacts describe(const Command& command);

} // namespace vdbcage::cli
