#include <tools/view/state/pose.h>

#include <tools/edit/carry.h>

namespace vdbcage::view {

bool areEqual(const PosePtr& a, const PosePtr& b)
{
    return a == b || (a && b && a->rest == b->rest && a->points == b->points);
}

std::vector<openvdb::Vec3d> posedPoints(const PosePtr& pose, const MeshPtr& cage)
{
    if (!pose) return cage->points;
    if (pose->rest == cage) return pose->points;
    return edit::carriedPose(*pose->rest, pose->points, *cage);
}

} // namespace vdbcage::view
