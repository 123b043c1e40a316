#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include <tools/report/run_progress.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::cli {

/// From here on SIGINT (Ctrl-C), SIGTERM, SIGHUP and SIGPIPE end the process at once with cancelledStatus() and
/// a line on standard error, unless a SignalHold lives: then they ask for a clean stop. A write beyond a limit of size
/// or into a pipe that nobody reads fails with a reason instead of a signal. SIGHUP that was ignored stays so (nohup).
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

/// The exit status after a signal, the first that came: exitTerminated after SIGTERM, else exitCancelled.
int cancelledStatus() noexcept;

/// From here on signals change nothing: the work is done, and only words are left.
void ignoreSignals() noexcept;

/// Prints that the command was cancelled, unless that was said before.
void sayCancelled() noexcept;

/// How progress is told.
enum class ProgressForm {
    none,
    bar,   ///< one line on standard error, redrawn at most ten times a second
    lines, ///< on standard error a line for every stage and every second of it, `PERCENT % STAGE SECONDS s`, for logs
    farm   ///< on standard output `Progress: 42%` and `ALF_PROGRESS 42%`, as it rises
};

/// Shows how far the whole command is, by RunProgress, and passes a signal on to it. Where that knows, bar and lines
/// have `, N s left`.
class Progress : public Interrupter {
public:
    explicit Progress(ProgressForm form);
    ~Progress() override;

    /// The work is done: what has a percentage shows 100.
    void succeed();

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
    std::mutex mutex_; // guards what follows: wasInterrupted is called from many threads
    std::string stage_;
    report::RunProgress run_;
    int shownToFarm_ = -1;
    Clock::time_point drawn_;
};

} // namespace vdbcage::cli
