// The command `vdbcage`: messages to standard error, data to files and standard output.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iomanip>
#include <iostream>
#include <new>

#include <fcntl.h>
#include <gmp.h>
#include <unistd.h>

#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>

#include <tools/cli/commands.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

namespace {

void printHelp(std::ostream& out)
{
    out << "vdbcage " VDBCAGE_VERSION ": coarse, tight, strictly bounding cages for any model\n\n"
           "  vdbcage COMMAND ARGUMENTS\n\n";
    for (const Command& command : commands()) {
        out << "  " << std::left << std::setw(12) << command.name << command.summary << '\n';
    }
    out << "\nvdbcage COMMAND --help tells more. Try: vdbcage make model.obj -o cage.obj\n"
           "vdbcage --version prints the version. The window is vdbcage-view.\n";
}

int run(const std::vector<std::string>& arguments)
{
    if (arguments.empty()) {
        printHelp(std::cerr);
        return exitError;
    }
    std::string name = arguments.front();
    std::vector<std::string> words(arguments.begin() + 1, arguments.end());
    if (name == "--help" || name == "-h" || name == "help") {
        if (name != "help" || words.empty()) {
            printHelp(std::cout);
            return exitGood;
        }
        name = words.front();
        words = {"--help"};
    }
    if (name == "--version") {
        std::cout << "vdbcage " VDBCAGE_VERSION "\n";
        return exitGood;
    }
    return commandNamed(name).run({std::move(words)});
}

/// Opens those of standard input, output and error that the caller has closed: otherwise the next opened file would be
/// taken for one of them. Writing to them fails, as before.
void openStandardStreams()
{
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(descriptor, F_GETFD) < 0) {
            static_cast<void>(::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY) == descriptor);
        }
    }
}

/// Prints the error and returns the status. Allocates nothing, as there may be no memory left. `text` is one printable
/// line.
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

/// Calls `work` and turns its exceptions into an exit status and a line on standard error.
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

/// Handles exceptions that could not be passed on: from a destructor, from a thread's start, before main.
[[noreturn]] void onTerminate() noexcept
{
    const std::exception_ptr exception = std::current_exception();
    if (!exception) std::abort(); // a defect, not a lack of resources
    Outputs::abandon();
    const int status = guarded([&]() -> int { std::rethrow_exception(exception); });
    ::_exit(status);
}

/// Does the same as onTerminate for GMP, which makes CGAL's exact numbers: by itself it aborts if memory lacks.
[[noreturn]] void onLackOfMemory() noexcept
{
    Outputs::abandon();
    ::_exit(fail("not enough memory", exitTryAgain));
}

void* allocateForGmp(std::size_t size)
{
    void* const block = std::malloc(size);
    if (!block) onLackOfMemory();
    return block;
}

void* reallocateForGmp(void* old, std::size_t /*oldSize*/, std::size_t size)
{
    void* const block = std::realloc(old, size);
    if (!block) onLackOfMemory();
    return block;
}

/// Runs before the constructors of all shared libraries, some of which start threads.
void beforeAll(int /*count*/, char** /*arguments*/, char** /*environment*/)
{
    catchSignals();
    std::set_terminate(onTerminate);
    ::mp_set_memory_functions(allocateForGmp, reallocateForGmp, nullptr); // null: free()
}

__attribute__((section(".preinit_array"), used)) void (*const atStart)(int, char**, char**) = beforeAll;

} // namespace

} // namespace vdbcage::cli

int main(int argc, char** argv)
{
    using namespace vdbcage::cli;
    openStandardStreams();
    return guarded([&] {
        const int status = run({argv + 1, argv + argc});
        flushOutput();
        return status;
    });
}
