// Based on: Besl and McKay, "A Method for Registration of 3-D Shapes", 1992 (nearest points as counterparts).
// Differs: the motion is a mirror image, in a plane across a given axis, with only its offset unknown, or in any plane;
// and the sum of distances is made small, not of their squares, so that parts without a counterpart do not disturb.
// Where any plane is allowed, all directions are tried first, after Podolak, Shilane, Golovinskiy, Rusinkiewicz and
// Funkhouser, "A Planar-Reflective Symmetry Transform for 3D Shapes", 2006.

#include <vdbcage/mesh/symmetry.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage {

namespace {

using detail::Corners;
using detail::TriangleBvh;
using openvdb::Vec3d;

/// The largest rounding of coordinates of six digits, over the longest side of a model that lies on both sides of a
/// plane through the origin. That of floats is less.
constexpr double rounding = 2.5e-6;

/// A model as a tree, in units of its longest side, relative to the middle of its box.
class MirroredModel {
public:
    MirroredModel(const Mesh& model, Interrupter* interrupter) : interrupter_(interrupter)
    {
        requireUsable(model, "model");
        const openvdb::BBoxd box = boundingBox(model);
        side_ = detail::longestSide(box);
        centre_ = 0.5 * box.min() + 0.5 * box.max();
        std::vector<Vec3d> points;
        points.reserve(model.points.size());
        for (const Vec3d& p : model.points) points.push_back((p - centre_) / side_);
        const std::vector<Vec3I> triangles = triangulate(model);
        takeSamples(points, triangles);
        tree_ = TriangleBvh(std::move(points), triangles, interrupter, TriangleBvh::Copies::drop);
    }

    Symmetry best(int axis) const
    {
        const AcrossAxis plane = improved(AcrossAxis{axis, 0});
        const double offset = centre_[axis] + plane.offset * side_;
        if (std::abs(offset) > rounding * side_) return {{axis, offset}, fit(plane).deviation};
        // The model is too inexact to distinguish the plane from that through the origin, so the latter is meant.
        return {{axis, 0}, fit(AcrossAxis{axis, -centre_[axis] / side_}).deviation};
    }

    TiltedSymmetry bestTilted() const
    {
        constexpr std::size_t refined = 6;
        std::vector<Tilted> planes = planesThroughCentroid();
        std::vector<double> distances(planes.size());
        detail::parallelFor(std::size_t(0), planes.size(), [&](std::size_t i) {
            throwIfInterrupted(interrupter_);
            distances[i] = roughDistance(planes[i]);
        });
        std::vector<std::size_t> order(planes.size());
        std::iota(order.begin(), order.end(), 0U);
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
        Tilted best{{1, 0, 0}, 0};
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < refined; ++i) {
            const Tilted plane = improved(planes[order[i]]);
            const double deviation = fit(plane).deviation;
            if (!(deviation < least)) continue;
            best = plane;
            least = deviation;
        }
        const int largest = static_cast<int>(openvdb::math::MaxIndex(openvdb::math::Abs(best.normal)));
        if (best.normal[largest] < 0) best = {-best.normal, -best.offset};
        return {best.normal, best.offset * side_ + best.normal.dot(centre_), least};
    }

private:
    using Vec3I = openvdb::Vec3I;

    /// A plane, with the mirror image of a point, and the speed of that image along `normal` for each parameter.
    struct AcrossAxis {
        static constexpr int parameters = 1;
        int axis;
        double offset;

        Vec3d image(Vec3d p) const
        {
            p[axis] = 2 * offset - p[axis];
            return p;
        }
        std::array<double, 1> speeds(const Vec3d& /*p*/, const Vec3d& normal) const { return {2 * normal[axis]}; }
        AcrossAxis moved(const std::array<double, 1>& by) const { return {axis, offset + by[0]}; }
    };
    struct Tilted {
        static constexpr int parameters = 3; // the normal turns in two directions
        Vec3d normal;
        double offset;

        Vec3d image(const Vec3d& p) const { return p - 2 * (normal.dot(p) - offset) * normal; }
        std::array<Vec3d, 2> across() const
        {
            Vec3d u = normal.cross(unitAlong(static_cast<int>(openvdb::math::MinIndex(openvdb::math::Abs(normal)))));
            u.normalize();
            return {u, normal.cross(u)};
        }
        std::array<double, 3> speeds(const Vec3d& p, const Vec3d& along) const
        {
            const double height = normal.dot(p) - offset;
            const auto [u, v] = across();
            const auto turning = [&](const Vec3d& d) { return -2 * (d.dot(p) * normal + height * d).dot(along); };
            return {2 * normal.dot(along), turning(u), turning(v)};
        }
        Tilted moved(const std::array<double, 3>& by) const
        {
            const auto [u, v] = across();
            Vec3d turned = normal + by[1] * u + by[2] * v;
            turned.normalize();
            return {turned, offset + by[0]};
        }
    };

    static Vec3d unitAlong(int axis)
    {
        Vec3d unit(0.0);
        unit[axis] = 1;
        return unit;
    }

    /// Returns the distance of the mirrored samples from the model, the mean and that of almost all of them, and the
    /// move that the plane should make.
    template <int parameters>
    struct Fit {
        double distance, deviation;
        std::array<double, parameters> shift;
    };

    template <typename Plane>
    Plane improved(Plane plane) const
    {
        constexpr int steps = 16;
        constexpr double converged = 1e-9;
        auto here = fit(plane);
        for (int i = 0; i < steps && here.distance > 0; ++i) {
            const Plane next = plane.moved(here.shift);
            const auto there = fit(next);
            if (!(there.distance < here.distance)) break;
            plane = next;
            here = there;
            if (std::all_of(here.shift.begin(), here.shift.end(), [](double d) { return std::abs(d) < converged; }))
                break;
        }
        return plane;
    }

    /// Returns planes across the principal axes of the samples, and across 500 directions spread evenly over half the
    /// sphere.
    std::vector<Tilted> planesThroughCentroid() const
    {
        constexpr int directions = 500;
        Vec3d centroid(0.0);
        for (const Vec3d& p : samples_) centroid += p / static_cast<double>(samples_.size());
        openvdb::Mat3d spread = openvdb::Mat3d::zero(), axes;
        for (const Vec3d& p : samples_) {
            const Vec3d d = p - centroid;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) spread(i, j) += d[i] * d[j];
            }
        }
        Vec3d sizes;
        std::vector<Tilted> planes;
        const auto add = [&](const Vec3d& normal) { planes.push_back({normal, normal.dot(centroid)}); };
        if (openvdb::math::diagonalizeSymmetricMatrix(spread, axes, sizes)) {
            for (int i = 0; i < 3; ++i) add(axes.col(i));
        }
        constexpr double golden = 2.399963229728653; // angle from one to the next, which never repeats
        for (int i = 0; i < directions; ++i) {
            const double z = (i + 0.5) / directions, radius = std::sqrt(1 - z * z);
            add({radius * std::cos(golden * i), radius * std::sin(golden * i), z});
        }
        return planes;
    }

    /// Returns the mean distance of some mirrored samples.
    double roughDistance(const Tilted& plane) const
    {
        constexpr std::size_t every = 8;
        double total = 0;
        for (std::size_t i = 0; i < samples_.size(); i += every) {
            total += std::sqrt(tree_.closest(plane.image(samples_[i])).squaredDistance);
        }
        return total;
    }

    /// Takes points spread evenly over the area.
    void takeSamples(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles)
    {
        constexpr std::size_t sampleCount = 2000;
        const auto corners = [&](const Vec3I& t) { return Corners{points[t[0]], points[t[1]], points[t[2]]}; };
        const auto area = [](const Corners& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length(); };
        double total = 0;
        for (const Vec3I& t : triangles) total += area(corners(t));
        const double step = total / sampleCount;
        double done = 0; // of the area
        for (const Vec3I& t : triangles) {
            const Corners c = corners(t);
            const double size = area(c);
            // The k-th sample stands for the area from k to k + 1 steps. Two sequences that fill the unit interval
            // evenly determine its place in its triangle.
            while ((static_cast<double>(samples_.size()) + 0.5) * step < done + size) {
                const auto k = static_cast<double>(samples_.size());
                double u = std::fmod(k * 0.7548776662466927, 1.0), v = std::fmod(k * 0.5698402909980532, 1.0);
                if (u + v > 1) {
                    u = 1 - u;
                    v = 1 - v;
                }
                samples_.push_back(c[0] + u * (c[1] - c[0]) + v * (c[2] - c[0]));
            }
            done += size;
        }
        if (samples_.empty()) samples_.push_back(points[triangles.front()[0]]); // an area too small for double
    }

    /// Makes one step of reweighted least squares, towards the planes of the nearest faces.
    template <typename Plane>
    Fit<Plane::parameters> fit(const Plane& plane) const
    {
        throwIfInterrupted(interrupter_);
        constexpr double most = 0.99;  // of the samples
        constexpr double least = 1e-6; // smaller distances do not weigh more
        struct Share {
            std::array<double, Plane::parameters> speeds{};
            double weight = 0, toPlane = 0;
        };
        std::vector<double> distances(samples_.size());
        std::vector<Share> shares(samples_.size());
        detail::parallelFor(std::size_t(0), samples_.size(), [&](std::size_t i) {
            const Vec3d image = plane.image(samples_[i]);
            const TriangleBvh::Closest closest = tree_.closest(image);
            distances[i] = std::sqrt(closest.squaredDistance);
            const Corners t = tree_.corners(tree_.items()[closest.item]);
            Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
            if (!normal.normalize(0)) return;
            const double toPlane = normal.dot(closest.point - image);
            shares[i] = {plane.speeds(samples_[i], normal), 1 / std::max(std::abs(toPlane), least), toPlane};
        });
        std::array<double, Plane::parameters> pull{};
        std::array<std::array<double, Plane::parameters>, Plane::parameters> stiffness{};
        for (const Share& share : shares) {
            for (std::size_t k = 0; k < pull.size(); ++k) {
                const double weight = share.speeds[k] * share.weight;
                pull[k] += weight * share.toPlane;
                for (std::size_t l = 0; l < pull.size(); ++l) stiffness[k][l] += weight * share.speeds[l];
            }
        }
        const double distance =
            std::accumulate(distances.begin(), distances.end(), 0.0) / static_cast<double>(distances.size());
        const auto rank = static_cast<std::ptrdiff_t>(most * static_cast<double>(distances.size()));
        std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
        return {distance, distances[static_cast<std::size_t>(rank)], solved(stiffness, pull)};
    }

    static std::array<double, 1> solved(const std::array<std::array<double, 1>, 1>& stiffness,
                                        const std::array<double, 1>& pull)
    {
        return {stiffness[0][0] > 0 ? pull[0] / stiffness[0][0] : 0};
    }
    /// Leaves directions alone that change nothing, such as turning a ball's plane.
    static std::array<double, 3> solved(const std::array<std::array<double, 3>, 3>& stiffness,
                                        const std::array<double, 3>& pull)
    {
        constexpr double damping = 1e-9;
        const double stiffest = std::max({stiffness[0][0], stiffness[1][1], stiffness[2][2]});
        if (!(stiffest > 0)) return {};
        openvdb::Mat3d system;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                system(i, j) = stiffness[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] / stiffest;
            }
            system(i, i) += damping;
        }
        if (!(std::abs(system.det()) > 0)) return {};
        const Vec3d shift = system.inverse(0) * Vec3d(pull[0], pull[1], pull[2]) / stiffest;
        return {shift[0], shift[1], shift[2]};
    }

    Interrupter* interrupter_;
    double side_ = 1;
    Vec3d centre_{0.0};
    std::vector<Vec3d> samples_;
    TriangleBvh tree_;
};

} // namespace

Symmetry bestSymmetry(const Mesh& model, int axis, Interrupter* interrupter)
{
    if (axis < 0 || axis > 2) {
        throw InputError("axis", std::to_string(axis) + " is not allowed; it must be 0, 1 or 2");
    }
    return MirroredModel(model, interrupter).best(axis);
}

TiltedSymmetry bestTiltedSymmetry(const Mesh& model, Interrupter* interrupter)
{
    return MirroredModel(model, interrupter).bestTilted();
}

std::optional<Symmetry> findSymmetry(const Mesh& model, double tolerance, Interrupter* interrupter)
{
    constexpr double equallyGood = 1e-6; // the rounding of models in floats: the first of such planes is taken
    const MirroredModel mirrored(model, interrupter);
    Symmetry best = mirrored.best(0);
    for (const int axis : {1, 2}) {
        const Symmetry other = mirrored.best(axis);
        if (other.deviation < best.deviation - equallyGood) best = other;
    }
    if (!(best.deviation <= tolerance)) return std::nullopt;
    return best;
}

} // namespace vdbcage
