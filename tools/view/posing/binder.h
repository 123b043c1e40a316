#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>

#include <tools/view/jobs/worker.h>
#include <tools/view/posing/bound_model.h>

namespace vdbcage::view {

/// A thread that binds models to cages: coarsely first, then completely. A wanted job begins at once; one under way for
/// another order is stopped. Results are kept, so that users can switch between families. Call it from one thread, the
/// owner's. Only waitForNews() waits.
class Binder {
public:
    using Work = Worker<BindOrder, BoundModelPtr>::Work;

    /// `wake`: see Worker. `mostBytes`: the most that kept bindings take; the oldest go first.
    Binder(Work work, std::function<void()> wake, std::size_t mostBytes = std::size_t{1} << 30);

    /// Sets the wanted order; none: nothing. The same order again changes nothing.
    void want(const std::optional<BindOrder>& order);
    /// Stops the present job; nothing is bound until another order is wanted, or again() is called.
    void cancel();
    void again();

    /// Takes the finished result and begins the next job. Returns whether one ended or began.
    bool update();
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);

    /// Returns the result for the wanted order, as far as it is bound; null: nothing yet.
    const BoundModelPtr& bound() const { return bound_; }
    /// Returns whether nothing is left to do for the wanted order.
    bool isSettled() const;
    /// Returns whether the wanted job was cancelled or failed.
    bool isHalted() const { return isHalted_; }
    /// Returns the reason why it failed; empty if it did not.
    const std::string& error() const { return error_; }
    /// Returns the progress; none: nothing is under way.
    std::optional<WorkProgress> progress() const;

private:
    void keep(const BoundModelPtr& bound);
    void reconsider();

    Worker<BindOrder, BoundModelPtr> worker_;
    std::size_t mostBytes_;
    std::optional<BindOrder> wanted_, running_;
    BoundModelPtr bound_;
    bool isHalted_ = false;
    std::string error_;
    std::list<BoundModelPtr> kept_; ///< complete ones, the last one first
};

/// Returns a function that binds by the library.
Binder::Work bindingWork();

} // namespace vdbcage::view
