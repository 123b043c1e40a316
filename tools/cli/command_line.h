#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace vdbcage::cli {

/// The group of options that only --help-all lists, where a command has it.
constexpr const char* rareOptions = "Rare";

/// One option of a command, in words.
struct OptionFacts {
    std::string letter; ///< "-o", or empty
    std::string name;   ///< "--output"
    std::string value;  ///< what it takes: "CAGE", "N", "auto|on|off"; empty for a flag
    std::string help;
    bool isRare = false; ///< only --help-all lists it
    bool isHelp = false; ///< asks for help, which who reads help has found
};

/// What can be said to a command, in words: help, manual page and completion are made of it.
struct CommandFacts {
    std::string name;                 ///< "make"
    std::string usage;                ///< "vdbcage make MODEL... -o CAGE [OPTIONS]"
    std::string text;                 ///< what it does, in lines of a screen
    std::vector<OptionFacts> options; ///< in the order of the help
    std::string notes;                ///< more lines, after the options
};

/// What is asked of a command.
struct Call {
    std::vector<std::string> words; ///< its arguments, without its own name
    /// If set, it is told of the command, which does nothing else then.
    std::function<void(const CommandFacts&)> describe = {};
};

/// Reads the words of `call` into `app`, whose description is the usage, then a line end or ": ", then what the command
/// does. Returns false if nothing else is to be done: the command was described, or help was asked for and printed.
/// \throw InputError
bool parse(CLI::App& app, Call call);

/// "; did you mean make?" where one of `known` is near to `word`, else "".
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

} // namespace vdbcage::cli
