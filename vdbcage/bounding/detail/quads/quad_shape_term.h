#pragma once

#include <array>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/bounding/detail/loops/joint_rings.h>
#include <vdbcage/bounding/detail/quads/quad_table.h>

namespace vdbcage::detail {

/// What a quad's shape may cost beside the integral of the distance.
struct ShapeWeights {
    double corners;   ///< of a corner with a cosine of 1, squared
    double free;      ///< up to this |cos| a corner costs nothing, so that distance is spent on bad corners only
    double bad;       ///< the same again of corners beyond a |cos| of 0.6
    double flat;      ///< of diagonals that pass each other at half a side's length, squared
    double unfit;     ///< of a quad that cannot bound under both diagonals, wherever the model is
    double hold = 10; ///< of a vertex of a joint's ring that is a limb's radius away from its plane, squared
};

/// Whether a quad is convex, folded no more than the surface allows, and both its splits have only angles that the
/// guard allows, of at least 5 degrees.
bool isFit(const GuardedMesh& surface, const std::array<Vec3d, 4>& corners);

/// How far quads are from flat ones with square corners, as a term beside the integral of the distance.
class QuadShapeTerm {
public:
    /// `table` must outlive this.
    QuadShapeTerm(const QuadTable& table, const ShapeWeights& weights, std::vector<JointRings::Hold> holds = {})
        : table_(table), weights_(weights), holds_(std::move(holds))
    {
    }

    /// The sum over what changes when the star's centre moves, with the centre at `centre`. How it changes
    /// is added to `change` (Gauss-Newton).
    double add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre, Quadratic& change) const;
    /// What it is for one quad.
    double of(const GuardedMesh& surface, std::uint32_t quad) const;
    /// Whether quads that are fit stay so when the star's centre moves there.
    bool keepsFit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre) const;

private:
    const QuadTable& table_;
    ShapeWeights weights_;
    std::vector<JointRings::Hold> holds_;
};

/// How far the corners of all quads are from square, in degrees.
struct CornerAngles {
    double mean = 0, mostOf95 = 0; ///< the mean, and the 95th percentile
};
CornerAngles cornerAngles(const GuardedMesh& surface, const QuadTable& table);

} // namespace vdbcage::detail
