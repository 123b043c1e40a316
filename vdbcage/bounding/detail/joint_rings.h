#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
/// and none is more than twice as wide. On the plane of symmetry half a ring counts with its mirror image. A surface
/// that is not of quads only has no rings.
class JointRings {
public:
    static constexpr std::size_t wanted = 3; ///< across each joint

    /// At the joints that its guard knows. The arguments must outlive this.
    JointRings(const GuardedMesh& surface, const QuadTable& table) : surface_(surface), table_(table) {}

    /// How many rings each joint has now.
    /// Cost: O(quads + joints rungs).
    std::vector<std::size_t> count() const;

    /// Whether each joint has as many rings as before, or as are wanted.
    static bool areKept(const std::vector<std::size_t>& before, const std::vector<std::size_t>& after);

    /// A vertex that is to stay near a plane.
    struct Hold {
        std::uint32_t vertex;
        Vec3d normal;
        double offset, width; ///< normal . place is to be `offset`; a deviation is measured in widths
    };
    /// What holds up to three rings of each joint, by vertex, ascending: without it relaxation would make all rings of
    /// a limb alike.
    std::vector<Hold> holds() const;

    /// A loop that may be split for another ring at a joint; nothing if it has enough, or there is none.
    std::optional<QuadLoop> nextToSplit(const Joint& joint) const;

private:
    /// There are joints, and nothing but quads: the ends of other loops are at the plane of symmetry.
    bool mayHaveRings() const
    {
        return !surface_.guard().joints().empty() && surface_.liveFaces() == 2 * table_.count();
    }

    struct Ring {
        const QuadLoop* loop;
        double height, radius; ///< of its middle over the joint, along the axis; of a circle of its area
        Vec3d axis;            ///< of the limb, the same for all rings of a joint
    };
    /// Those whose planes are within `reach` radii, nearest first.
    std::vector<Ring> ringsAround(const std::vector<QuadLoop>& loops, const Joint& joint, double reach) const;

    const GuardedMesh& surface_;
    const QuadTable& table_;
};

/// Splits loops until each joint has the rings that are wanted, as far as the guard allows.
/// \throw Cancelled
void addRings(GuardedMesh& surface, QuadTable& table, Interrupter* interrupter);

} // namespace vdbcage::detail
