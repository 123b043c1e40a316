#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <boost/container/small_vector.hpp>
#include <vdbcage/geometry/triangle.h>

/// Tests of how the triangles of one surface touch each other, decided exactly.
namespace vdbcage::detail {

/// The spacing that two triangles of a surface must keep. Tools that take cages, above all mesh generators, fail at
/// large triangles that nearly touch. Small ones are always near some others.
struct Spacing {
    double distance = 0; ///< between any two without a common corner, or `share` of the longest edge, if that is less
    double share = 0;    ///< of the smaller triangle's longest edge
    double sine = 0;     ///< of the angle between two with a common corner, less than 30 degrees

    /// Returns the distance that a triangle keeps from larger ones.
    double around(double longestEdge) const { return std::min(distance, share * longestEdge); }
};

/// The plane of a triangle, for tests of sides without exact arithmetic where that is safe.
class Plane {
public:
    explicit Plane(const Corners& t) : corner_(t[0])
    {
        const Vec3d u = t[1] - t[0], v = t[2] - t[0];
        normal_ = u.cross(v);
        length2_ = normal_.lengthSqr();
        error2_ = 1e-28 * u.lengthSqr() * v.lengthSqr();
    }
    /// Returns the side on which p lies: -1, 0 or 1. It is 0 where rounding could decide, or where p is nearer to the
    /// plane than `distance`.
    int side(const Vec3d& p, double distance) const
    {
        const Vec3d w = p - corner_;
        return side(w, normal_.dot(w), length2_ * distance * distance);
    }
    /// Returns the same, seen from a corner of the triangle at `from`: 0 where the sine of the angle with the plane is
    /// less than `sine`.
    int sideSeenFrom(const Vec3d& from, const Vec3d& p, double sine) const
    {
        const Vec3d w = p - from;
        return side(w, normal_.dot(w), length2_ * sine * sine * w.lengthSqr());
    }

    /// Returns the normal; its length is twice the area.
    const Vec3d& normal() const { return normal_; }

private:
    int side(const Vec3d& w, double volume, double least2) const
    {
        if (!(volume * volume > least2 + error2_ * w.lengthSqr())) return 0;
        return volume > 0 ? 1 : -1;
    }

    Vec3d corner_, normal_;
    double length2_, error2_;
};

/// A triangle of a surface.
struct SurfaceTriangle {
    Vec3I ids;
    Corners corners;
    Plane plane;

    SurfaceTriangle(const Vec3I& vertices, const Corners& places) : ids(vertices), corners(places), plane(places) {}
    const Vec3d& corner(int i) const { return corners[static_cast<std::size_t>(i % 3)]; }
    double longestEdge() const
    {
        return std::sqrt(std::max({(corners[1] - corners[0]).lengthSqr(), (corners[2] - corners[1]).lengthSqr(),
                                   (corners[0] - corners[2]).lengthSqr()}));
    }
};

using SurfaceTriangles = boost::container::small_vector<SurfaceTriangle, 16>;

/// Returns whether a triangle has no area, exactly.
bool hasNoArea(const Corners& t);

/// Returns the sine of the smallest angle of a triangle; rounded. It is 0 for one without an area.
double minSine(const Corners& t);

/// Returns the distance that two triangles without a common corner must keep.
inline double distanceBetween(const SurfaceTriangle& a, const SurfaceTriangle& b, const Spacing& spacing)
{
    return spacing.around(std::min(a.longestEdge(), b.longestEdge()));
}

/// Returns whether two triangles of a surface come nearer than they may, or meet in more than the corners that they
/// share. Rounded, but it never misses that they meet.
bool tooNear(const SurfaceTriangle& a, const SurfaceTriangle& b, const Spacing& spacing);

/// Returns whether, seen along some direction, a star is spread out around its centre, without overlap and without
/// steep triangles. The centre is corner 0 of all triangles.
///
/// If so, no two triangles are too near, provided that no angle has a sine less than `leastSine`. The result is false
/// where rounding could matter.
bool spreadOut(const SurfaceTriangles& star, const Spacing& spacing, double leastSine);

} // namespace vdbcage::detail
