// The program `vdbcage-view`.

#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>

#include <CLI/CLI.hpp>

#include <tools/manual/manual_page.h>
#include <tools/view/files/folder.h>
#include <tools/view/files/preferences.h>
#include <tools/view/input/verbs.h>
#include <tools/view/script.h>
#include <tools/view/state/command.h>
#include <tools/view/state/words.h>
#include <tools/view/window.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>
#include <vdbcage/gl/offscreen.h>

namespace vdbcage::view {

namespace {

namespace fs = std::filesystem;

struct Arguments {
    std::vector<std::string> files;
    fs::path script, recording;
    std::string context;
};

using Rows = std::vector<std::pair<std::string, std::string>>; // (syntax or key, effect)

struct Section {
    std::string title;
    Rows rows;
};

constexpr const char* usage = "vdbcage-view [MODEL|SCENE.json] [CAGE] [POSED] [OPTIONS]";
constexpr const char* summary = "a window in which a cage is made, and the model is posed by it";

Rows describeOptions()
{
    return {{"--script FILE", "does the lines of FILE; without a display too"},
            {"--record FILE", "writes what the user does as such a script"},
            {"--without-window any|egl|osmesa", "for scripts: draws, but opens no window"},
            {"--help", "prints all of this"},
            {"--man", "prints it as a manual page, for the program man"},
            {"--version", "prints the version"}};
}

Rows describeKeys(KeyMap map)
{
    Rows rows = describeMouse(map);
    for (const Shortcut& shortcut : shortcuts(map)) rows.emplace_back(shortcut.chord, shortcut.help);
    return rows;
}

std::vector<Section> describeAll()
{
    return {{"Options", describeOptions()},
            {"Lines of a script: commands", describeCommands()},
            {"Lines of a script: what menus and keys do", describeVerbs()},
            {"Lines of a script: what hands and eyes do", describeScript()},
            {"Mouse and keys as in Blender (keys blender), which scripts begin with", describeKeys(KeyMap::blender)},
            {"Mouse and keys as in Maya (keys maya)", describeKeys(KeyMap::maya)}};
}

void printHelp()
{
    std::cout << usage << ":\n" << summary << '\n';
    constexpr std::size_t column = 36;
    for (const Section& section : describeAll()) {
        std::cout << '\n' << section.title << ":\n";
        for (const auto& [left, help] : section.rows) {
            // A text too long for its column gets a line of its own.
            const bool fits = left.size() < column;
            std::cout << "  " << left
                      << (fits ? std::string(column - left.size(), ' ') : '\n' + std::string(column + 2, ' ')) << help
                      << '\n';
        }
    }
}

void printManual()
{
    manual::ManualPage page("vdbcage-view", summary);
    page.section("SYNOPSIS");
    page.code(usage);
    page.section("DESCRIPTION");
    page.paragraph(
        "Opens the model, its cage and its posed cage, or a scene that was saved. While an option is dragged, "
        "previews of the cage follow; when it is let go, the cage is made and certified.");
    for (const Section& section : describeAll()) {
        std::string title = section.title;
        for (char& c : title) {
            if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
        }
        page.section(title);
        for (const auto& [left, help] : section.rows) page.item(left, "", help);
    }
    page.section("SEE ALSO");
    page.paragraph(
        "vdbcage(1), and docs/WINDOW.md in PREFIX/share/doc/vdbcage; Debian's packages have /usr as PREFIX.");
    std::cout << page.text();
}

Arguments parse(int count, char** words)
{
    Arguments arguments;
    CLI::App app("", "vdbcage-view");
    app.set_help_flag();
    app.add_option("files", arguments.files)->expected(0, 3);
    app.add_option("--script", arguments.script);
    app.add_option("--record", arguments.recording);
    app.add_option("--without-window", arguments.context)->check(CLI::IsMember({"any", "egl", "osmesa"}));
    app.parse(count, words);
    return arguments;
}

void openFiles(App& app, const Arguments& arguments)
{
    if (arguments.files.empty()) return;
    const std::string& first = arguments.files[0];
    app.perform(fs::path(first).extension() == ".json" ? Action(OpenScene{first}) : OpenModel{first});
    if (arguments.files.size() > 1) app.perform(OpenCage{arguments.files[1]});
    if (arguments.files.size() > 2) {
        app.perform(SetMode{Mode::pose});
        app.perform(OpenPose{arguments.files[2]});
    }
}

/// Opens the files, runs the script and, with a window, follows the user.
void run(const gl::Api& api, AppSetup setup, const Arguments& arguments, Window* window)
{
    std::string recorded = "# recorded by vdbcage-view " VDBCAGE_VERSION "\n";
    for (std::size_t i = 0; i < arguments.files.size(); ++i) {
        static constexpr std::array<const char*, 3> verbs{"open ", "open-cage ", "mode pose\nopen-pose "};
        recorded += verbs[i] + quotedWord(fs::absolute(arguments.files[i]).string()) + '\n';
    }
    if (!arguments.recording.empty()) {
        requireWritable(arguments.recording);
        setup.record = [&](const std::string& line) { recorded += line + '\n'; };
    }
    App app(api, std::move(setup));
    openFiles(app, arguments);
    if (!arguments.script.empty()) {
        runScript(app, arguments.script);
        if (window) window->show(app);
    } else {
        window->run(app);
    }
    if (!arguments.recording.empty()) {
        writeFileAtomically(arguments.recording, [&](std::ostream& out) { out << recorded; });
    }
}

void runWithoutWindow(const Arguments& arguments)
{
    using Source = gl::OffscreenContext::Source;
    const Source source = arguments.context == "egl"      ? Source::egl
                          : arguments.context == "osmesa" ? Source::osmesa
                                                          : Source::any;
    const gl::OffscreenContext context(gl::OffscreenContext::Debug::off, source);
    const auto current = context.makeCurrent();
    AppSetup setup;
    setup.isSoftware = context.isSoftware();
    run(context.api(), std::move(setup), arguments, nullptr);
}

bool hasDisplay()
{
    const char* const display = std::getenv("DISPLAY");
    return display && *display;
}

int runProgram(int count, char** words)
{
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        if (word == "--help" || word == "-h") return printHelp(), EXIT_SUCCESS;
        if (word == "--man") return printManual(), EXIT_SUCCESS;
        if (word == "--version") return std::cout << "vdbcage-view " VDBCAGE_VERSION "\n", EXIT_SUCCESS;
    }
    const Arguments arguments = parse(count, words);
    if (!arguments.context.empty() && arguments.script.empty()) {
        throw InputError("--without-window", "it needs a --script to do");
    }
    if (!arguments.context.empty() || (!arguments.script.empty() && !hasDisplay())) {
        runWithoutWindow(arguments);
        return EXIT_SUCCESS;
    }
    Window window(1280, 800);
    AppSetup setup = window.setup();
    // Scripts must not depend on a user's recent files and preferences, nor change them.
    if (arguments.script.empty()) {
        setup.recentFiles = recentFilesPath();
        setup.preferences = preferencesPath();
    }
    run(window.api(), std::move(setup), arguments, &window);
    return EXIT_SUCCESS;
}

} // namespace

} // namespace vdbcage::view

int main(int count, char** words)
{
    try {
        return vdbcage::view::runProgram(count, words);
    } catch (const CLI::ParseError& error) {
        std::cerr << "vdbcage-view: error: " << vdbcage::detail::printable(error.what()) << '\n';
    } catch (const std::exception& error) {
        std::cerr << "vdbcage-view: error: " << vdbcage::detail::printable(error.what()) << '\n';
    }
    return EXIT_FAILURE;
}
