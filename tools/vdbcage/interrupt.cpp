#include "interrupt.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <unistd.h>

namespace vdbcage::tool {

namespace {

// A signal handler can reach nothing but static storage.
volatile std::sig_atomic_t signalCame = 0;

extern "C" void onSignal(int signal)
{
    if (signalCame != 0) ::_exit(128 + signal);
    signalCame = 1;
}

constexpr int barWidth = 24;

} // namespace

void catchSignals()
{
    struct sigaction action {};
    action.sa_handler = onSignal;
    sigemptyset(&action.sa_mask);
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    // Whoever started us may have had them blocked.
    sigset_t ours;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    sigaddset(&ours, SIGTERM);
    ::sigprocmask(SIG_UNBLOCK, &ours, nullptr);
}

bool signalled()
{
    return signalCame != 0;
}

Progress::Progress(bool quiet) : visible_(!quiet && ::isatty(STDERR_FILENO) == 1)
{
}

Progress::~Progress()
{
    if (lineOnScreen_) std::fputs("\r\033[K", stderr);
}

void Progress::start(const char* name)
{
    const std::lock_guard lock(mutex_);
    stage_ = name ? name : "";
    draw(0);
}

void Progress::end()
{
    const std::lock_guard lock(mutex_);
    draw(100);
}

bool Progress::wasInterrupted(int percent)
{
    if (visible_ && percent >= 0 && mutex_.try_lock()) {
        const std::lock_guard lock(mutex_, std::adopt_lock);
        if (Clock::now() - drawn_ >= std::chrono::milliseconds(100)) draw(percent);
    }
    return signalled();
}

void Progress::draw(int percent)
{
    if (!visible_) return;
    drawn_ = Clock::now();
    const double seconds = std::chrono::duration<double>(drawn_ - began_).count();
    const int done = std::clamp(percent, 0, 100);
    std::string bar(static_cast<std::size_t>(done * barWidth / 100), '#');
    bar.resize(barWidth, '.');
    std::fprintf(stderr, "\r\033[K[%s] %3d %%  %-10s %6.1f s", bar.c_str(), done, stage_.c_str(), seconds);
    std::fflush(stderr);
    lineOnScreen_ = true;
}

} // namespace vdbcage::tool
