#include <tools/view/posing/posed_model.h>

namespace vdbcage::view {

bool PosedModel::update(const BoundModelPtr& bound, const std::vector<openvdb::Vec3d>& cagePoints)
{
    if (bound == bound_ && (!bound || cagePoints == cagePoints_)) return false;
    bound_ = bound;
    cagePoints_ = cagePoints;
    ++version_;
    if (!bound) {
        points_.clear();
    } else if (bound->whole) {
        points_ = bound->whole->pose(cagePoints);
    } else {
        points_ = posedStandIn(*bound->standIn, bound->order.model->mesh, bound->coarse->pose(cagePoints));
    }
    return true;
}

} // namespace vdbcage::view
