#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <tools/view/jobs/planner.h>
#include <tools/view/jobs/worker.h>

namespace vdbcage::view {

/// How far the job under way is.
struct Progress : WorkProgress {
    Job::Kind kind = Job::Kind::full;
};

/// Makes cages on a thread of its own, as a Planner says. All its functions are for one thread, the owner's, and none
/// of them waits but waitForNews().
class Runner {
public:
    /// `wake` is called, from any thread, whenever update() has something to do or progress has changed; it must only
    /// wake the owner's thread.
    Runner(std::unique_ptr<CageMaker> maker, std::function<void()> wake);

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
    Planner planner_;
    std::unique_ptr<CageMaker> maker_; ///< the worker's alone
    Worker<Job, CageResultPtr> worker_;
};

/// Makes cages by two pipelines, one for previews and one for the rest: a change of effort would cost each its stages.
/// \return an object for one thread at a time
std::unique_ptr<CageMaker> makePipelineMaker();

} // namespace vdbcage::view
