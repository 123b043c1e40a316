#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace vdbcage::cli {

/// The group of options that only --help-all lists, for commands that have such.
constexpr const char* rareOptions = "Rare";

/// The description of a command's option.
struct OptionFacts {
    std::string letter; ///< "-o", or empty
    std::string name;   ///< "--output"
    std::string value;  ///< its value: "CAGE", "N", "auto|on|off"; empty for a flag
    std::string help;
    bool isRare = false; ///< only --help-all lists it
    bool isHelp = false; ///< asks for help; left out of help, except for a hint at --help-all
};

/// The description of a command, from which help, manual page and completion are made.
struct CommandFacts {
    std::string name;                 ///< "make"
    std::string usage;                ///< "vdbcage make MODEL... -o CAGE [OPTIONS]"
    std::string text;                 ///< its effect, in lines of a screen
    std::vector<OptionFacts> options; ///< in the order of the help
    std::string notes;                ///< more lines, after the options
};

/// A call of a command.
struct Call {
    std::vector<std::string> words; ///< its arguments, without its own name
    /// If set, it gets the command's description, and the command does nothing else.
    std::function<void(const CommandFacts&)> describe = {};
};

/// Reads the words of `call` into `app`, whose description is the usage, then a line end or ": ", then the command's
/// effect. Returns false if nothing else is to be done: the command was described, or help was asked for and printed.
/// \throw InputError
bool parse(CLI::App& app, Call call);

/// Returns the name, without dashes, and the value of each option that was given, in the order of `options`. An option
/// that was given several times has as many.
std::vector<std::pair<std::string, std::string>> valuesOf(const std::vector<CLI::Option*>& options);

/// Returns "; did you mean make?" if one of `known` is near to `word`, else "".
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

} // namespace vdbcage::cli
