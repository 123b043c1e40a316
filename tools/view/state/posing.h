#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <tools/view/state/binder.h>
#include <tools/view/state/carrier.h>
#include <tools/view/state/planner.h>
#include <tools/view/state/pose_checker.h>
#include <tools/view/state/posed_model.h>
#include <tools/view/state/state.h>

namespace vdbcage::view {

/// What is to be seen of a state: the cage, where its points are, and where these take the model.
class Posing {
public:
    /// See Binder.
    Posing(Binder::Work work, const std::function<void()>& wake)
        : binder_(std::move(work), wake), carrier_(wake), checker_(wake)
    {
    }

    /// The cage to show; null: none. One that was opened or moved by hand is there without a verdict until it is
    /// checked. In mode pose it is the one before, while poses are carried over to a new one.
    CageResultPtr cageOf(const State& state, const Planner& planner);
    /// Poses for that cage, as of the last cageOf(); null without a cage.
    const std::shared_ptr<CarriedPoses>& carried() const { return carried_; }

    /// Follows a state, whose cage is that of cageOf(): binds what is to be posed, and poses it. Until something new is
    /// bound, or carried over, all stays as it was posed before. A pose that stands still is checked.
    /// Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const Planner& planner, bool standsStill);

    /// As of the last follow(): where the cage's points are, and the model.
    const std::vector<openvdb::Vec3d>& cagePoints() const { return cagePoints_; }
    const PosedModel& model() const { return model_; }
    /// What the model's colours tell, a value for each of its points; null: nothing. Another one is another object.
    const std::shared_ptr<const std::vector<double>>& modelValues() const { return values_; }

    /// The verdict on the pose; null: it is at rest, or not checked yet.
    const PoseCheckPtr& check() const { return checker_.result(); }

    /// Takes what was done on other threads, and begins what is next.
    void update();
    /// Nothing that was wanted by the last follow() is left to do.
    bool isSettled() const { return !carrier_.isBusy() && binder_.isSettled() && checker_.isSettled(); }
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// Why something could not be done; empty: it could.
    std::string error() const;

    /// The whole binding of a state's model to its cage; null: it is not there yet.
    std::shared_ptr<const Binding> bindingOf(const State& state) const;

    Binder& binder() { return binder_; }
    const Binder& binder() const { return binder_; }

private:
    void followValues(const State& state);
    void followCheck(const State& state, bool standsStill);

    bool isCarried(const TimeLine& poses) const;
    CageResultPtr wantedCage(const Document& document, const Planner& planner);

    Binder binder_;
    Carrier carrier_;
    PoseChecker checker_;
    CageResultPtr unchecked_, shown_;
    std::shared_ptr<CarriedPoses> carried_;
    std::vector<openvdb::Vec3d> cagePoints_;
    // What cagePoints_ were made of.
    TimeLine poses_;
    MeshPtr cage_;
    Mode mode_ = Mode::shape;
    int frame_ = 0;
    PosedModel model_;
    std::shared_ptr<const std::vector<double>> values_;
    // What they were made of.
    ModelColours valuesOf_ = ModelColours::plain;
    BoundModelPtr valuesBound_;
    std::vector<openvdb::Index32> valuesPoints_;
    std::uint64_t valuesVersion_ = 0;
    PoseCheckPtr valuesCheck_;
};

} // namespace vdbcage::view
