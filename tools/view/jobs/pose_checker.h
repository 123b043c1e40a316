#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/jobs/worker.h>
#include <tools/view/state/bound_model.h>

namespace vdbcage::view {

/// A pose that is to be checked.
struct PoseCheckOrder {
    BindOrder bind;
    std::vector<openvdb::Vec3d> cagePoints; ///< posed
    /// The whole binding, with the material, where triangles that are inside out are to be counted; null: only the cage
    /// is checked.
    std::shared_ptr<const Binding> binding;
};
bool operator==(const PoseCheckOrder& a, const PoseCheckOrder& b);

struct PoseCheck {
    bool isValid = false;              ///< the posed cage, by itself (see CageCheck::valid)
    std::size_t selfIntersections = 0; ///< of the posed cage
    /// Triangles of the model that the pose turns inside out (see invertedTriangles); none: they were not counted.
    std::optional<std::vector<std::uint32_t>> inverted;
};
using PoseCheckPtr = std::shared_ptr<const PoseCheck>;

/// Checks poses on a thread of its own. All its functions are for one thread, the owner's, and none of them waits but
/// waitForNews().
class PoseChecker {
public:
    /// `wake`: see Worker.
    explicit PoseChecker(std::function<void()> wake);

    /// What is to be checked now; none: nothing. What is under way for something else is stopped.
    void want(const std::optional<PoseCheckOrder>& order);
    /// Takes what has ended and begins what is next.
    void update();
    /// Waits until there is something to take, or `seconds` have passed. Returns at once if nothing is under way.
    void waitForNews(double seconds);

    /// Of what is wanted; null: not yet, or it failed.
    const PoseCheckPtr& result() const { return result_; }
    /// Why it failed; empty if it did not.
    const std::string& error() const { return error_; }
    /// Nothing of what is wanted is left to do.
    bool isSettled() const { return !wanted_ || result_ || !error_.empty(); }

private:
    Worker<PoseCheckOrder, PoseCheckPtr> worker_;
    std::optional<PoseCheckOrder> wanted_, running_;
    PoseCheckPtr result_;
    std::string error_;
};

} // namespace vdbcage::view
