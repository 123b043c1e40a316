#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include <tools/report/run_progress.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::cli {

/// Handles signals from here on: SIGINT (Ctrl-C), SIGTERM, SIGHUP and SIGPIPE end the process at once with
/// cancelledStatus() and a line on standard error, unless a SignalHold lives: then they ask for a clean stop. A write
/// beyond a limit of size or into a pipe without a reader fails with a reason instead of a signal. An ignored SIGHUP
/// stays ignored (nohup).
void catchSignals() noexcept;

/// A hold on the end of the process while there is something to clean up: a signal only sets `signalled`. One that came
/// just before may be about to end the process: ask `signalled` before there is anything.
class SignalHold {
public:
    SignalHold() noexcept;
    ~SignalHold();
    SignalHold(const SignalHold&) = delete;
    SignalHold& operator=(const SignalHold&) = delete;
};

/// Returns whether a signal asked for a stop.
bool signalled() noexcept;

/// Returns the exit status by the first signal: exitTerminated after SIGTERM, else exitCancelled.
int cancelledStatus() noexcept;

/// Ignores signals from here on: the work is done, and only messages are left.
void ignoreSignals() noexcept;

/// Prints that the command was cancelled, unless it was printed before.
void sayCancelled() noexcept;

/// The form of progress reports.
enum class ProgressForm {
    none,
    bar,   ///< one line on standard error, redrawn at most ten times a second
    lines, ///< on standard error a line for every stage and every second of it, `PERCENT % STAGE SECONDS s`, for logs
    farm   ///< on standard output `Progress: 42%` and `ALF_PROGRESS 42%`, as it rises
};

/// The progress display of the whole command, by RunProgress, which also passes a signal on to it. If the time left is
/// known, bar and lines have `, N s left`.
class Progress : public Interrupter {
public:
    explicit Progress(ProgressForm form);
    ~Progress() override;

    /// Ends with 100 % in forms that have a percentage: the work is done.
    void succeed();
    /// Writes a line to standard error where progress goes there.
    void say(const std::string& line);

    void start(const char* name = nullptr) override;
    void end() override;
    bool wasInterrupted(int percent = -1) override;

private:
    void draw();
    void drawForFarm(int percent);
    double seconds() const; // since the command began

    using Clock = std::chrono::steady_clock;
    const ProgressForm form_;
    const Clock::time_point began_ = Clock::now();
    std::mutex mutex_; // guards the members below: wasInterrupted is called from many threads
    std::string stage_;
    report::RunProgress run_;
    int shownToFarm_ = -1;
    Clock::time_point drawn_;
};

} // namespace vdbcage::cli
