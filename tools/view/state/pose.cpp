#include <tools/view/state/pose.h>

#include <utility>

#include <tools/edit/carry.h>

namespace vdbcage::view {

bool areEqual(const PosePtr& a, const PosePtr& b)
{
    return a == b || (a && b && a->rest == b->rest && a->points == b->points);
}

PosePtr poseOf(const MeshPtr& cage, std::vector<openvdb::Vec3d> points)
{
    return points == cage->points ? nullptr : std::make_shared<const Pose>(Pose{cage, std::move(points)});
}

bool PosableCage::has(const PosePtr& pose) const
{
    return !pose || pose->rest == rest_ || carried_.count(pose) > 0;
}

void PosableCage::carry(const std::vector<PosePtr>& poses, Interrupter* interrupter)
{
    // Poses of one cage are carried over together, by the same weights.
    std::map<MeshPtr, std::vector<PosePtr>> byRest;
    for (const PosePtr& pose : poses) {
        if (!has(pose)) byRest[pose->rest].push_back(pose);
    }
    for (const auto& [rest, some] : byRest) {
        std::vector<std::vector<openvdb::Vec3d>> posed;
        for (const PosePtr& pose : some) posed.push_back(pose->points);
        auto carried = edit::carriedPoses(*rest, posed, *rest_, interrupter);
        for (std::size_t i = 0; i < some.size(); ++i) carried_[some[i]] = std::move(carried[i]);
    }
}

void PosableCage::giveUp(const std::vector<PosePtr>& poses)
{
    for (const PosePtr& pose : poses) {
        if (has(pose)) continue;
        carried_[pose] = rest_->points;
        givenUp_.insert(pose);
    }
}

const std::vector<openvdb::Vec3d>& PosableCage::points(const PosePtr& pose)
{
    if (!pose) return rest_->points;
    if (pose->rest == rest_) return pose->points;
    carry({pose}, nullptr);
    return carried_.at(pose);
}

} // namespace vdbcage::view
