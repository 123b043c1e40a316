#pragma once

#include <list>
#include <optional>
#include <string>

#include <tools/view/jobs/cage_result.h>

namespace vdbcage::view {

/// Decides which cage is made next, which one under way is of no use any more, and which one is shown. It has no thread
/// and no clock: it is told what happens, and asked.
///
/// At most one job is under way. What waits is what is wanted now, so at most one. While a value is dragged only
/// previews are made. A preview under way is left to finish, unless what is wanted now shares none of its stages. A
/// full run is stopped as soon as something else is wanted. When a drag ends the full run begins at once; after any
/// other change its preview comes first. Results are kept by their orders, so what was made once is there at once. When
/// nothing is to do, previews of the neighbouring face counts are made ahead.
class Planner {
public:
    /// `mostBytes`: results of more than that in all are not kept, the oldest going first (two always stay).
    explicit Planner(std::size_t mostBytes = std::size_t{256} << 20) : mostBytes_(mostBytes) {}

    /// What is wanted now; none: nothing. Asking for the same again changes nothing. `intermediates`: of the full one.
    void want(const std::optional<Order>& order, bool isDragging, bool intermediates = false);
    /// Stops what is under way, and makes nothing until something else is wanted, or again() is called.
    void cancel();
    /// Makes what is wanted although it was cancelled or failed.
    void again();

    /// What is to be done now, which is under way from here on. None while something is.
    std::optional<Job> start();
    /// Whether the job under way is to be stopped.
    bool shouldStop() const { return running_ && stop_; }
    /// How the job under way ended. \pre it is under way
    void finished(CageResultPtr result);
    void failed(const std::string& error);
    void stopped();

    const std::optional<Job>& running() const { return running_; }
    /// Nothing is under way, and nothing is to be done.
    bool isIdle() const { return !running_ && !nextJob(); }
    /// As isIdle, but what is made ahead does not count.
    bool isSettled() const;
    /// What is wanted was cancelled, or failed.
    bool isHalted() const { return isHalted_; }
    /// Why what is wanted cannot be had; empty if it did not fail.
    const std::string& error() const { return error_; }

    enum class Standing {
        none,    ///< there is nothing to show
        current, ///< it is what is wanted
        preview, ///< it is the preview of what is wanted
        stale    ///< it was made by other options, for the same model
    };
    /// The cage to show, with its own options; null if there is none.
    const CageResultPtr& shown() const { return shown_; }
    Standing standing() const;

private:
    std::optional<Job> nextJob() const;
    CageResultPtr kept(const Order& order) const;
    void keep(const CageResultPtr& result);
    void reconsider();
    bool isUseful(const Job& job) const;
    void choose();

    std::optional<Order> wanted_;
    bool isDragging_ = false;
    bool intermediates_ = false;
    bool skipsPreview_ = false; ///< a drag has ended: what was dragged has been seen
    bool isHalted_ = false;
    std::string error_;
    int madeAhead_ = 0; ///< neighbours of what is wanted, of two
    std::optional<Job> running_;
    bool stop_ = false;
    std::list<CageResultPtr> kept_; ///< the last one first
    std::size_t mostBytes_;
    CageResultPtr shown_;
};

/// The next face count that a step up or down leads to: a twentieth, at least 1. Within the option's range.
int steppedFaces(int faces, int direction, CageFaces mesh);

} // namespace vdbcage::view
