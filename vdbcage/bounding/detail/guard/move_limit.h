#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

/// The places where a vertex may be.
struct MoveLimit {
    Vec3d home{0.0};                                         ///< where it may be in any case; rounded as the guard asks
    std::array<bool, 3> mayMove{true, true, true};           ///< along each axis, from there
    double radius = std::numeric_limits<double>::infinity(); ///< around it

    bool allows(const Vec3d& p) const
    {
        for (int i = 0; i < 3; ++i) {
            if (!mayMove[static_cast<std::size_t>(i)] && p[i] != home[i]) return false;
        }
        return (p - home).lengthSqr() <= radius * radius;
    }
    /// Returns whether it has to be in a plane, on a line or at a point.
    bool isRail() const { return radius == 0 || !mayMove[0] || !mayMove[1] || !mayMove[2]; }
    /// Returns `p` with the coordinates of home along axes that it may not move.
    Vec3d onRail(Vec3d p) const
    {
        for (int i = 0; i < 3; ++i) {
            if (!mayMove[static_cast<std::size_t>(i)]) p[i] = home[i];
        }
        return p;
    }
    /// Returns an allowed place near to `p`, which stays allowed when its coordinates are rounded.
    Vec3d nearest(Vec3d p) const
    {
        constexpr double rounding = 1e-6; // more than that of floats
        p = onRail(p);
        const Vec3d way = p - home;
        const double length = way.length();
        if (length <= radius - rounding) return p;
        return radius > rounding ? home + (radius - rounding) / length * way : home;
    }
};

using MoveLimits = std::vector<std::optional<MoveLimit>>; ///< by vertex

} // namespace vdbcage::detail
