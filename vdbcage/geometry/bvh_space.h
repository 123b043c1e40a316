#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <openvdb/Types.h>

/// The space of a TriangleBvh's nodes.
namespace vdbcage::detail {

using openvdb::Vec3d;

/// The units of nodes, in which the tree's box is [-1, 1] along its longest side.
struct BvhUnits {
    Vec3d centre{0.0};
    double scale = 1;

    /// Returns a point in these units. Monotone in every coordinate.
    Vec3d of(const Vec3d& p) const { return (p - centre) * scale; }
};

/// Orthonormal axes, through the middle of the tree's units.
struct BvhFrame {
    std::array<Vec3d, 3> axes{Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1)};

    Vec3d of(const Vec3d& p) const { return {axes[0].dot(p), axes[1].dot(p), axes[2].dot(p)}; }
};

/// Narrower slivers have no usable plane: one computed from them may point astray by more than 1e-7.
constexpr double leastSineOfPlane = 1e-8;

/// Returns the largest absolute coordinate.
inline double maxAbs(const Vec3d& v)
{
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

} // namespace vdbcage::detail
