// How each shell takes completions: bash(1), "Programmable Completion"; zshcompsys(1), _arguments; fish, complete(1).

#include <iostream>
#include <sstream>

#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>

#include <tools/cli/commands.h>

namespace vdbcage::cli {

namespace {

/// What can stand in a place of the command line.
struct Values {
    std::vector<std::string> words;
    bool files = false, folders = false;
};

struct Completed {
    std::string name, summary;
    std::vector<OptionFacts> options;
    Values arguments; ///< what stands where no option does
};

/// By the option's type: "auto|N" has the word auto; what is in capitals is a file, a folder or a number.
Values valuesOf(const OptionFacts& option)
{
    Values values;
    std::istringstream parts(option.value);
    for (std::string part; std::getline(parts, part, '|');) {
        const std::string kind = part.substr(0, part.find('.'));
        if (kind == "FAMILY") {
            for (const FamilyInfo& family : coordinateFamilies()) values.words.push_back(family.name);
        } else if (kind == "DIR") {
            values.folders = true;
        } else if (kind == "FILE" || kind == "CAGE" || kind == "OUT" || kind == "PICTURE" || kind == "WEIGHTS") {
            values.files = true;
        } else if (part[0] >= 'a' && part[0] <= 'z') {
            values.words.push_back(part);
        }
    }
    return values;
}

std::vector<Completed> allCompleted()
{
    std::vector<Completed> all;
    for (const Command& command : commands()) {
        Completed& added = all.emplace_back(Completed{command.name, command.summary, describe(command).options, {}});
        if (command.name == "man") {
            added.arguments.words = commandNames();
        } else if (command.name == "completion") {
            added.arguments.words = {"bash", "fish", "zsh"};
        } else {
            added.arguments.files = true;
        }
    }
    all.push_back({"help", "print what a command takes", {}, {commandNames()}});
    return all;
}

std::string joined(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// With `escape` before each of `marks`.
std::string escaped(const std::string& text, const std::string& marks, const std::string& escape)
{
    std::string result;
    for (const char c : text) {
        if (marks.find(c) != std::string::npos) result += escape;
        result += c;
    }
    return result;
}

/// As a word of bash and zsh.
std::string quoted(const std::string& text)
{
    return '\'' + escaped(text, "'", "'\\'") + '\'';
}

/// As a word of fish.
std::string fishQuoted(const std::string& text)
{
    return '\'' + escaped(text, "'\\", "\\") + '\'';
}

std::string bashOffers(const Values& values)
{
    std::string text;
    if (!values.words.empty()) text += "_vdbcage_offer -W " + quoted(joined(values.words)) + "; ";
    if (values.folders) text += "_vdbcage_offer -d; ";
    if (values.files) text += "_vdbcage_offer -f; ";
    return text;
}

/// A function that looks at the word before the cursor's. Bash takes --mesh=quads for three words.
void writeBash(std::ostream& out)
{
    const std::vector<Completed> all = allCompleted();
    std::string names = "--help --version";
    for (const Completed& command : all) names += ' ' + command.name;
    out << "# source <(vdbcage completion bash)\n"
           "_vdbcage_offer()\n"
           "{\n"
           "    [[ $1 == -W ]] || compopt -o filenames 2>/dev/null\n"
           "    mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen \"$@\" -- \"$word\")\n"
           "}\n"
           "_vdbcage()\n"
           "{\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} option=${COMP_WORDS[COMP_CWORD - 1]}\n"
           "    if [[ $word == '=' ]]; then\n"
           "        word=\n"
           "    elif [[ $option == '=' ]]; then\n"
           "        option=${COMP_WORDS[COMP_CWORD - 2]}\n"
           "    fi\n"
           "    COMPREPLY=()\n"
           "    if ((COMP_CWORD == 1)); then\n"
           "        _vdbcage_offer -W "
        << quoted(names)
        << "\n"
           "        return\n"
           "    fi\n"
           "    case ${COMP_WORDS[1]} in\n";
    for (const Completed& command : all) {
        out << "    " << command.name << ")\n        case $option in\n";
        std::vector<std::string> flags;
        for (const OptionFacts& option : command.options) {
            flags.push_back(option.name);
            if (option.value.empty()) continue;
            out << "        " << (option.letter.empty() ? "" : option.letter + " | ") << option.name << ") "
                << bashOffers(valuesOf(option)) << "return ;;\n";
        }
        out << "        esac\n"
               "        if [[ $word == -* ]]; then _vdbcage_offer -W "
            << quoted(joined(flags)) << "; else " << bashOffers(command.arguments) << "fi\n        ;;\n";
    }
    out << "    esac\n"
           "}\n"
           "complete -F _vdbcage vdbcage\n";
}

/// The action of a specification of _arguments.
std::string zshAction(const Values& values)
{
    std::string text;
    if (!values.words.empty()) text += "compadd -- " + joined(values.words) + "; ";
    if (values.folders) text += "_files -/; ";
    if (values.files) text += "_files; ";
    return text.empty() ? " " : '{' + text + '}';
}

/// A function of _arguments, which serves as an autoloaded file of the folder in fpath too.
void writeZsh(std::ostream& out)
{
    const std::vector<Completed> all = allCompleted();
    out << "#compdef vdbcage\n"
           "# source <(vdbcage completion zsh), after compinit\n"
           "_vdbcage() {\n"
           "    if (( CURRENT == 2 )); then\n"
           "        local -a names=(";
    for (const Completed& command : all) out << "\n            " << quoted(command.name + ':' + command.summary);
    out << ")\n"
           "        _describe command names\n"
           "        return\n"
           "    fi\n"
           "    local name=$words[2]\n"
           "    shift words\n"
           "    (( CURRENT-- ))\n"
           "    case $name in\n";
    for (const Completed& command : all) {
        out << "    (" << command.name << ") _arguments";
        for (const OptionFacts& option : command.options) {
            std::string rest = '[' + escaped(option.help, "[]:\\", "\\") + ']';
            if (!option.value.empty()) rest += ':' + option.value + ':' + zshAction(valuesOf(option));
            if (!option.letter.empty()) out << " \\\n        " << quoted(option.letter + rest);
            out << " \\\n        " << quoted(option.name + (option.value.empty() ? "" : "=") + rest);
        }
        out << " \\\n        " << quoted("*: :" + zshAction(command.arguments)) << " ;;\n";
    }
    out << "    esac\n"
           "}\n"
           "if [[ $funcstack[1] == _vdbcage ]]; then\n"
           "    _vdbcage \"$@\"\n"
           "else\n"
           "    compdef _vdbcage vdbcage\n"
           "fi\n";
}

/// What the options -a, -F and -f of fish's `complete` are.
std::string fishOffers(const Values& values)
{
    std::string words = joined(values.words);
    if (values.folders) words += "(__fish_complete_directories)";
    return (values.files ? " -F" : " -f") + (words.empty() ? "" : " -a " + fishQuoted(words));
}

void writeFish(std::ostream& out)
{
    out << "# vdbcage completion fish > ~/.config/fish/completions/vdbcage.fish\n"
           "function __vdbcage_command\n"
           "    set -l words (commandline -opc)\n"
           "    test (count $words) -gt 1; and test $words[2] = $argv[1]\n"
           "end\n"
           "complete -c vdbcage -f\n";
    for (const Completed& command : allCompleted()) {
        out << "complete -c vdbcage -n __fish_use_subcommand -a " << command.name << " -d "
            << fishQuoted(command.summary) << '\n';
        const std::string begin = "complete -c vdbcage -n '__vdbcage_command " + command.name + "'";
        out << begin << fishOffers(command.arguments) << '\n';
        for (const OptionFacts& option : command.options) {
            out << begin << " -l " << option.name.substr(2);
            if (!option.letter.empty()) out << " -s " << option.letter.substr(1);
            if (!option.value.empty()) out << " -r" << fishOffers(valuesOf(option));
            out << " -d " << fishQuoted(option.help) << '\n';
        }
    }
}

} // namespace

int runCompletion(Call call)
{
    std::string shell;
    CLI::App app("vdbcage completion bash|fish|zsh\n"
                 "Prints what lets a shell complete the commands, options and files of vdbcage.",
                 "completion");
    app.add_option("shell", shell)->required()->type_name("SHELL");
    if (!parse(app, std::move(call))) return exitGood;
    if (shell == "bash") {
        writeBash(std::cout);
    } else if (shell == "fish") {
        writeFish(std::cout);
    } else if (shell == "zsh") {
        writeZsh(std::cout);
    } else {
        throw InputError("shell: '" + shell + "' is neither bash nor fish nor zsh");
    }
    return exitGood;
}

} // namespace vdbcage::cli
