#pragma once

#include <array>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/bounding/detail/quads/quad_table.h>

namespace vdbcage::detail {

/// Weights of a quad's shape, added to the integral of the distance.
struct ShapeWeights {
    double corners;   ///< of a corner with a cosine of 1, squared
    double free;      ///< up to this |cos| a corner costs nothing, so that distance is spent on bad corners only
    double bad;       ///< an added weight of corners beyond a |cos| of 0.6
    double flat;      ///< of diagonals that pass each other at half a side's length, squared
    double unfit;     ///< of a quad that cannot bound under both diagonals, wherever the model is
    double hold = 10; ///< of a vertex of a joint's ring that is a limb's radius away from its plane, squared
};

/// A vertex that is to stay near a plane.
struct PlaneHold {
    std::uint32_t vertex;
    Vec3d normal;
    double offset, width; ///< normal . place should be `offset`; a deviation is measured in widths
};

/// Returns whether a quad is convex, folded no more than the surface allows, and split either way has only angles that
/// the guard allows, of at least 5 degrees.
bool isFit(const GuardedMesh& surface, const std::array<Vec3d, 4>& corners);

/// The deviation of quads from flat ones with square corners, as a term added to the integral of the distance.
class QuadShapeTerm final : public ShapeTerm {
public:
    /// `table` must outlive this.
    QuadShapeTerm(const QuadTable& table, const ShapeWeights& weights, std::vector<PlaneHold> holds = {})
        : table_(table), weights_(weights), holds_(std::move(holds))
    {
    }

    double add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
               Quadratic& change) const override;
    bool keepsFit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre) const override;
    /// Returns the term of one quad.
    double of(const GuardedMesh& surface, std::uint32_t quad) const;

private:
    const QuadTable& table_;
    ShapeWeights weights_;
    std::vector<PlaneHold> holds_;
};

/// The deviation of the corners of all quads from square, in degrees.
struct CornerAngles {
    double mean = 0, mostOf95 = 0; ///< the mean, and the 95th percentile
};
CornerAngles cornerAngles(const GuardedMesh& surface, const QuadTable& table);

} // namespace vdbcage::detail
