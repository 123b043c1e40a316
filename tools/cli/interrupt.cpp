#include <tools/cli/interrupt.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <string_view>

#include <unistd.h>

#include <tools/cli/exit_status.h>

namespace vdbcage::cli {

namespace {

// A signal handler can use only static storage. It runs on any thread.
std::atomic<int> signalCame{0};
std::atomic<bool> lineOnScreen{false};
std::atomic<int> holds{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may only use atomics without locks");

void write(std::string_view text)
{
    static_cast<void>(::write(STDERR_FILENO, text.data(), text.size()) == 0); // nobody left to tell
}

extern "C" void onSignal(int signal, siginfo_t* info, void* /*context*/)
{
    // A write of this process raised it: the write fails, and its caller reports that.
    if (signal == SIGPIPE && info->si_pid == ::getpid()) return;
    int none = 0;
    const bool isFirst = signalCame.compare_exchange_strong(none, signal); // before holds are read: see `signalled`
    if (holds > 0 || !isFirst) return;
    sayCancelled();
    ::_exit(cancelledStatus());
}

constexpr std::size_t barWidth = 24;

} // namespace

void catchSignals() noexcept
{
    struct sigaction action {
    }, old{};
    sigset_t caught;
    sigemptyset(&caught);
    action.sa_sigaction = onSignal;
    action.sa_flags = SA_SIGINFO | SA_RESTART;
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
        ::sigaction(signal, nullptr, &old);
        if (signal == SIGHUP && (old.sa_flags & SA_SIGINFO) == 0 && old.sa_handler == SIG_IGN) continue;
        ::sigaction(signal, &action, nullptr);
        sigaddset(&caught, signal);
    }
    action = {};
    action.sa_handler = SIG_IGN;
    ::sigaction(SIGXFSZ, &action, nullptr);
    ::sigprocmask(SIG_UNBLOCK, &caught, nullptr); // the parent process may have blocked them
}

SignalHold::SignalHold() noexcept
{
    ++holds;
}

SignalHold::~SignalHold()
{
    --holds;
}

bool signalled() noexcept
{
    return signalCame != 0;
}

int cancelledStatus() noexcept
{
    return signalCame == SIGTERM ? exitTerminated : exitCancelled;
}

void ignoreSignals() noexcept
{
    ++holds;
}

void sayCancelled() noexcept
{
    static std::atomic<bool> isSaid{false};
    if (isSaid.exchange(true)) return;
    if (lineOnScreen.exchange(false)) write("\r\033[K");
    write("vdbcage: error: cancelled\n");
}

Progress::Progress(ProgressForm form) : form_(form)
{
}

Progress::~Progress()
{
    if (lineOnScreen.exchange(false)) std::fputs("\r\033[K", stderr);
}

void Progress::succeed()
{
    if (form_ == ProgressForm::farm) drawForFarm(100);
}

void Progress::say(const std::string& line)
{
    if (form_ != ProgressForm::bar && form_ != ProgressForm::lines) return;
    const std::lock_guard lock(mutex_);
    if (lineOnScreen.exchange(false)) std::fputs("\r\033[K", stderr);
    std::fprintf(stderr, "%s\n", line.c_str());
}

double Progress::seconds() const
{
    return std::chrono::duration<double>(Clock::now() - began_).count();
}

void Progress::start(const char* name)
{
    const std::lock_guard lock(mutex_);
    stage_ = name ? name : "";
    run_.start(stage_, seconds());
    draw();
}

void Progress::end()
{
    const std::lock_guard lock(mutex_);
    run_.advance(100, seconds());
    if (form_ != ProgressForm::lines) draw(); // lines end with the next stage anyway
}

bool Progress::wasInterrupted(int percent)
{
    if (form_ != ProgressForm::none && mutex_.try_lock()) {
        const std::lock_guard lock(mutex_, std::adopt_lock);
        const std::chrono::milliseconds pause(form_ == ProgressForm::bar ? 100 : 1000);
        if (percent >= 0) run_.advance(percent, seconds());
        if (Clock::now() - drawn_ >= pause) draw();
    }
    return signalled();
}

/// Draws the bar. Allocates nothing: it also runs while an exception is thrown.
void Progress::draw()
{
    if (form_ == ProgressForm::none) return;
    drawn_ = Clock::now();
    const int done = run_.percent();
    if (form_ == ProgressForm::farm) return drawForFarm(done);
    std::array<char, 24> left{};
    if (const auto more = run_.secondsLeft(seconds())) std::snprintf(left.data(), left.size(), ", %d s left", *more);
    if (form_ == ProgressForm::lines) {
        if (stage_.empty()) return;
        std::fprintf(stderr, "%3d %%  %-10s %6.1f s%s\n", done, stage_.c_str(), seconds(), left.data());
        return;
    }
    std::array<char, barWidth + 1> bar{};
    std::fill_n(bar.begin(), barWidth, '.');
    std::fill_n(bar.begin(), barWidth * static_cast<std::size_t>(done) / 100, '#');
    std::fprintf(stderr, "\r\033[K[%s] %3d %%  %-10s %6.1f s%s", bar.data(), done, stage_.c_str(), seconds(),
                 left.data());
    std::fflush(stderr);
    lineOnScreen = true;
}

void Progress::drawForFarm(int percent)
{
    if (percent <= shownToFarm_) return;
    shownToFarm_ = percent;
    std::printf("Progress: %d%%\nALF_PROGRESS %d%%\n", percent, percent);
    std::fflush(stdout);
}

} // namespace vdbcage::cli
