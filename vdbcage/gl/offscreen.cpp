#include <vdbcage/gl/offscreen.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/gl/detail/platform.h>

namespace vdbcage::gl {

namespace {

/// The flag of a thread that has a context. OpenGL itself knows this for each thread, but drivers do not see contexts
/// of each other.
thread_local bool threadHasContext = false;

/// Threads that do nothing until all of them exist.
class IdleThreads {
public:
    ~IdleThreads()
    {
        gate_.unlock();
        for (std::thread& thread : threads_) thread.join();
    }
    void start(unsigned count)
    {
        threads_.reserve(count);
        while (threads_.size() < count) {
            threads_.emplace_back([this] { const std::lock_guard waits(gate_); });
        }
    }

private:
    struct Gate : std::mutex {
        Gate() { lock(); }
    };
    Gate gate_;
    std::vector<std::thread> threads_;
};

/// Throws unless Mesa's software can start its threads: it does not check whether they could be started, and then waits
/// for them without end. As many are started here first, for a moment. About 0.1 ms for two cores.
void requireThreads()
{
    constexpr unsigned mostForDrawing = 32, others = 8; // one for each core; those for shaders and caches
    try {
        IdleThreads().start(std::min(std::thread::hardware_concurrency(), mostForDrawing) + others);
    } catch (const std::system_error& error) {
        throw DeviceError(std::string("OpenGL: its threads cannot be started: ") + error.what());
    }
}

} // namespace

struct OffscreenContext::State {
    State(std::unique_ptr<detail::Platform> from, Debug debug) : platform(std::move(from))
    {
        const Current current(*this);
        const Api& table = api.emplace(platform->getProc());
        if (debug == Debug::on) enableDebugMessages(table);
        const Driver driver = driverOf(table);
        software = driver.isSoftware;
        description = std::string(platform->name()) + ": " + driver.description;
        throwIfFailed(table, "making a context");
    }

    std::unique_ptr<detail::Platform> platform;
    std::optional<Api> api;
    std::string description;
    bool software = false;
    std::atomic<bool> inUse{false};
};

OffscreenContext::OffscreenContext(Debug debug, Source source)
{
    requireThreads();
    std::string problems;
    const auto attempt = [&](const auto& work) {
        try {
            work();
        } catch (const DeviceError& error) {
            problems += (problems.empty() ? "" : "; ") + std::string(error.what());
        }
    };
    std::vector<detail::MakePlatform> ways;
    if (source != Source::osmesa) attempt([&] { ways = detail::eglPlatforms(source == Source::hardware); });
    if (source == Source::any || source == Source::osmesa) ways.emplace_back(&detail::makeOsmesa);
    for (const detail::MakePlatform& make : ways) {
        attempt([&] {
            state_ = std::make_unique<State>(make(debug == Debug::on), debug);
            if (source == Source::hardware && state_->software) {
                const std::string found = state_->description;
                state_.reset();
                throw DeviceError("OpenGL: a device turned out to be software (" + found + ")");
            }
        });
        if (state_) return;
    }
    throw DeviceError(problems);
}

OffscreenContext::~OffscreenContext() = default;

OffscreenContext::Current::Current(State& state) : state_(state)
{
    if (threadHasContext) throw DeviceError("OpenGL: a context is already current on this thread");
    if (state_.inUse.exchange(true)) throw DeviceError("OpenGL: the context is in use on another thread");
    try {
        state_.platform->makeCurrent();
    } catch (...) {
        state_.inUse = false;
        throw;
    }
    threadHasContext = true;
}

OffscreenContext::Current::~Current()
{
    state_.platform->release();
    threadHasContext = false;
    state_.inUse = false;
}

OffscreenContext::Current OffscreenContext::makeCurrent() const
{
    return Current(*state_);
}

const Api& OffscreenContext::api() const
{
    return *state_->api;
}

const std::string& OffscreenContext::description() const
{
    return state_->description;
}

bool OffscreenContext::isSoftware() const
{
    return state_->software;
}

} // namespace vdbcage::gl
