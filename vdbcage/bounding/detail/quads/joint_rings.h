#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/bounding/detail/guard/limb.h>
#include <vdbcage/bounding/detail/quads/quad_loop.h>
#include <vdbcage/bounding/detail/quads/quad_shape_term.h>

namespace vdbcage::detail {

/// The loops of quads that are rings around a limb at its joints.
///
/// A ring is a closed loop that goes around the joint once, seen along the loop's normal. The normal is within 60
/// degrees of the limb's axis, the ring at most twice as wide as the limb, and its plane at most the limb's radius away
/// from the joint. Widths are of circles of the same area. On the plane of symmetry half a ring counts with its mirror
/// image. A surface has rings only if all its faces are quads.
class JointRings {
public:
    static constexpr std::size_t wanted = 3; ///< across each joint

    /// Uses the joints of the surface's wishes. The arguments must outlive this.
    JointRings(const GuardedMesh& surface, const QuadTable& table) : surface_(surface), table_(table) {}

    /// Returns the number of rings that each joint has.
    /// Cost: O(quads + joints rungs).
    std::vector<std::size_t> count() const;

    /// Returns whether each joint has as many rings as before, or as are wanted.
    static bool areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after);

    /// Returns holds that bring the nearest three rings of each joint to it, by vertex, ascending. Otherwise relaxation
    /// would make all rings of a limb alike.
    std::vector<PlaneHold> holds() const;

    /// Returns loops that may be split for another ring at a joint, nearest first; none if it has enough.
    std::vector<QuadLoop> toSplit(const Limb& limb) const;

private:
    /// Returns whether there are joints, and only quads: loops then end nowhere but at the plane of symmetry.
    bool mayHaveRings() const
    {
        return !surface_.wishes().limbs().empty() && surface_.liveFaces() == 2 * table_.count();
    }

    struct Ring {
        const QuadLoop* loop;
        double height; ///< of its middle over the joint, along the axis of the limb
    };
    /// Returns the rings, nearest first, with planes at most `radii` radii of the limb away.
    std::vector<Ring> ringsAround(const std::vector<QuadLoop>& loops, const Limb& limb, double radii) const;

    const GuardedMesh& surface_;
    const QuadTable& table_;
};

} // namespace vdbcage::detail
