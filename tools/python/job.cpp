#include "job.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>

#include <vdbcage/core/error.h>

namespace py = pybind11;

namespace vdbcage::python {

namespace {

constexpr std::chrono::milliseconds wakeInterval{50}; // a person takes 0.1 s for at once

/// What the working thread reports and the caller's thread asks for.
class Watch : public Interrupter {
public:
    void start(const char* name = nullptr) override
    {
        const std::lock_guard lock(mutex_);
        stage_ = name ? name : "";
        percent_ = 0;
    }
    void end() override {}
    bool wasInterrupted(int percent = -1) override
    {
        if (percent >= 0) percent_ = std::min(percent, 100);
        return stopped_;
    }

    void stop() { stopped_ = true; }
    std::pair<std::string, int> progress() const
    {
        const std::lock_guard lock(mutex_);
        return {stage_, percent_};
    }

private:
    mutable std::mutex mutex_;
    std::string stage_;
    std::atomic<int> percent_{0};
    std::atomic<bool> stopped_{false};
};

/// A thread that is stopped and waited for when this goes out of scope.
class Worker {
public:
    explicit Worker(const std::function<void(Interrupter*)>& work)
        : thread_([this, &work] {
              try {
                  work(&watch_);
              } catch (...) {
                  failure_ = std::current_exception();
              }
              const std::lock_guard lock(mutex_);
              isDone_ = true;
              done_.notify_one();
          })
    {
    }
    ~Worker()
    {
        watch_.stop();
        if (!thread_.joinable()) return;
        const py::gil_scoped_release release;
        thread_.join();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Whether the work ended within the interval.
    bool wait(std::chrono::milliseconds interval)
    {
        const py::gil_scoped_release release;
        std::unique_lock lock(mutex_);
        return done_.wait_for(lock, interval, [&] { return isDone_; });
    }
    /// \throw what the work threw
    void finish()
    {
        {
            const py::gil_scoped_release release;
            thread_.join();
        }
        if (failure_) std::rethrow_exception(failure_);
    }
    std::pair<std::string, int> progress() const { return watch_.progress(); }

private:
    Watch watch_;
    std::exception_ptr failure_;
    std::mutex mutex_;
    std::condition_variable done_;
    bool isDone_ = false;
    std::thread thread_; // last: it uses all of the others
};

} // namespace

void runJob(const py::object& progress, const std::function<void(Interrupter*)>& work)
{
    Worker worker(work);
    while (!worker.wait(wakeInterval)) {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (progress.is_none()) continue;
        const auto [stage, percent] = worker.progress();
        if (progress(stage, percent).is(py::bool_(false))) throw Cancelled();
    }
    worker.finish();
}

} // namespace vdbcage::python
