// The command `vdbcage`: words to standard error, data to files and standard output.

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include <vdbcage/core/detail/io_failure.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>
#include <vdbcage/core/version.h>

#include "commands.h"
#include "interrupt.h"
#include "outputs.h"
#include "threads.h"

namespace vdbcage::tool {

namespace {

struct Command {
    const char* name;
    const char* help;
    int (*run)(std::vector<std::string>);
};

constexpr Command commands[] = {
    {"make", "make a cage for a model", runMake},
    {"check", "examine a cage against its model", runCheck},
    {"render", "draw models, cages and volumes into a picture", runRender},
    {"bind", "compute how a cage moves a model", runBind},
    {"deform", "move a model by its posed cage", runDeform},
    {"repair", "mend a cage that was made elsewhere", runRepair},
    {"jobs", "print a command for each of many models, for farms", runJobs},
    {"report", "tell what became of many jobs", runReport},
};

void printHelp(std::ostream& out)
{
    out << "vdbcage " VDBCAGE_VERSION ": coarse, tight, strictly bounding cages for any model\n\n"
           "  vdbcage COMMAND ARGUMENTS\n\n";
    for (const Command& command : commands) {
        out << "  " << command.name << std::string(10 - std::char_traits<char>::length(command.name), ' ')
            << command.help << '\n';
    }
    out << "\nvdbcage COMMAND --help tells more. Try: vdbcage make model.obj -o cage.obj\n";
}

class HelpFormatter : public CLI::Formatter {
public:
    std::string make_help(const CLI::App* app, std::string /*name*/, CLI::AppFormatMode mode) const override
    {
        std::string text = app->get_description() + "\n\n";
        for (const CLI::Option* option : app->get_options()) {
            if (option == app->get_help_ptr()) continue; // whoever reads this has found it
            if (mode == CLI::AppFormatMode::All ? option == app->get_help_all_ptr()
                                                : option->get_group() == rareOptions)
                continue;
            std::string left;
            for (const std::string& name : option->get_snames()) left += "-" + name + " ";
            for (const std::string& name : option->get_lnames()) left += "--" + name + " ";
            if (left.empty()) continue; // positionals are in the usage line of the description
            if (option->get_expected_max() > 0) left += option->get_type_name();
            left.resize(std::max<std::size_t>(left.size() + 1, 31), ' ');
            text += "  " + left + option->get_description() + '\n';
        }
        return text + app->get_footer();
    }
};

std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    std::size_t least = 3; // further away is no likely slip
    std::string nearest;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < least && distance < word.size()) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

int run(const std::vector<std::string>& arguments)
{
    if (arguments.empty()) {
        printHelp(std::cerr);
        return exitError;
    }
    const std::string& name = arguments.front();
    if (name == "--help" || name == "-h" || name == "help") {
        printHelp(std::cout);
        return exitGood;
    }
    if (name == "--version") {
        std::cout << "vdbcage " VDBCAGE_VERSION "\n";
        return exitGood;
    }
    std::vector<std::string> known;
    for (const Command& command : commands) {
        if (name == command.name) return command.run({arguments.begin() + 1, arguments.end()});
        known.emplace_back(command.name);
    }
    throw InputError("there is no command '" + name + "'" + didYouMean(name, known) + " (see vdbcage --help)");
}

/// Whether `argument` is meant as a file: an option with one dash has one letter that is known.
bool isFileName(const std::string& argument, const std::string& knownLetters)
{
    if (argument.size() < 2 || argument[0] != '-' || argument[1] == '-' || argument[1] == '.') return false;
    if (argument[1] >= '0' && argument[1] <= '9') return false; // a number
    std::error_code ignored;
    return knownLetters.find(argument[1]) == std::string::npos ||
           (argument.size() > 2 && std::filesystem::exists(argument, ignored));
}

/// Opens what the caller has closed of standard input, output and error: otherwise the next file that is opened would
/// be taken for one of them. Writing to them fails, as before.
void openStandardStreams()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) < 0) {
            static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) == descriptor);
        }
    }
}

/// Allocates nothing, as there may be no memory left. `text` is one printable line.
int fail(const char* text, int status) noexcept
{
    std::fprintf(stderr, "vdbcage: error: %s\n", text);
    return status;
}

int failWords(const char* text, int status) noexcept
{
    try {
        return fail(detail::printable(text).c_str(), status);
    } catch (const std::bad_alloc&) {
        return fail("not enough memory", exitTryAgain);
    }
}

/// Calls `work` and turns what it throws into an exit status and a line on standard error.
template <typename Work>
int guarded(const Work& work) noexcept
{
    try {
        return work();
    } catch (const std::exception& exception) {
        const Failure failure = failureOf(exception);
        if (dynamic_cast<const Cancelled*>(&exception)) {
            sayCancelled();
            return failure.status;
        }
        const bool isPrintable = dynamic_cast<const Error*>(&exception) || failure.text != exception.what();
        return isPrintable ? fail(failure.text, failure.status) : failWords(failure.text, failure.status);
    }
}

/// What could not be passed on as an exception: one in a destructor, in a thread's start, before main.
[[noreturn]] void onTerminate() noexcept
{
    const std::exception_ptr exception = std::current_exception();
    if (!exception) std::abort(); // a defect, not a lack of anything
    Outputs::abandon();
    const int status = guarded([&]() -> int { std::rethrow_exception(exception); });
    ::_exit(status);
}

/// Runs before the constructors of all shared libraries, some of which start threads.
void beforeAll(int /*count*/, char** /*arguments*/, char** /*environment*/)
{
    catchSignals();
    std::set_terminate(onTerminate);
}

__attribute__((section(".preinit_array"), used)) void (*const atStart)(int, char**, char**) = beforeAll;

} // namespace

bool parse(CLI::App& app, std::vector<std::string> arguments)
{
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "print this");
    int threads = 0;
    app.add_option("--threads", threads, "work with at most so many [all]")->type_name("N");
    std::vector<std::string> known;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    std::string letters;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_snames()) letters += name;
    }
    for (const std::string& argument : arguments) {
        if (argument == "--") break; // files only from here on
        if (isFileName(argument, letters)) {
            throw InputError("there is no option '" + argument + "'; a file of this name is written ./" + argument);
        }
        const std::string flag = argument.substr(0, argument.find('='));
        if (flag.size() > 2 && flag.compare(0, 2, "--") == 0 &&
            std::find(known.begin(), known.end(), flag) == known.end()) {
            throw InputError("there is no option '" + flag + "'" + didYouMean(flag, known) + " (see vdbcage " +
                             app.get_name() + " --help)");
        }
    }
    std::reverse(arguments.begin(), arguments.end()); // CLI11 takes them from the back
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        std::cout << app.help();
        return false;
    } catch (const CLI::CallForAllHelp&) {
        std::cout << app.help("", CLI::AppFormatMode::All);
        return false;
    }
    if (app.count("--threads") > 0) {
        requireWithin({1, 1024}, threads, "threads");
        limitThreads(threads);
    }
    return true;
}

} // namespace vdbcage::tool

void vdbcage::tool::flushOutput()
{
    errno = 0;
    std::cout.flush();
    if (std::cout) return;
    detail::throwIoError("standard output: cannot be written", errno);
}

int main(int argc, char** argv)
{
    using namespace vdbcage::tool;
    openStandardStreams();
    return guarded([&] {
        const int status = run({argv + 1, argv + argc});
        flushOutput();
        return status;
    });
}
