#pragma once

#include <array>
#include <variant>
#include <vector>

#include <openvdb/Types.h>

namespace vdbcage::edit {

struct Move {
    openvdb::Vec3d by{0};
};

/// A rotation, counter-clockwise seen against the axis.
struct Rotate {
    openvdb::Vec3d axis{0, 0, 1}; ///< unit
    double degrees = 0;           ///< any
    openvdb::Vec3d pivot{0};
};

/// A scaling along three axes.
struct Scale {
    openvdb::Vec3d factors{1}; ///< any; negative ones mirror
    std::array<openvdb::Vec3d, 3> axes{openvdb::Vec3d(1, 0, 0), openvdb::Vec3d(0, 1, 0),
                                       openvdb::Vec3d(0, 0, 1)}; ///< orthonormal
    openvdb::Vec3d pivot{0};
};

using Motion = std::variant<Move, Rotate, Scale>;

/// Returns the points after a motion, each by its weight in [0, 1]: a point of weight w moves by w * by, turns by w *
/// degrees, or is scaled by 1 + w * (factor - 1).
///
/// Points of weight 0 stay bit for bit, as all points do if nothing turns and all factors are 1. Sine and cosine are
/// exact at multiples of 90 degrees.
/// \throw InputError not one weight for each point; a weight out of range; axes not unit, or not orthogonal, to 1e-6; a
/// number of the motion not finite
/// Cost: O(points).
std::vector<openvdb::Vec3d> moved(const std::vector<openvdb::Vec3d>& points, const std::vector<double>& weights,
                                  const Motion& motion);

} // namespace vdbcage::edit
