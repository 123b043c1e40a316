#include <algorithm>
#include <iostream>

#include <tools/manual/manual_page.h>

#include <tools/cli/commands.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/mesh/mesh_io.h>

namespace vdbcage::cli {

namespace {

/// Returns the text with a capital first, and a full stop.
std::string sentence(std::string text)
{
    if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') text[0] = static_cast<char>(text[0] - 'a' + 'A');
    return text + '.';
}

void addOptions(manual::ManualPage& page, const CommandFacts& facts, bool rareOnes)
{
    for (const OptionFacts& option : facts.options) {
        if (option.isRare != rareOnes) continue;
        page.item(option.letter.empty() ? option.name : option.letter + ", " + option.name, option.value,
                  sentence(option.help));
    }
}

constexpr const char* statusTwo = "Exit status 2: ";

/// Returns the meaning of status 2 if the text of a command has it; else empty.
std::string meaningOfTwo(const CommandFacts& facts)
{
    const std::size_t at = facts.text.find(statusTwo);
    return at == std::string::npos ? "" : facts.text.substr(at + std::string(statusTwo).size());
}

/// Adds the exit statuses of these commands.
void addExitStatus(manual::ManualPage& page, const std::vector<Command>& some)
{
    page.section("EXIT STATUS");
    page.item("0", "", "All went well.");
    page.item("1", "",
              "The input, an option or a file is bad. A line on standard error names it, and the allowed values.");
    for (const Command& command : some) {
        const std::string meaning = meaningOfTwo(describe(command));
        if (!meaning.empty()) page.item("2", "", "Of " + command.name + ": " + meaning);
    }
    page.item("75", "", "Memory, room on the disk, threads or OpenGL are missing: another try may do.");
    page.item("130, 143", "",
              "It was ended, by SIGINT (Ctrl+C) or SIGHUP, or by SIGTERM. Nothing half-written is left.");
}

/// Returns vdbcage(1).
std::string mainPage()
{
    manual::ManualPage page("vdbcage", "coarse, tight, strictly bounding cages for any model");
    page.section("SYNOPSIS");
    page.code("vdbcage COMMAND ARGUMENTS\nvdbcage COMMAND --help");
    page.section("DESCRIPTION");
    page.paragraph("A cage is a coarse closed mesh around a detailed model; moving the cage deforms the model. "
                   "vdbcage makes cages, proves that they bound their models, and moves models by them. "
                   "Meshes are files of these kinds: " +
                   detail::joined(meshExtensions(), " ") + ". Lengths are fractions of the model's longest side.");
    page.section("COMMANDS");
    for (const Command& command : commands())
        page.item("vdbcage-" + command.name + "(1)", "", sentence(command.summary));
    addExitStatus(page, commands());
    page.section("EXAMPLES");
    page.paragraph("A cage, and the model as the moved cage moves it:");
    page.code("vdbcage make bishop.obj -o cage.obj\nvdbcage deform cage.obj posed.obj bishop.obj -o moved.obj");
    page.section("SEE ALSO");
    page.paragraph("vdbcage-view(1), the window. README.md and docs/GUIDE.md in PREFIX/share/doc/vdbcage; Debian's "
                   "packages have /usr as PREFIX.");
    return page.text();
}

/// Returns vdbcage-COMMAND(1).
std::string pageOf(const Command& command)
{
    const CommandFacts facts = describe(command);
    manual::ManualPage page("vdbcage-" + command.name, command.summary);
    page.section("SYNOPSIS");
    page.code(facts.usage);
    page.section("DESCRIPTION");
    page.paragraph(facts.text.substr(0, facts.text.find(statusTwo))); // the status has its own section
    if (!command.details.empty()) page.paragraph(command.details);
    page.section("OPTIONS");
    page.paragraph("What holds without an option is in brackets.");
    addOptions(page, facts, false);
    if (std::any_of(facts.options.begin(), facts.options.end(), [](const OptionFacts& o) { return o.isRare; })) {
        page.section("RARER OPTIONS");
        addOptions(page, facts, true);
    }
    if (!facts.notes.empty()) {
        page.section("NOTES");
        page.paragraph(facts.notes);
    }
    addExitStatus(page, {command});
    page.section("EXAMPLES");
    for (const Example& example : command.examples) {
        page.paragraph(example.purpose);
        page.code(example.line);
    }
    page.section("SEE ALSO");
    page.paragraph("vdbcage(1)");
    return page.text();
}

} // namespace

int runMan(Call call)
{
    std::string name;
    CLI::App app("vdbcage man [COMMAND]\n"
                 "Prints the manual page of a command, or that of vdbcage, for the program man.",
                 "man");
    app.add_option("command", name)->type_name("COMMAND");
    if (!parse(app, std::move(call))) return exitGood;
    std::cout << (name.empty() ? mainPage() : pageOf(commandNamed(name)));
    return exitGood;
}

} // namespace vdbcage::cli
