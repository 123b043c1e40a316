// Based on: Möller and Trumbore, Fast, minimum storage ray/triangle intersection, JGT 2(1), 1997.
#include <tools/draw/pick.h>

#include <limits>

namespace vdbcage::draw {

namespace {

using openvdb::Vec3d;

/// The fraction of its size by which a triangle is met outside, too: no ray passes between two.
constexpr double slack = 1e-9;

Vec3d toDouble(const Vec3f& v)
{
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

} // namespace

std::optional<Hit> nearestHit(const Ray& ray, const Geometry& geometry, const std::optional<Section>& section)
{
    std::optional<Hit> nearest;
    double best = std::numeric_limits<double>::infinity();
    const auto& triangles = geometry.triangles();
    const auto& points = geometry.positions();
    const std::size_t plain = geometry.triangleCount();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Vec3d a = toDouble(points[triangles[i][0]]);
        const Vec3d ab = toDouble(points[triangles[i][1]]) - a, ac = toDouble(points[triangles[i][2]]) - a;
        const Vec3d across = ray.direction.cross(ac);
        const double determinant = ab.dot(across);
        if (determinant == 0) continue;
        const Vec3d from = ray.from - a;
        const double u = from.dot(across) / determinant;
        if (!(u >= -slack && u <= 1 + slack)) continue;
        const Vec3d normal = from.cross(ab);
        const double v = ray.direction.dot(normal) / determinant;
        if (!(v >= -slack && u + v <= 1 + slack)) continue;
        const double distance = ac.dot(normal) / determinant;
        if (!(distance > 0 && distance < best)) continue;
        const Vec3d point = ray.from + distance * ray.direction;
        if (section && section->normal.dot(point) < section->offset) continue;
        best = distance;
        nearest = Hit{distance, i < plain ? i : plain + (i - plain) / 2, point};
    }
    return nearest;
}

} // namespace vdbcage::draw
