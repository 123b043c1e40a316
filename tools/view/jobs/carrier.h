#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <tools/view/jobs/worker.h>
#include <tools/view/state/time_line.h>

namespace vdbcage::view {

/// Carries poses over to cages that are made anew, on a thread of its own. All its functions are for one thread, the
/// owner's, and none of them waits but waitForNews().
class Carrier {
public:
    /// `wake`: see Worker.
    explicit Carrier(std::function<void()> wake);

    /// `cage` with all poses of a time line. Null: some have to be carried over, which is under way now; what was under
    /// way for something else is stopped. Poses that cannot be carried over are at rest; error() says why.
    ShownCage carried(const MeshPtr& cage, const TimeLine& poses);

    /// Takes what has ended. Ask for carried() again then.
    void update();
    /// Something is under way.
    bool isBusy() const { return isRunning_; }
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);
    /// Why the last poses could not be carried over; empty: they could.
    const std::string& error() const { return error_; }

private:
    struct Job {
        MeshPtr cage;
        std::vector<PosePtr> poses; ///< that were made for other cages
    };

    Worker<Job, ShownCage> worker_;
    Job running_;
    bool isRunning_ = false;
    ShownCage ready_; ///< null: nothing
    std::string error_;
};

} // namespace vdbcage::view
