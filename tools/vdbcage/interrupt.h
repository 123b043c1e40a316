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

/// Shows how far the work is on a terminal and passes a signal on to it: one line on standard error that is redrawn at
/// most ten times a second; nothing where standard error is not a terminal or `quiet`.
class Progress : public Interrupter {
public:
    explicit Progress(bool quiet);
    ~Progress() override;

    void start(const char* name = nullptr) override;
    void end() override;
    bool wasInterrupted(int percent = -1) override;

private:
    void draw(int percent);

    using Clock = std::chrono::steady_clock;
    const bool visible_;
    const Clock::time_point began_ = Clock::now();
    std::mutex mutex_; // guards what follows: wasInterrupted is called from many threads
    std::string stage_;
    Clock::time_point drawn_;
};

} // namespace vdbcage::tool
