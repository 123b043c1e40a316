#pragma once

#include <vdbcage/bounding/detail/quad_table.h>
#include <vdbcage/bounding/detail/vertex_placement.h>

namespace vdbcage::detail {

/// How far the corners of quads are from square, as a term beside the integral of the distance.
///
/// It is the sum over the corners of weight * max(0, |cos| - free)^2: up to `free` a corner costs nothing, so that
/// distance is spent on bad corners only.
class CornerShape {
public:
    /// `table` must outlive this.
    CornerShape(const QuadTable& table, double weight, double free) : table_(table), weight_(weight), free_(free) {}

    /// The sum over the corners that change when the star's centre moves, with the centre at `centre`. How it changes
    /// is added to `change` (Gauss-Newton).
    double add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre, Quadratic& change) const;

private:
    const QuadTable& table_;
    double weight_, free_;
};

/// How far the corners of all quads are from square, in degrees.
struct CornerAngles {
    double mean = 0, mostOf95 = 0; ///< the mean, and the 95th percentile
};
CornerAngles cornerAngles(const GuardedMesh& surface, const QuadTable& table);

} // namespace vdbcage::detail
