#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tools/view/jobs/worker.h>
#include <tools/view/state/time_line.h>

namespace vdbcage::view {

/// A thread that carries poses over to newly made cages. Call it from one thread, the owner's. Only waitForNews()
/// waits.
class Carrier {
public:
    /// `wake`: see Worker.
    explicit Carrier(std::function<void()> wake);

    /// Returns `cage` with all poses of a time line. Null: some are being carried over now; a job for another cage or
    /// time line is stopped. Poses that cannot be carried over are at rest; error() says why.
    PosableCagePtr carried(const MeshPtr& cage, const TimeLine& poses);

    /// Takes the finished result. Call carried() again then.
    void update();
    /// Returns whether a job is under way.
    bool isBusy() const { return isRunning_; }
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);
    /// Returns the reason why the last poses could not be carried over; empty: they could.
    const std::string& error() const { return error_; }

private:
    struct Job {
        MeshPtr cage;
        std::vector<PosePtr> poses; ///< made for other cages
    };

    Worker<Job, PosableCagePtr> worker_;
    Job running_;
    bool isRunning_ = false;
    PosableCagePtr ready_; ///< null: none
    std::string error_;
};

} // namespace vdbcage::view
