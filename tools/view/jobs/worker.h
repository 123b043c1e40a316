#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include <tools/report/run_progress.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::view {

/// The progress of a job.
struct WorkProgress {
    std::string stage; ///< empty before the first
    int percent = -1;  ///< of the job, 0 to 99; -1: unknown
};

/// A thread that does one job at a time. Call it from one thread, the owner's. Only waitForNews() waits.
template <class Job, class Result>
class Worker {
public:
    /// The result or failure of a job, or of a part of it.
    struct Outcome {
        std::optional<Result> result; ///< none: it failed or was stopped
        std::string error;            ///< the reason why it failed; empty if it was stopped
        bool isLast = true;           ///< false: more of the same job follows
    };
    /// A function that takes a part of the job's result before the job is done.
    using Publish = std::function<void(Result)>;
    /// A function that does a job on the worker's thread. \throw std::exception, Cancelled
    using Work = std::function<Result(const Job&, Interrupter&, const Publish&)>;

    /// `wake` is called, from any thread, whenever there is an outcome to take or progress has changed; it must only
    /// wake the owner's thread.
    Worker(Work work, std::function<void()> wake)
        : work_(std::move(work)), wake_(std::move(wake)), thread_([this] { run(); })
    {
    }
    /// Stops the present job.
    ~Worker()
    {
        stop_ = true;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            quits_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Begins a job. \pre no job is under way: the last outcome of the previous one was taken
    void start(Job job)
    {
        stop_ = false;
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            progress_ = {};
            job_ = std::move(job);
        }
        changed_.notify_all();
    }
    /// Asks the job under way to stop. Its outcome still comes.
    void stop() { stop_ = true; }

    /// Returns the last outcome since the previous call. Earlier ones of the same job are dropped.
    std::optional<Outcome> take()
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return std::exchange(outcome_, std::nullopt);
    }
    /// Waits until there is an outcome, or `seconds` have passed.
    void waitForNews(double seconds)
    {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return outcome_.has_value(); });
    }
    WorkProgress progress() const
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        return progress_;
    }

private:
    /// The link from a job to the owner's thread: passes progress to the owner, and the owner's wish to stop to the
    /// job.
    class Reporter : public Interrupter {
    public:
        explicit Reporter(Worker& worker) : worker_(worker) {}

        void start(const char* name) override
        {
            told_ = -1;
            change([&] {
                worker_.progress_.stage = name ? name : "";
                run_.start(worker_.progress_.stage, 0);
            });
        }
        void end() override {}
        bool wasInterrupted(int percent) override
        {
            // Called from many threads, some million times a second: only a greater number takes the lock.
            if (percent > told_.load(std::memory_order_relaxed)) {
                told_ = percent;
                change([&] { run_.advance(percent, 0); });
            }
            return worker_.stop_.load(std::memory_order_relaxed);
        }

    private:
        template <typename Change>
        void change(const Change& change)
        {
            {
                const std::lock_guard<std::mutex> lock(worker_.mutex_);
                change();
                worker_.progress_.percent = run_.percent() > 0 ? run_.percent() : -1;
            }
            worker_.wake_();
        }

        Worker& worker_;
        report::RunProgress run_;   ///< guarded by the worker's mutex
        std::atomic<int> told_{-1}; ///< of the stage
    };

    void run()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        for (;;) {
            changed_.wait(lock, [&] { return quits_ || job_; });
            if (quits_) return;
            const Job job = *std::exchange(job_, std::nullopt);
            lock.unlock();
            publish(resultOf(job));
            lock.lock();
        }
    }

    Outcome resultOf(const Job& job)
    {
        Reporter reporter(*this);
        try {
            return {work_(job, reporter, [this](Result part) { publish({std::move(part), {}, false}); }), {}, true};
        } catch (const Cancelled&) {
            return {};
        } catch (const std::exception& error) { // also if memory ran out: the window stays, with its content
            const std::string text = error.what();
            return {std::nullopt, text.empty() ? "it cannot be done" : text, true};
        }
    }

    void publish(Outcome outcome)
    {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            outcome_ = std::move(outcome);
        }
        changed_.notify_all();
        wake_();
    }

    Work work_; ///< used only by the thread
    std::function<void()> wake_;

    mutable std::mutex mutex_; ///< guards the members below
    std::condition_variable changed_;
    std::optional<Job> job_;         ///< for the thread to take
    std::optional<Outcome> outcome_; ///< for the owner to take
    WorkProgress progress_;
    bool quits_ = false;

    std::atomic<bool> stop_{false}; ///< asks the thread to stop its job
    std::thread thread_;
};

} // namespace vdbcage::view
