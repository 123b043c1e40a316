#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

#include <vdbcage/core/interrupter.h>

namespace vdbcage::tool {

/// From here on Ctrl-C (SIGINT) and SIGTERM ask for a clean stop; a second one ends the process at once.
void catchSignals();

/// Whether such a signal has come.
bool signalled();

/// Shows how far the work is on a terminal and passes Ctrl-C on to it: one line on standard error that is redrawn at
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
    bool lineOnScreen_ = false;
};

} // namespace vdbcage::tool
