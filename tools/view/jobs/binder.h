#pragma once

#include <functional>
#include <list>
#include <optional>
#include <string>

#include <tools/view/jobs/worker.h>
#include <tools/view/state/bound_model.h>

namespace vdbcage::view {

/// Binds models to cages on a thread of its own: coarsely first, then whole. What is wanted now is begun at once; what
/// is under way for something else is stopped. What was bound is kept, so that families can be switched to and fro. All
/// its functions are for one thread, the owner's, and none of them waits but waitForNews().
class Binder {
public:
    using Work = Worker<BindOrder, BoundModelPtr>::Work;

    /// `wake`: see Worker. `mostBytes`: bindings of more than that in all are not kept, the oldest going first.
    Binder(Work work, std::function<void()> wake, std::size_t mostBytes = std::size_t{1} << 30);

    /// What is wanted now; none: nothing. Asking for the same again changes nothing.
    void want(const std::optional<BindOrder>& order);
    /// Stops what is under way; nothing is bound until something else is wanted, or again() is called.
    void cancel();
    void again();

    /// Takes what has ended and begins what is next. Returns whether anything ended or began.
    bool update();
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);

    /// What is bound of what is wanted; null: nothing yet.
    const BoundModelPtr& bound() const { return bound_; }
    /// Nothing of what is wanted is left to do.
    bool isSettled() const;
    /// What is wanted was cancelled, or failed.
    bool isHalted() const { return isHalted_; }
    /// Why it failed; empty if it did not.
    const std::string& error() const { return error_; }
    /// None: nothing is under way.
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
    std::list<BoundModelPtr> kept_; ///< whole ones, the last one first
};

/// Binds by the library.
Binder::Work bindingWork();

} // namespace vdbcage::view
