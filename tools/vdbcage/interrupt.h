#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::tool {

/// From here on SIGINT (Ctrl-C), SIGTERM, SIGHUP and SIGPIPE end the process at once with status 130 and a line on
/// standard error, unless a SignalHold lives: then they ask for a clean stop. A write beyond a limit of size or into a
/// pipe that nobody reads fails with a reason instead of a signal. SIGHUP that was ignored stays so (nohup).
void catchSignals() noexcept;

/// While one lives there is something to clean up, and a signal only sets `signalled`. One that came just before may be
/// about to end the process: ask `signalled` before there is anything.
class SignalHold {
public:
    SignalHold() noexcept;
    ~SignalHold();
    SignalHold(const SignalHold&) = delete;
    SignalHold& operator=(const SignalHold&) = delete;
};

/// Whether a signal has come that asks for a stop.
bool signalled() noexcept;

/// From here on signals change nothing: the work is done, and only words are left.
void ignoreSignals() noexcept;

/// Prints that the command was cancelled, unless that was said before.
void sayCancelled() noexcept;

/// How much a command says of its progress.
enum class Verbosity { quiet, normal, verbose };
constexpr Verbosity verbosityOf(bool quiet, bool verbose = false)
{
    return quiet ? Verbosity::quiet : verbose ? Verbosity::verbose : Verbosity::normal;
}

/// Shows how far the work is, on standard error, and passes a signal on to it. On a terminal it is one line that is
/// redrawn at most ten times a second. Elsewhere it is nothing, or if verbose a line for every stage and every second
/// of it, `PERCENT % STAGE SECONDS s`, for logs and for programs that show it. Where a stage says how far it is, `, N s
/// left` follows: of the stage, as fast as it went so far.
class Progress : public Interrupter {
public:
    explicit Progress(Verbosity verbosity);
    ~Progress() override;

    void start(const char* name = nullptr) override;
    void end() override;
    bool wasInterrupted(int percent = -1) override;

private:
    enum class Form { none, bar, lines };
    static Form formOf(Verbosity verbosity);
    void draw();

    using Clock = std::chrono::steady_clock;
    const Form form_;
    const Clock::time_point began_ = Clock::now();
    std::mutex mutex_; // guards what follows: wasInterrupted is called from many threads
    std::string stage_;
    int percent_ = 0; // of the stage, as far as it says
    Clock::time_point drawn_, stageBegan_;
};

} // namespace vdbcage::tool
