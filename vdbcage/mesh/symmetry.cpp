// Based on: Besl and McKay, "A Method for Registration of 3-D Shapes", 1992 (nearest points as counterparts).
// Differs: the motion is a mirror image in a plane across a given axis, so that its offset alone is looked for; and the
// sum of distances is made small, not of their squares, so that parts without a counterpart do not disturb.

#include <vdbcage/mesh/symmetry.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage {

namespace {

using detail::Corners;
using detail::TriangleBvh;
using openvdb::Vec3d;

/// A model as a tree, in units of its longest side from the middle of its box.
class MirroredModel {
public:
    MirroredModel(const Mesh& model, Interrupter* interrupter) : interrupter_(interrupter)
    {
        requireUsable(model, "model");
        const openvdb::BBoxd box = boundingBox(model);
        side_ = box.extents()[static_cast<int>(box.maxExtent())];
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
        constexpr int steps = 16;
        constexpr double converged = 1e-9;
        double offset = 0;
        Fit fit = mirrored(axis, offset);
        for (int i = 0; i < steps && fit.distance > 0; ++i) {
            const double next = offset + fit.shift;
            const Fit there = mirrored(axis, next);
            if (!(there.distance < fit.distance)) break;
            offset = next;
            fit = there;
            if (std::abs(fit.shift) < converged) break;
        }
        return {{axis, centre_[axis] + offset * side_}, fit.deviation};
    }

private:
    using Vec3I = openvdb::Vec3I;

    /// How far the mirrored samples are from the model, on average and almost all of them, and by how much the plane
    /// should move.
    struct Fit {
        double distance, deviation, shift;
    };

    /// Points spread evenly over the area.
    void takeSamples(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles)
    {
        constexpr std::size_t wanted = 2000;
        const auto corners = [&](const Vec3I& t) { return Corners{points[t[0]], points[t[1]], points[t[2]]}; };
        const auto area = [](const Corners& t) { return 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length(); };
        double total = 0;
        for (const Vec3I& t : triangles) total += area(corners(t));
        const double step = total / wanted;
        double done = 0; // of the area
        for (const Vec3I& t : triangles) {
            const Corners c = corners(t);
            const double size = area(c);
            // The k-th sample stands for the area from k to k + 1 steps; where it lies in its triangle follows from
            // two sequences that fill the unit interval evenly.
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

    /// One step of reweighted least squares, towards the planes of the nearest faces.
    Fit mirrored(int axis, double offset) const
    {
        throwIfInterrupted(interrupter_);
        constexpr double most = 0.99;  // of the samples
        constexpr double least = 1e-6; // distances below weigh no more
        std::vector<double> distances(samples_.size()), pull(samples_.size(), 0), stiffness(samples_.size(), 0);
        detail::parallelFor(std::size_t(0), samples_.size(), [&](std::size_t i) {
            Vec3d image = samples_[i];
            image[axis] = 2 * offset - image[axis];
            const TriangleBvh::Closest closest = tree_.closest(image);
            distances[i] = std::sqrt(closest.squaredDistance);
            const Corners t = tree_.corners(tree_.items()[closest.item]);
            Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
            if (!normal.normalize(0)) return;
            const double toPlane = normal.dot(closest.point - image);
            const double weight = normal[axis] / std::max(std::abs(toPlane), least);
            pull[i] = weight * toPlane;
            stiffness[i] = 2 * weight * normal[axis];
        });
        const auto total = [](const std::vector<double>& values) {
            return std::accumulate(values.begin(), values.end(), 0.0);
        };
        const double against = total(stiffness), distance = total(distances) / static_cast<double>(distances.size());
        const auto rank = static_cast<std::ptrdiff_t>(most * static_cast<double>(distances.size()));
        std::nth_element(distances.begin(), distances.begin() + rank, distances.end());
        return {distance, distances[static_cast<std::size_t>(rank)], against > 0 ? total(pull) / against : 0};
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
        throw InputError("axis: " + std::to_string(axis) + " is not allowed; it must be 0, 1 or 2");
    }
    return MirroredModel(model, interrupter).best(axis);
}

std::optional<Symmetry> findSymmetry(const Mesh& model, double tolerance, Interrupter* interrupter)
{
    constexpr double rounding = 1e-6; // of models in floats: of equally good planes the first
    const MirroredModel mirrored(model, interrupter);
    Symmetry best = mirrored.best(0);
    for (const int axis : {1, 2}) {
        const Symmetry other = mirrored.best(axis);
        if (other.deviation < best.deviation - rounding) best = other;
    }
    if (!(best.deviation <= tolerance)) return std::nullopt;
    return best;
}

} // namespace vdbcage
