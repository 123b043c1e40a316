#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <tools/view/state/planner.h>

namespace vdbcage::view {

/// How far the job under way is.
struct Progress {
    Job::Kind kind = Job::Kind::full;
    std::string stage; ///< of the pipeline; empty before the first
    int percent = -1;  ///< of the stage, 0 to 100; -1: unknown
};

/// Makes cages on a thread of its own, as a Planner says. All its functions are for one thread, the owner's, and none
/// of them waits but waitForNews().
class Runner {
public:
    /// `wake` is called, from any thread, whenever update() has something to do or progress has changed; it must only
    /// wake the owner's thread.
    Runner(std::unique_ptr<CageMaker> maker, std::function<void()> wake);
    /// Cancels what is under way.
    ~Runner();
    Runner(const Runner&) = delete;
    Runner& operator=(const Runner&) = delete;

    void want(const std::optional<Order>& order, bool isDragging, bool intermediates = false);
    void cancel();
    void again();

    /// Takes what has ended and begins what is next. Returns whether anything ended or began.
    bool update();
    /// Waits until the job under way ends, or `seconds` have passed. Returns at once if there is none.
    void waitForNews(double seconds);

    /// What is known as of the last update().
    const Planner& planner() const { return planner_; }
    /// None: nothing is under way.
    std::optional<Progress> progress() const;

private:
    class Reporter;
    struct Outcome {
        CageResultPtr result; ///< null: it failed, or was stopped
        std::string error;    ///< why it failed; empty if it was stopped
    };

    void work();
    Outcome make(const Job& job);

    Planner planner_;                  ///< the owner's alone
    std::unique_ptr<CageMaker> maker_; ///< the thread's alone
    std::function<void()> wake_;

    mutable std::mutex mutex_; ///< guards what follows
    std::condition_variable changed_;
    std::optional<Job> job_;         ///< for the thread to take
    std::optional<Outcome> outcome_; ///< for the owner to take
    Progress progress_;
    bool quits_ = false;

    std::atomic<bool> stop_{false}; ///< asks the thread to stop what it does
    std::thread thread_;
};

/// Makes cages by two pipelines, one for previews and one for the rest: a change of effort would cost each its stages.
/// \return an object for one thread at a time
std::unique_ptr<CageMaker> makePipelineMaker();

} // namespace vdbcage::view
