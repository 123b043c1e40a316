#include <algorithm>
#include <iostream>
#include <map>

#include <tools/cli/memory_limit.h>
#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>

#include <tools/cli/arguments/cage_arguments.h>
#include <tools/cli/arguments/fit_arguments.h>
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

/// Requires a word that stays in its line. \throw InputError
void requireLine(const std::string& word)
{
    const auto isControl = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
    if (std::none_of(word.begin(), word.end(), isControl)) return;
    throw InputError("'" + word + "': a job is a line, and cannot have control characters");
}

/// Returns the options that were given, in words that each follow a space. \throw InputError
std::string wordsOf(const std::vector<CLI::Option*>& options)
{
    std::string words;
    for (const auto& [name, value] : valuesOf(options)) {
        requireLine(value);
        words += ' ' + shellWord("--" + name + '=' + value);
    }
    return words;
}

/// Returns the first that was given; null: none was.
const CLI::Option* givenOf(const std::vector<CLI::Option*>& options)
{
    const auto found =
        std::find_if(options.begin(), options.end(), [](const CLI::Option* o) { return o->count() > 0; });
    return found == options.end() ? nullptr : *found;
}

} // namespace

int runJobs(Call call)
{
    std::vector<fs::path> models;
    fs::path folder, cage;
    std::string program = "vdbcage", format = "obj", progress = "auto", memory = "auto";
    CageOptions options;
    FitArguments fitting;
    bool pictures = false;
    CLI::App app("vdbcage jobs [--fit CAGE] MODEL... -o DIR [OPTIONS of make or fit]\n"
                 "Prints a command for each model, one a line, for GNU parallel, Slurm and others.\n"
                 "Each makes DIR/MODEL.obj with a report, and does nothing where that was done.",
                 "jobs");
    app.add_option("models", models)->required()->type_name("MODEL...");
    app.add_option("-o,--output", folder, "for cages and reports, made if need be")->required()->type_name("DIR");
    const CLI::Option* const fit =
        app.add_option("--fit", cage, "fit it to each, by the options of fit")->type_name("CAGE");
    CLI::Option* const ofFormat = app.add_option("--format", format, "of cages [obj]");
    ofFormat->type_name(
        detail::joined(meshExtensions(), "|", [](const std::string& extension) { return extension.substr(1); }));
    CLI::Option* const ofPictures = app.add_flag("--pictures", pictures, "of each model with its cage, too");
    app.add_option("--command", program, "how farms call vdbcage [vdbcage]")->type_name("WORD");
    std::vector<CLI::Option*> ofMake = addCageOptions(app, options);
    ofMake.push_back(addMemoryOption(app, memory));
    const std::vector<CLI::Option*> ofFit = addFitOptions(app, fitting);
    for (CLI::Option* option : ofFit) option->group(rareOptions);
    CLI::Option* const ofProgress =
        app.add_option("--progress", progress, "of each job: auto, or lines for farms [auto]")->type_name("auto|lines");
    app.set_help_all_flag("--help-all", "print this and the rarer options");
    call.words = withPlaceValue(std::move(call.words));
    if (!parse(app, std::move(call))) return exitGood;

    const bool fits = fit->count() > 0;
    const std::string given = wordsOf(fits ? ofFit : ofMake) + wordsOf({ofProgress, app.get_option("--threads")});
    if (fits) {
        ofMake.insert(ofMake.end(), {ofFormat, ofPictures});
        if (const CLI::Option* option = givenOf(ofMake)) {
            throw InputError(option->get_name(), "it does not go with --fit; the options of vdbcage fit do");
        }
        detail::requireMeshExtension(cage);
        requireValid(fitting);
    } else {
        if (const CLI::Option* option = givenOf(ofFit)) throw InputError(option->get_name(), "it needs --fit CAGE");
        setPrecisionFor("cage." + format, options);
        requireValid(options);
        memoryLimit(memory);
    }
    requireProgress(progress);
    for (const std::string& word : {folder.string(), cage.string(), program}) requireLine(word);
    const std::string extension = fits ? cage.extension().string() : '.' + format;
    const std::string start = shellWord(program) + (fits ? " fit " + shellWord(asFile(cage)) : " make") + ' ';
    std::string text;
    std::map<std::string, fs::path> modelOf;
    for (const fs::path& model : models) {
        requireLine(model.string());
        const std::string name = model.stem().string();
        const auto output = [&](const std::string& ending) { return folder / (name + ending); };
        const auto [first, isNew] = modelOf.try_emplace(name, model);
        if (!isNew) {
            throw InputError(model.string(), "another model has this name too, and the cages of both would be " +
                                                 output(extension).string() + ": " + first->second.string());
        }
        for (const fs::path& input : {model, cage}) {
            std::error_code ignored;
            if (!fs::equivalent(output(extension), input, ignored)) continue;
            throw InputError(input.string(), "the cage of " + name + " would replace it; choose another folder");
        }
        const auto writes = [&](const char* option, const std::string& ending) {
            return std::string(" ") + option + ' ' + shellWord(asFile(output(ending)));
        };
        text += start + shellWord(asFile(model)) + writes("-o", extension) + writes("--report", ".json") +
                (pictures ? writes("--picture", ".png") : "") + " --skip-done" + given + '\n';
    }
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem) detail::throwIoError(folder.string() + ": the folder cannot be made", problem.value());
    std::cout << text;
    return exitGood;
}

} // namespace vdbcage::cli
