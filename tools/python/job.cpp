#include "job.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include <tools/report/run_progress.h>
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
        run_.start(stage_, 0);
        told_ = 0;
    }
    void end() override {}
    bool wasInterrupted(int percent = -1) override
    {
        // Called from many threads, some million times a second: only a greater number takes the lock.
        if (percent > told_.load(std::memory_order_relaxed)) {
            const std::lock_guard lock(mutex_);
            told_ = percent;
            run_.advance(percent, 0);
        }
        return stopped_;
    }

    void stop() { stopped_ = true; }
    std::pair<std::string, int> progress() const
    {
        const std::lock_guard lock(mutex_);
        return {stage_, run_.percent()};
    }

private:
    mutable std::mutex mutex_;
    std::string stage_;
    report::RunProgress run_;
    std::atomic<int> told_{0}; // of the stage
    std::atomic<bool> stopped_{false};
};

/// The calls that are running. Python's lock guards it.
class Jobs {
public:
    void add(Watch& watch)
    {
        if (isClosed_) throw Cancelled();
        running_.insert(&watch);
    }
    void remove(Watch& watch) { running_.erase(&watch); }
    /// Stops all of them, and returns when their callers have Python's lock again. No more may begin.
    void close()
    {
        isClosed_ = true;
        for (Watch* watch : running_) watch->stop();
        while (!running_.empty()) {
            const py::gil_scoped_release release;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    /// In a forked process the threads of the others are not there.
    void forget() { running_.clear(); }

private:
    std::set<Watch*> running_;
    bool isClosed_ = false;
};

/// A call that is among `jobs` until this goes out of scope.
class Entry {
public:
    Entry(Jobs& jobs, Watch& watch) : jobs_(jobs), watch_(watch) { jobs_.add(watch_); }
    ~Entry() { jobs_.remove(watch_); }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

private:
    Jobs& jobs_;
    Watch& watch_;
};

/// A thread that is stopped and waited for when this goes out of scope.
class Worker {
public:
    Worker(Watch& watch, const std::function<void(Interrupter*)>& work)
        : watch_(watch), thread_([this, &work] {
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

private:
    Watch& watch_;
    std::exception_ptr failure_;
    std::mutex mutex_;
    std::condition_variable done_;
    bool isDone_ = false;
    std::thread thread_; // last: it uses all of the others
};

} // namespace

void defineJobs(py::module_& module)
{
    py::class_<Jobs> jobs(module, "Jobs", py::module_local());
    jobs.def(py::init()).def("close", &Jobs::close).def("forget", &Jobs::forget);
    module.attr("jobs") = jobs();
    py::module_::import("atexit").attr("register")(module.attr("jobs").attr("close"));
    py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = module.attr("jobs").attr("forget"));
}

void runJob(const py::object& progress, const std::function<void(Interrupter*)>& work)
{
    const py::object jobs = py::module_::import("vdbcage._vdbcage").attr("jobs");
    Watch watch;
    const Entry entry(jobs.cast<Jobs&>(), watch);
    Worker worker(watch, work);
    while (!worker.wait(wakeInterval)) {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        if (progress.is_none()) continue;
        const auto [stage, percent] = watch.progress();
        if (progress(stage, percent).is(py::bool_(false))) throw Cancelled();
    }
    worker.finish();
}

} // namespace vdbcage::python
