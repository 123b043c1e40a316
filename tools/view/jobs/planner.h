#pragma once

#include <list>
#include <optional>
#include <string>

#include <tools/view/jobs/cage_result.h>

namespace vdbcage::view {

/// The decision which cage is made next, whether the job under way is still useful, and which of the made cages is
/// offered. It has no thread and no clock: it is told about events, and asked.
///
/// At most one job is under way, and at most one waits, for the wanted cage. While a value is dragged only previews are
/// made. A preview under way is finished, unless it shares no stage with the wanted cage; so is a fit while its
/// tightness is dragged. A full run is stopped as soon as another cage is wanted. When a drag ends the full run begins
/// at once; after any other change its preview comes first. Results are kept by their orders, so a cage that was made
/// once is there at once. When nothing else is to do, previews of the neighbouring face counts are made ahead.
class Planner {
public:
    /// `mostBytes`: the most that kept results take; the oldest go first (two always stay).
    explicit Planner(std::size_t mostBytes = std::size_t{256} << 20) : mostBytes_(mostBytes) {}

    /// Sets the wanted order; none: nothing. The same order again changes nothing. `intermediates`: the full result
    /// must have them.
    void want(const std::optional<Order>& order, bool isDragging, bool intermediates = false);
    /// Stops the present job, and makes nothing until another cage is wanted, or again() is called.
    void cancel();
    /// Makes the wanted cage although it was cancelled or failed.
    void again();

    /// Returns the next job, which is under way from then on. None while another one is.
    std::optional<Job> start();
    /// Returns whether the job under way must stop.
    bool shouldStop() const { return running_ && stop_; }
    /// Report the end of the job under way. \pre there is one
    void finished(CageResultPtr result);
    void failed(const std::string& error);
    void stopped();

    const std::optional<Job>& running() const { return running_; }
    /// Returns whether nothing is under way or to be done, except for jobs made ahead.
    bool isSettled() const;
    /// Returns whether the wanted cage was cancelled, or failed.
    bool isHalted() const { return isHalted_; }
    /// Returns the reason why the wanted cage failed; empty if it did not.
    const std::string& error() const { return error_; }

    enum class Standing {
        none,    ///< there is no cage
        current, ///< it is the wanted one
        preview, ///< it is the preview of the wanted one
        stale    ///< it was made with other options, for the same model
    };
    /// Returns the offered one of the made cages, with its own options: the wanted one, or else its preview, or else a
    /// cage of other options for the same model; null if there is none.
    const CageResultPtr& made() const { return made_; }
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
    bool skipsPreview_ = false; ///< a drag has ended: its last value has been previewed
    bool isHalted_ = false;
    std::string error_;
    int madeAhead_ = 0; ///< neighbours of the wanted cage, of two
    std::optional<Job> running_;
    bool stop_ = false;
    std::list<CageResultPtr> kept_; ///< the last one first
    std::size_t mostBytes_;
    CageResultPtr made_;
};

/// Returns the face count of a step up or down: a twentieth, at least 1. Within the option's range.
int steppedFaces(int faces, int direction, CageFaces mesh);

} // namespace vdbcage::view
