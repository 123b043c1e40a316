#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <tools/view/jobs/carrier.h>
#include <tools/view/jobs/follower.h>
#include <tools/view/jobs/planner.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// What is to be seen of a state: the cage, where its points are, and where these take the model, by one family of
/// coordinates or by two that are compared.
class Posing {
public:
    /// See Binder.
    Posing(const Binder::Work& work, const std::function<void()>& wake)
        : work_(work), wake_(wake), carrier_(wake), follower_(work, wake)
    {
    }

    /// The cage to show; null: none. One that was opened or moved by hand is there without a verdict until it is
    /// checked. In mode pose it is the one before, while poses are carried over to a new one.
    CageResultPtr cageOf(const State& state, const Planner& planner);
    /// The same to be posed, as of the last cageOf().
    const ShownCage& posable() const { return posable_; }

    /// Follows a state, with the cage of the last cageOf(): binds what is to be posed, and poses it. Until something
    /// new is bound, or carried over, all stays as it was posed before. A pose that stands still is checked.
    /// Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const Planner& planner, bool standsStill);

    /// As of the last follow(): where the cage's points are, and the model.
    const std::vector<openvdb::Vec3d>& cagePoints() const { return *cagePoints_; }
    const Follower& follower() const { return follower_; }
    /// The model by the family that is compared; null: none is.
    const Follower* compared() const { return compared_.get(); }

    /// In mode pose, as of the last follow(): the cage is not at rest.
    bool isPosed(const State& state) const;
    /// In mode pose: the model follows by Somigliana coordinates, or is compared by them, so it has a material.
    bool hasMaterial(const State& state) const;

    /// Takes what was done on other threads, and begins what is next.
    void update();
    /// Nothing that was wanted by the last follow() is left to do.
    bool isSettled() const;
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// See Binder.
    void again();
    void cancel();
    /// Why something could not be done; empty: it could.
    const std::string& error() const;

private:
    CageResultPtr wantedCage(const Document& document, const Planner& planner);

    Binder::Work work_;
    std::function<void()> wake_;
    Carrier carrier_;
    Follower follower_;
    std::unique_ptr<Follower> compared_;
    vdbcage::detail::Memo<OpenedMeshPtr, CageResultPtr> unchecked_; // of the opened cage
    CageResultPtr shown_;
    ShownCage posable_;
    TimeLine poses_; // of the last follow()
    using Points = std::shared_ptr<const std::vector<openvdb::Vec3d>>;
    using PointsKey = std::tuple<TimeLine, ShownCage, Mode, int>; // with the frame
    vdbcage::detail::Memo<PointsKey, Points> pointsMemo_;
    Points cagePoints_ = std::make_shared<const std::vector<openvdb::Vec3d>>();
};

} // namespace vdbcage::view
