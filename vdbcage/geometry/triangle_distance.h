#pragma once

#include <algorithm>

#include <vdbcage/geometry/triangle.h>

/// Distances between triangles, in rounded arithmetic with stated errors.
namespace vdbcage::detail {

/// The nearest points of two triangles.
struct Nearness {
    Vec3d onFirst, onSecond;
    double squaredDistance = 0; ///< 0 if they cross; then the points mean nothing
};

/// Returns the nearest points of two closed triangles, either of which may be degenerate. Rounded: the error of the
/// distance is a few units of 2^-52 of their sizes, far below any clearance.
Nearness nearness(const Corners& first, const Corners& second);

/// Returns whether two triangles come nearer than `distance`. It is as exact as nearness(), but faster where a pair of
/// planes along edges decides. It does not try the planes of the triangles; the caller, who may have them, should.
bool comeWithin(const Corners& first, const Corners& second, double distance);

/// Returns the nearest points of two segments.
Nearness segmentNearness(const Vec3d& p1, const Vec3d& q1, const Vec3d& p2, const Vec3d& q2);

/// The cross product of u and v, to measure distances between two sets of points along it.
class Axis {
public:
    Axis(const Vec3d& u, const Vec3d& v)
        : direction_(u.cross(v)), length2_(direction_.lengthSqr()), product2_(u.lengthSqr() * v.lengthSqr())
    {
    }
    double along(const Vec3d& p) const { return direction_.dot(p); }
    /// Returns whether a gap is certainly wider than `distance`. The gap is computed from vectors no longer than the
    /// root of `size2`.
    bool isWider(double gap, double distance, double size2) const
    {
        // The error is below 1e-14 |u| |v| size; (r + e)^2 < 1.001 r^2 + 1001 e^2.
        return gap > 0 && gap * gap > 1.001 * length2_ * distance * distance + 2e-25 * product2_ * size2;
    }

private:
    Vec3d direction_;
    double length2_, product2_;
};

/// The plane of a triangle, for a quick test that another triangle is far on one side of it.
class Separator {
public:
    explicit Separator(const Corners& t)
        : corner_(t[0]), normal_(t[1] - t[0], t[2] - t[0]),
          size2_(std::max((t[1] - t[0]).lengthSqr(), (t[2] - t[0]).lengthSqr()))
    {
    }
    /// Returns whether all corners of `other` certainly lie on one side, farther than `distance`.
    bool separates(const Corners& other, double distance) const
    {
        const Vec3d u = other[0] - corner_, v = other[1] - corner_, w = other[2] - corner_;
        const double a = normal_.along(u), b = normal_.along(v), c = normal_.along(w);
        const double height = std::max(std::min({a, b, c}), -std::max({a, b, c}));
        return normal_.isWider(height, distance, size2_ + std::max({u.lengthSqr(), v.lengthSqr(), w.lengthSqr()}));
    }

private:
    Vec3d corner_;
    Axis normal_;
    double size2_;
};

} // namespace vdbcage::detail
