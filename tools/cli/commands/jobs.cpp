#include <algorithm>
#include <iostream>
#include <map>

#include <tools/cli/memory_limit.h>
#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>

#include <tools/cli/arguments/cage_arguments.h>
#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>

namespace vdbcage::cli {

namespace {

namespace fs = std::filesystem;

/// Returns `word` quoted for a POSIX shell if need be.
std::string shellWord(const std::string& word)
{
    constexpr const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

/// Returns a name that cannot be taken for an option.
std::string asFile(const fs::path& path)
{
    const std::string name = path.string();
    return name.rfind('-', 0) == 0 ? "./" + name : name;
}

} // namespace

int runJobs(Call call)
{
    std::vector<fs::path> models;
    fs::path folder;
    std::string program = "vdbcage", format = "obj", progress = "auto", memory = "auto";
    CageOptions options;
    bool pictures = false;
    CLI::App app("vdbcage jobs MODEL... -o DIR [OPTIONS of make]\n"
                 "Prints a command for each model, one a line: for GNU parallel, Slurm arrays and\n"
                 "other farms. Each makes DIR/MODEL.obj with a report, and does nothing where that\n"
                 "was done before. DIR is made if it is not there.",
                 "jobs");
    app.add_option("models", models)->required()->type_name("MODEL...");
    app.add_option("-o,--output", folder, "where cages and reports go")->required()->type_name("DIR");
    app.add_option("--format", format, "of cages [obj]")
        ->type_name(
            detail::joined(meshExtensions(), "|", [](const std::string& extension) { return extension.substr(1); }));
    app.add_flag("--pictures", pictures, "of each model with its cage, too");
    app.add_option("--command", program, "how farms call vdbcage [vdbcage]")->type_name("WORD");
    std::vector<CLI::Option*> ofMake = addCageOptions(app, options);
    ofMake.push_back(addMemoryOption(app, memory));
    ofMake.push_back(app.add_option("--progress", progress, "of each job: auto, or lines for farms [auto]")
                         ->type_name("auto|lines"));
    app.set_help_all_flag("--help-all", "print this and the rarer options");
    if (!parse(app, std::move(call))) return exitGood;
    setPrecisionFor("cage." + format, options);
    requireValid(options);
    requireProgress(progress);
    memoryLimit(memory);

    ofMake.push_back(app.get_option("--threads"));
    std::string given;
    for (const CLI::Option* option : ofMake) {
        for (const std::string& value : option->results()) {
            given += ' ' + shellWord("--" + option->get_lnames().front() + '=' + value);
        }
    }
    const auto requireLine = [](const std::string& word) {
        const auto isControl = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
        if (std::none_of(word.begin(), word.end(), isControl)) return;
        throw InputError("'" + word + "': a job is a line, and cannot have control characters");
    };
    requireLine(folder.string());
    requireLine(program);
    std::string text;
    std::map<std::string, fs::path> modelOf;
    for (const fs::path& model : models) {
        requireLine(model.string());
        const std::string name = model.stem().string();
        const auto [first, isNew] = modelOf.try_emplace(name, model);
        if (!isNew) {
            throw InputError(model.string(), "another model has this name too, and the cages of both would be " +
                                                 (folder / name).string() + '.' + format + ": " +
                                                 first->second.string());
        }
        std::error_code ignored;
        if (fs::equivalent(folder / (name + '.' + format), model, ignored)) {
            throw InputError(model.string(), "its cage would replace it; choose another folder");
        }
        const auto output = [&](const char* option, const std::string& extension) {
            return std::string(" ") + option + ' ' + shellWord(asFile(folder / (name + extension)));
        };
        text += shellWord(program) + " make " + shellWord(asFile(model)) + output("-o", '.' + format) +
                output("--report", ".json") + (pictures ? output("--picture", ".png") : "") + " --skip-done" + given +
                '\n';
    }
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) detail::throwIoError(folder.string() + ": the folder cannot be made", problem.value());
    std::cout << text;
    return exitGood;
}

} // namespace vdbcage::cli
