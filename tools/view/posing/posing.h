#pragma once

#include <functional>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <tools/view/jobs/planner.h>
#include <tools/view/posing/carrier.h>
#include <tools/view/posing/follower.h>
#include <vdbcage/core/detail/memo.h>

namespace vdbcage::view {

/// The shown parts of a state: the cage, its points, and the model as these pose it, by one family of coordinates or by
/// two that are compared.
class Posing {
public:
    /// See Binder.
    Posing(const Binder::Work& work, const std::function<void()>& wake)
        : work_(work), wake_(wake), carrier_(wake), follower_(work, wake)
    {
    }

    /// Returns the cage to show; null: none. One that was opened or moved by hand is there without a verdict until it
    /// is checked. In mode pose it is the previous one while poses are carried over to a new one.
    CageResultPtr cageOf(const State& state, const Planner& planner);
    /// Returns the cage of the last cageOf() for posing.
    const PosableCagePtr& posable() const { return posable_; }

    /// Follows a state, with the cage of the last cageOf(): binds the model and poses it. Until a new binding is there,
    /// or poses are carried over, the model stays as it was posed. A pose that stands still is checked.
    /// Cost: as Binding::pose, if the pose is another.
    void follow(const State& state, const Planner& planner, bool standsStill);

    /// Return the cage's points and the model, of the last follow().
    const std::vector<openvdb::Vec3d>& cagePoints() const { return *cagePoints_; }
    const Follower& follower() const { return follower_; }
    /// Returns the model by the compared family; null: none is compared.
    const Follower* compared() const { return compared_.get(); }

    /// Returns whether the cage was not at rest in the last follow(), in mode pose.
    bool isPosed(const State& state) const;
    /// Returns whether the model follows by Somigliana coordinates, or is compared by them, in mode pose: only these
    /// have a material.
    bool hasMaterial(const State& state) const;

    /// Takes the results of other threads, and begins the next jobs.
    void update();
    /// Returns whether all work for the last follow() is done.
    bool isSettled() const;
    /// Waits until there is something to take, or `seconds` have passed. \pre not isSettled()
    void waitForNews(double seconds);
    /// See Binder.
    void again();
    void cancel();
    /// Returns the reason why a job failed; empty: none did.
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
    PosableCagePtr posable_;
    TimeLine poses_; // of the last follow()
    using Points = std::shared_ptr<const std::vector<openvdb::Vec3d>>;
    using PointsKey = std::tuple<TimeLine, PosableCagePtr, Mode, int>; // the int is the frame
    vdbcage::detail::Memo<PointsKey, Points> pointsMemo_;
    Points cagePoints_ = std::make_shared<const std::vector<openvdb::Vec3d>>();
};

} // namespace vdbcage::view
