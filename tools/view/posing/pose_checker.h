#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/jobs/worker.h>
#include <tools/view/posing/bound_model.h>

namespace vdbcage::view {

/// A pose to check.
struct PoseCheckOrder {
    BindOrder bind;
    std::vector<openvdb::Vec3d> cagePoints; ///< posed
    /// The complete binding, with the material, if triangles that are inside out are to be counted; null: only the cage
    /// is checked.
    std::shared_ptr<const Binding> binding;
};
bool operator==(const PoseCheckOrder& a, const PoseCheckOrder& b);

struct PoseCheck {
    bool isValid = false;              ///< the posed cage alone (see CageCheck::valid)
    std::size_t selfIntersections = 0; ///< of the posed cage
    /// Triangles of the model that the pose turns inside out (see invertedTriangles); none: not counted.
    std::optional<std::vector<std::uint32_t>> inverted;
};
using PoseCheckPtr = std::shared_ptr<const PoseCheck>;

/// A thread that checks poses. Call it from one thread, the owner's. Only waitForNews() waits.
class PoseChecker {
public:
    /// `wake`: see Worker.
    explicit PoseChecker(std::function<void()> wake);

    /// Sets the pose to check; none: nothing. A job for another one is stopped.
    void want(const std::optional<PoseCheckOrder>& order);
    /// Takes the finished result and begins the next job.
    void update();
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);

    /// Returns the result for the wanted pose; null: not yet, or it failed.
    const PoseCheckPtr& result() const { return result_; }
    /// Returns the reason why it failed; empty if it did not.
    const std::string& error() const { return error_; }
    /// Returns whether nothing is left to do for the wanted pose.
    bool isSettled() const { return !wanted_ || result_ || !error_.empty(); }

private:
    Worker<PoseCheckOrder, PoseCheckPtr> worker_;
    std::optional<PoseCheckOrder> wanted_, running_;
    PoseCheckPtr result_;
    std::string error_;
};

} // namespace vdbcage::view
