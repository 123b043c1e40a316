#pragma once

#include <vdbcage/bounding/joints.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// The part of a model that bends at a joint.
struct Limb {
    Vec3d place;   ///< of the joint
    Vec3d axis;    ///< of length 1
    double radius; ///< of the model across the axis: the median of the distances from the joint to it
};

/// Returns the limb of a model at a joint. Where the joint has no axis, the limb's is the one with the least radius.
/// Cost: O(log n) for n triangles, some thousand times.
Limb limbAt(const TriangleBvh& model, const Joint& joint);

} // namespace vdbcage::detail
