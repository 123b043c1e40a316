#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <tools/view/jobs/planner.h>
#include <tools/view/jobs/worker.h>

namespace vdbcage::view {

/// The progress of the job under way.
struct Progress : WorkProgress {
    Job::Kind kind = Job::Kind::full;
};

/// A thread that makes cages as a Planner decides. Call it from one thread, the owner's. Only waitForNews() waits.
class Runner {
public:
    /// `wake` is called, from any thread, whenever update() has something to do or progress has changed; it must only
    /// wake the owner's thread.
    Runner(std::unique_ptr<CageMaker> maker, std::function<void()> wake);

    void want(const std::optional<Order>& order, bool isDragging, bool intermediates = false);
    void cancel();
    void again();

    /// Takes the finished result and begins the next job. Returns whether one ended or began.
    bool update();
    /// Waits until the job under way ends, or `seconds` have passed. Returns at once if there is none.
    void waitForNews(double seconds);

    /// Returns the state as of the last update().
    const Planner& planner() const { return planner_; }
    /// Returns the progress; none: nothing is under way.
    std::optional<Progress> progress() const;

private:
    Planner planner_;
    std::unique_ptr<CageMaker> maker_; ///< used only by the worker
    Worker<Job, CageResultPtr> worker_;
};

/// Returns a maker with two pipelines, one for previews and one for the rest: a change of effort would cost each its
/// stages.
/// \return an object for one thread at a time
std::unique_ptr<CageMaker> makePipelineMaker();

} // namespace vdbcage::view
