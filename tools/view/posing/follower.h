#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <tools/view/jobs/model_values.h>
#include <tools/view/posing/binder.h>
#include <tools/view/posing/pose_checker.h>
#include <tools/view/posing/posed_model.h>
#include <tools/view/state/state.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// The model following the cage by one family of coordinates: its binding, its points, the values for its colours, and
/// the verdict on the pose.
class Follower {
public:
    /// See Binder.
    Follower(Binder::Work work, const std::function<void()>& wake) : binder_(std::move(work), wake), checker_(wake) {}

    /// The conditions that decide how much is computed.
    struct Conditions {
        bool isPosing = false;    ///< there are a model and a cage, in mode pose
        bool isToStay = false;    ///< the cage stays for longer than a moment, so binding is worthwhile
        bool standsStill = false; ///< the pose is worth checking
    };
    /// Follows a state whose cage has its points at `cagePoints`. Until a new binding is there the model stays as it
    /// was posed. Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const MeshPtr& cage, const std::vector<openvdb::Vec3d>& cagePoints,
                const Conditions& conditions);

    const PosedModel& model() const { return model_; }
    /// Returns the values that the model's colours show, one for each point; null: none. Other values are another
    /// object.
    const ModelValues& values() const { return values_; }
    /// Returns the verdict on the pose; null: it is at rest, or not checked yet.
    const PoseCheckPtr& check() const { return checker_.result(); }
    /// Returns whether the pose is being checked.
    bool isChecking() const { return !checker_.isSettled(); }
    /// Returns the binding for the state of the last follow(), with its material; null: nothing yet.
    const BoundModelPtr& bound() const { return bound_; }
    /// Returns the complete binding, with the material of the last follow(); null: it is not there yet.
    std::shared_ptr<const Binding> bindingIfReady(const BindOrder& order) const;

    /// Takes the results of other threads, and begins the next jobs.
    void update();
    /// Returns whether all work for the last follow() is done.
    bool isSettled() const { return binder_.isSettled() && checker_.isSettled(); }
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// Returns the reason why a job failed; empty: none did.
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
    /// The binding, the selected points, the version of the posed model, and the verdict: each only where the values
    /// depend on it.
    using ValuesKey =
        std::tuple<ModelColours, BoundModelPtr, std::vector<openvdb::Index32>, std::uint64_t, PoseCheckPtr>;
    vdbcage::detail::Memo<ValuesKey, ModelValues> valuesMemo_;
    ModelValues values_;
    ModelColours valuesOf_ = ModelColours::plain;
};

} // namespace vdbcage::view
