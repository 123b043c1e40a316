#pragma once

#include <memory>
#include <vector>

#include <tools/view/state/bound_model.h>

namespace vdbcage::view {

/// A posed cage. It never changes. It stays with the cage at rest that it was made for, so it can be carried over to
/// any other (see edit::carriedPose).
struct Pose {
    MeshPtr rest;                       ///< not null
    std::vector<openvdb::Vec3d> points; ///< of the cage: one for each of rest's
};
using PosePtr = std::shared_ptr<const Pose>;

bool areEqual(const PosePtr& a, const PosePtr& b);

/// The points of `cage` in a pose that may have been made for another cage; null: at rest.
/// Cost: as edit::carriedPose where it was, else a copy.
std::vector<openvdb::Vec3d> posedPoints(const PosePtr& pose, const MeshPtr& cage);

} // namespace vdbcage::view
