#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <openvdb/Types.h>

namespace vdbcage::detail {

/// The cost of merging points into one place: the integral of the squared distance to the planes of the faces around
/// them, and the spread. The spread is the integral of the squared distance to the area of these faces.
///
/// The planes determine the surface. Where they leave directions open, on flat ground, the spread distributes the
/// places evenly. It has a small weight in the cost. In the choice of the place it counts only in directions that the
/// planes leave open, so a corner of a box stays where it is.
class Quadric {
public:
    /// Adds the plane through `point` with the normal `unitNormal`. `weight` is its area.
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

    /// Averages this with its mirror image in the plane through the origin across `axis` (0 to 2). The cost of places
    /// in that plane stays.
    void symmetrize(int axis)
    {
        if (axis != 2) xy_ = 0;
        if (axis != 1) xz_ = 0;
        if (axis != 0) yz_ = 0;
        linear_[axis] = first_[axis] = 0;
    }

    /// Returns the cost of the place `p`, at least 0. `spreadWeight` is that of the spread.
    double cost(const openvdb::Vec3d& p, double spreadWeight) const
    {
        const double planes = p.dot(times(p)) + 2 * linear_.dot(p) + constant_;
        const double spread = weight_ * p.lengthSqr() - 2 * first_.dot(p) + second_;
        return std::max(0.0, planes) + spreadWeight * std::max(0.0, spread);
    }

    /// Returns half the second derivative of the plane error.
    openvdb::Mat3d planes() const { return {xx_, xy_, xz_, xy_, yy_, yz_, xz_, yz_, zz_}; }

    /// Finds the place of least plane error nearest to the middle of the area. Directions in which the planes are
    /// softer than `stiffness` times the area count as open. Returns false, without a place, if there is no area.
    bool bestPlace(double stiffness, openvdb::Vec3d& place) const
    {
        std::array<openvdb::Vec3d, 1> places;
        const std::array<bool, 1> found = bestPlaces<1>({*this}, stiffness, places);
        place = places[0];
        return found[0];
    }

    /// Finds the same places as bestPlace() for several quadrics, to the bit. Divisions take most of the time, so four
    /// side by side take little longer than one.
    template <std::size_t n>
    static std::array<bool, n> bestPlaces(const std::array<Quadric, n>& quadrics, double stiffness,
                                          std::array<openvdb::Vec3d, n>& places)
    {
        // Proximal point iteration: each step keeps open directions and at least halves the error in stiff ones. The
        // matrix planes + stiffness * identity is positive definite: Cholesky.
        using Row = std::array<double, n>; // one number for each quadric
        Row l00, l10, l20, l11, l21, l22, x, y, z, change;
        for (std::size_t i = 0; i < n; ++i) {
            const Quadric& q = quadrics[i];
            const double add = stiffness * q.weight_;
            l00[i] = std::sqrt(q.xx_ + add);
            l10[i] = q.xy_ / l00[i];
            l20[i] = q.xz_ / l00[i];
            l11[i] = std::sqrt(q.yy_ + add - l10[i] * l10[i]);
            l21[i] = (q.yz_ - l20[i] * l10[i]) / l11[i];
            l22[i] = std::sqrt(q.zz_ + add - l20[i] * l20[i] - l21[i] * l21[i]);
            x[i] = q.first_.x() / q.weight_;
            y[i] = q.first_.y() / q.weight_;
            z[i] = q.first_.z() / q.weight_;
            change[i] = std::numeric_limits<double>::infinity();
        }
        for (int step = 0; step < steps; ++step) {
            for (std::size_t i = 0; i < n; ++i) {
                const openvdb::Vec3d slope = quadrics[i].times({x[i], y[i], z[i]}) + quadrics[i].linear_;
                const double y0 = slope.x() / l00[i], y1 = (slope.y() - l10[i] * y0) / l11[i];
                const double y2 = (slope.z() - l20[i] * y0 - l21[i] * y1) / l22[i];
                const double dz = y2 / l22[i], dy = (y1 - l21[i] * dz) / l11[i];
                const double dx = (y0 - l10[i] * dy - l20[i] * dz) / l00[i];
                const bool isDone = change[i] < rounding;
                x[i] = isDone ? x[i] : x[i] - dx;
                y[i] = isDone ? y[i] : y[i] - dy;
                z[i] = isDone ? z[i] : z[i] - dz;
                change[i] = isDone ? change[i] : std::abs(dx) + std::abs(dy) + std::abs(dz);
            }
            if (std::all_of(change.begin(), change.end(), [](double size) { return size < rounding; })) break;
        }
        std::array<bool, n> found;
        for (std::size_t i = 0; i < n; ++i) {
            places[i] = {x[i], y[i], z[i]};
            found[i] = l00[i] > 0 && l11[i] > 0 && l22[i] > 0 && std::isfinite(x[i]) && std::isfinite(y[i]) &&
                       std::isfinite(z[i]);
        }
        return found;
    }

private:
    static constexpr double rounding = 1e-14; // of coordinates, which are about 1
    static constexpr int steps = 8;           // enough for the corner of a box to 12 digits

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
