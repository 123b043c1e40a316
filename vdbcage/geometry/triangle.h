#pragma once

#include <algorithm>
#include <array>

#include <openvdb/Types.h>

/// Triangles in space, and boxes around them.
namespace vdbcage::detail {

using openvdb::Vec3d;
using openvdb::Vec3I;

/// The three corners of a triangle.
using Corners = std::array<Vec3d, 3>;

/// A closed box: a point on its side belongs to it. Not initialized by default.
struct Box {
    Vec3d lo, hi;

    static Box of(const Vec3d& p) { return {p, p}; }
    static Box of(const Corners& t);
    void expand(const Box& other);
    bool meets(const Box& other) const
    {
        return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] && other.lo[1] <= hi[1] &&
               lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
    }
    /// Returns the squared distance from p, 0 inside; rounded.
    double squaredDistance(const Vec3d& p) const
    {
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const double d = std::max(std::max(lo[i] - p[i], p[i] - hi[i]), 0.0);
            sum += d * d;
        }
        return sum;
    }
};

/// Returns the point of the closed triangle nearest to `p`; rounded. The triangle may be degenerate.
Vec3d closestPointOnTriangle(const Vec3d& p, const Corners& triangle);

/// Returns the weights of a triangle's corners for the foot of `p` in its plane; zeros for a degenerate triangle.
Vec3d barycentric(const Vec3d& p, const Corners& triangle);

} // namespace vdbcage::detail
