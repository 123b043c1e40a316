#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/bounding/detail/quad_loop.h>
#include <vdbcage/bounding/joints.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Which loops of quads are rings around a limb at its joints.
///
/// A ring is a loop that closes, is short, and goes around the joint once, seen along its normal. Its plane comes as
/// near to the joint as it is wide (the radius of a circle of the same area). The shortest loop that goes around the
/// joint tells the direction of the limb, if no axis is given: the normals of all rings are within 60 degrees of it,
/// and none is more than twice as wide. On the plane of symmetry half a ring counts with its mirror image.
class JointRings {
public:
    static constexpr std::size_t wanted = 3; ///< across each joint

    JointRings(const std::vector<Joint>& joints, const GuardModel& guard);

    bool empty() const { return joints_.empty(); }

    /// How many rings each joint has. `reach` is how far planes may be from it, in parts of the ring's radius.
    /// Cost: O(quads + loops joints).
    std::vector<std::size_t> count(const GuardedMesh& surface, const QuadTable& table, double reach = 1) const;

    /// Whether each joint has as many rings as before, or as are wanted.
    static bool areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after);

    /// The loop next to the `joint`-th joint that may be split for another ring there; null if it has enough, or there
    /// is none.
    const QuadLoop* nextToSplit(const GuardedMesh& surface, const QuadTable& table, const std::vector<QuadLoop>& loops,
                                std::size_t joint) const;

    std::size_t joints() const { return joints_.size(); }

private:
    struct Ring {
        const QuadLoop* loop;
        double height, radius; ///< of the joint over its plane, without sign
    };
    std::vector<Ring> ringsAround(const GuardedMesh& surface, const QuadTable& table,
                                  const std::vector<QuadLoop>& loops, const Joint& joint, double reach) const;

    std::vector<Joint> joints_; // in the guard's units, beyond the plane of symmetry; axes of length 1
};

/// Splits loops until each joint has the rings that are wanted, as far as the guard allows.
/// \throw Cancelled
void addRings(GuardedMesh& surface, QuadTable& table, const JointRings& rings, Interrupter* interrupter);

} // namespace vdbcage::detail
