#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <tools/view/jobs/binder.h>
#include <tools/view/jobs/pose_checker.h>
#include <tools/view/jobs/posed_model.h>
#include <tools/view/state/state.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// The model as it follows the cage by one family of coordinates: its binding, where its points are, what its colours
/// tell, and the verdict on the pose.
class Follower {
public:
    /// See Binder.
    Follower(Binder::Work work, const std::function<void()>& wake) : binder_(std::move(work), wake), checker_(wake) {}

    /// When to do how much.
    struct Effort {
        bool isPosing = false;    ///< there is something that follows, and a cage
        bool isToStay = false;    ///< the cage is not gone in a moment: it is worth binding
        bool standsStill = false; ///< the pose is worth checking
    };
    /// Follows a state whose cage has its points at `cagePoints`. Until something new is bound all stays as it was
    /// posed. Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const MeshPtr& cage, const std::vector<openvdb::Vec3d>& cagePoints,
                const Effort& effort);

    const PosedModel& model() const { return model_; }
    /// What the model's colours tell, a value for each of its points; null: nothing. Another one is another object.
    const std::shared_ptr<const std::vector<double>>& values() const { return values_; }
    /// The verdict on the pose; null: it is at rest, or not checked yet.
    const PoseCheckPtr& check() const { return checker_.result(); }
    /// The pose is being checked.
    bool isChecking() const { return !checker_.isSettled(); }
    /// What is bound of the state of the last follow(), with its material; null: nothing yet.
    const BoundModelPtr& bound() const { return bound_; }
    /// The whole binding, with the material of the last follow(); null: it is not there yet.
    std::shared_ptr<const Binding> bindingOf(const BindOrder& order) const;

    /// Takes what was done on other threads, and begins what is next.
    void update();
    /// Nothing that was wanted by the last follow() is left to do.
    bool isSettled() const { return binder_.isSettled() && checker_.isSettled(); }
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// Why something could not be done; empty: it could.
    const std::string& error() const { return binder_.error().empty() ? checker_.error() : binder_.error(); }

    Binder& binder() { return binder_; }
    const Binder& binder() const { return binder_; }

private:
    void followCheck(const State& state, const MeshPtr& cage, const std::vector<openvdb::Vec3d>& cagePoints,
                     bool standsStill);
    void followValues(const State& state, const MeshPtr& cage);

    Binder binder_;
    vdbcage::detail::Memo<std::pair<BoundModelPtr, Elasticity>, BoundModelPtr> withMaterial_;
    BoundModelPtr bound_;
    PoseChecker checker_;
    PosedModel model_;
    using Values = std::shared_ptr<const std::vector<double>>;
    /// The binding, the selected points, the version of the posed model, and the verdict: each only where it counts.
    using ValuesKey =
        std::tuple<ModelColours, BoundModelPtr, std::vector<openvdb::Index32>, std::uint64_t, PoseCheckPtr>;
    vdbcage::detail::Memo<ValuesKey, Values> valuesMemo_;
    Values values_;
    ModelColours valuesOf_ = ModelColours::plain;
};

} // namespace vdbcage::view
