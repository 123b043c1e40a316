#include <vdbcage/bounding/detail/guard/limb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

/// Returns where `ray` meets a triangle, as a share of the ray; nothing if it does not.
/// Based on: Moller, Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997.
std::optional<double> hit(const Corners& t, const Vec3d& from, const Vec3d& ray)
{
    const Vec3d a = t[1] - t[0], b = t[2] - t[0], across = ray.cross(b);
    const double volume = a.dot(across);
    if (volume == 0) return std::nullopt;
    const Vec3d start = from - t[0], side = start.cross(a);
    const double u = start.dot(across) / volume, v = ray.dot(side) / volume, along = b.dot(side) / volume;
    if (u < 0 || v < 0 || u + v > 1 || along < 0) return std::nullopt;
    return along;
}

/// Returns the distance from `from` to the model along `direction`; infinite if the model is not there.
double distanceAlong(const TriangleBvh& model, const Vec3d& from, const Vec3d& direction)
{
    const Vec3d ray = 2 * (model.box().hi - model.box().lo).length() * direction, end = from + ray;
    double nearest = std::numeric_limits<double>::infinity();
    model.traverse(model.near({from, end, end}), [&](const TriangleBvh::Item& item) {
        if (const auto along = hit(model.corners(item), from, ray)) nearest = std::min(nearest, *along * ray.length());
        return true;
    });
    return nearest;
}

double radiusAcross(const TriangleBvh& model, const Vec3d& place, const Vec3d& axis)
{
    std::array<double, 16> distances{};
    const int thinnest =
        static_cast<int>(openvdb::math::MinIndex(Vec3d(std::abs(axis[0]), std::abs(axis[1]), std::abs(axis[2]))));
    Vec3d u(0.0);
    u[thinnest] = 1;
    u = (u - u.dot(axis) * axis).unit();
    const Vec3d v = axis.cross(u);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        const double angle = 2 * pi * static_cast<double>(i) / static_cast<double>(distances.size());
        distances[i] = distanceAlong(model, place, std::cos(angle) * u + std::sin(angle) * v);
    }
    const auto middle = distances.begin() + distances.size() / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    return *middle;
}

} // namespace

Limb limbAt(const TriangleBvh& model, const Joint& joint)
{
    if (joint.axis) return {joint.place, *joint.axis, radiusAcross(model, joint.place, *joint.axis)};
    constexpr int directions = 200; // about 10 degrees apart, on a spiral over half a sphere
    const double turn = pi * (3 - std::sqrt(5.0));
    Limb best{joint.place, Vec3d(0, 0, 1), std::numeric_limits<double>::infinity()};
    for (int i = 0; i < directions; ++i) {
        const double height = (i + 0.5) / directions, width = std::sqrt(1 - height * height);
        const Vec3d axis(width * std::cos(turn * i), width * std::sin(turn * i), height);
        const double radius = radiusAcross(model, joint.place, axis);
        if (radius < best.radius) best = {joint.place, axis, radius};
    }
    return best;
}

} // namespace vdbcage::detail
