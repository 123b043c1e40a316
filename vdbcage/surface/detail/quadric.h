#pragma once

#include <algorithm>
#include <cmath>

#include <openvdb/math/Mat3.h>
#include <openvdb/math/Vec3.h>

namespace vdbcage::detail {

/// What merging points into one place costs: the integral of the squared distance to the planes of the faces around
/// them, and the spread, the integral of the squared distance to where their area was.
///
/// The planes say where the surface is, the spread says nothing about it; but on flat ground, where the planes do not
/// care, the spread alone makes the places even. It comes in by a small weight in the cost, and in the choice of the
/// place only in directions that the planes leave open: a corner of a box stays where it is.
class Quadric {
public:
    /// `unitNormal`, `point`: the plane; `weight`: its area.
    void addPlane(const openvdb::Vec3d& unitNormal, const openvdb::Vec3d& point, double weight)
    {
        const openvdb::Vec3d& n = unitNormal;
        const double d = -n.dot(point);
        xx_ += weight * n.x() * n.x();
        xy_ += weight * n.x() * n.y();
        xz_ += weight * n.x() * n.z();
        yy_ += weight * n.y() * n.y();
        yz_ += weight * n.y() * n.z();
        zz_ += weight * n.z() * n.z();
        linear_ += n * (weight * d);
        constant_ += weight * d * d;
    }

    void addSpread(const openvdb::Vec3d& point, double weight)
    {
        weight_ += weight;
        first_ += point * weight;
        second_ += weight * point.lengthSqr();
    }

    Quadric& operator+=(const Quadric& other)
    {
        xx_ += other.xx_;
        xy_ += other.xy_;
        xz_ += other.xz_;
        yy_ += other.yy_;
        yz_ += other.yz_;
        zz_ += other.zz_;
        linear_ += other.linear_;
        constant_ += other.constant_;
        weight_ += other.weight_;
        first_ += other.first_;
        second_ += other.second_;
        return *this;
    }

    /// Becomes the mean of itself and its mirror image in the plane through the origin across `axis` (0 to 2): of the
    /// places in that plane, each costs as much as before.
    void symmetrize(int axis)
    {
        if (axis != 2) xy_ = 0;
        if (axis != 1) xz_ = 0;
        if (axis != 0) yz_ = 0;
        linear_[axis] = first_[axis] = 0;
    }

    /// The cost of the place `p`, at least 0; `spreadWeight` is that of the spread.
    double cost(const openvdb::Vec3d& p, double spreadWeight) const
    {
        const double planes = p.dot(times(p)) + 2 * linear_.dot(p) + constant_;
        const double spread = weight_ * p.lengthSqr() - 2 * first_.dot(p) + second_;
        return std::max(0.0, planes) + spreadWeight * std::max(0.0, spread);
    }

    /// Half the second derivative of the plane error.
    openvdb::Mat3d planes() const { return {xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_}; }

    /// The place of least plane error nearest to the middle of the area; directions in which the planes are softer
    /// than `stiffness` times the area count as open. False if there is no area.
    bool bestPlace(double stiffness, openvdb::Vec3d& place) const
    {
        if (!(weight_ > 0)) return false;
        place = first_ / weight_;
        // Proximal point iteration: each step keeps open directions and at least halves the error in stiff ones. The
        // matrix planes + stiffness * identity is positive definite: Cholesky.
        const double add = stiffness * weight_;
        const double l00 = std::sqrt(xx_ + add), l10 = xy_ / l00, l20 = xz_ / l00;
        const double l11 = std::sqrt(yy_ + add - l10 * l10), l21 = (yz_ - l20 * l10) / l11;
        const double l22 = std::sqrt(zz_ + add - l20 * l20 - l21 * l21);
        if (!(l00 > 0 && l11 > 0 && l22 > 0)) return false;
        for (int step = 0; step < steps; ++step) {
            const openvdb::Vec3d slope = times(place) + linear_;
            const double y0 = slope.x() / l00, y1 = (slope.y() - l10 * y0) / l11;
            const double y2 = (slope.z() - l20 * y0 - l21 * y1) / l22;
            const double z = y2 / l22, y = (y1 - l21 * z) / l11, x = (y0 - l10 * y - l20 * z) / l00;
            place -= openvdb::Vec3d(x, y, z);
            if (std::abs(x) + std::abs(y) + std::abs(z) < rounding) break;
        }
        return std::isfinite(place.x()) && std::isfinite(place.y()) && std::isfinite(place.z());
    }

private:
    static constexpr double rounding = 1e-14; // of coordinates, which are about 1
    static constexpr int steps = 8;           // enough to put the corner of a box where it is to 12 digits

    openvdb::Vec3d times(const openvdb::Vec3d& p) const
    {
        return {xx_ * p.x() + xy_ * p.y() + xz_ * p.z(), xy_ * p.x() + yy_ * p.y() + yz_ * p.z(),
                xz_ * p.x() + yz_ * p.y() + zz_ * p.z()};
    }

    // The planes: p' A p + 2 b' p + c.
    double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
    openvdb::Vec3d linear_{0.0};
    double constant_ = 0;
    // The spread: moments of the area.
    double weight_ = 0;
    openvdb::Vec3d first_{0.0};
    double second_ = 0;
};

} // namespace vdbcage::detail
