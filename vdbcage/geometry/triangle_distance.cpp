// Based on: C. Ericson, Real-Time Collision Detection, 2005, 5.1.9 (nearest points of segments).

#include <vdbcage/geometry/triangle_distance.h>

#include <array>
#include <cstddef>
#include <limits>

namespace vdbcage::detail {

namespace {

double clamp01(double t)
{
    return std::min(1.0, std::max(0.0, t));
}

double volume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    return (b - a).cross(c - a).dot(d - a);
}

/// Returns whether an edge of `from` crosses the inside of `t`, far enough from every border that rounding cannot
/// matter; distances between vertices, edges and faces cover the rest.
bool pierces(const Corners& from, const Corners& t)
{
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const std::array<bool, 3> above{normal.dot(from[0] - t[0]) > 0, normal.dot(from[1] - t[0]) > 0,
                                    normal.dot(from[2] - t[0]) > 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (above[i] == above[j]) continue;
        const Vec3d &p = from[i], &q = from[j];
        const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
        if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0)) return true;
    }
    return false;
}

/// Returns whether a pair of planes along an edge of each keeps the triangles farther apart than `distance`.
bool edgesSeparate(const Corners& first, const Corners& second, double distance)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d edge = first[(i + 1) % 3] - first[i], arm = first[(i + 2) % 3] - first[i];
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3d otherEdge = second[(j + 1) % 3] - second[j], otherArm = second[(j + 2) % 3] - second[j];
            const Vec3d across = second[j] - first[i];
            const Axis axis(edge, otherEdge);
            const double from = axis.along(arm), to = axis.along(otherArm), between = axis.along(across);
            const double gap = std::max(between + std::min(0.0, to) - std::max(0.0, from),
                                        std::min(0.0, from) - between - std::max(0.0, to));
            const double size2 = std::max(
                {edge.lengthSqr(), arm.lengthSqr(), otherEdge.lengthSqr(), otherArm.lengthSqr(), across.lengthSqr()});
            if (axis.isWider(gap, distance, size2)) return true;
        }
    }
    return false;
}

} // namespace

Nearness segmentNearness(const Vec3d& p1, const Vec3d& q1, const Vec3d& p2, const Vec3d& q2)
{
    const Vec3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const double a = d1.dot(d1), e = d2.dot(d2), f = d2.dot(r);
    double s = 0, t = 0;
    if (a <= 0 && e <= 0) {
        s = t = 0;
    } else if (a <= 0) {
        t = clamp01(f / e);
    } else {
        const double c = d1.dot(r);
        if (e <= 0) {
            s = clamp01(-c / a);
        } else {
            const double b = d1.dot(d2), determinant = a * e - b * b;
            // Nearly parallel: any point of the first will do, the second follows from it; the ends are also compared
            // as vertices against the other triangle.
            s = determinant > 1e-14 * a * e ? clamp01((b * f - c * e) / determinant) : 0.0;
            t = (b * s + f) / e;
            if (t < 0) {
                t = 0;
                s = clamp01(-c / a);
            } else if (t > 1) {
                t = 1;
                s = clamp01((b - c) / a);
            }
        }
    }
    Nearness result;
    result.onFirst = p1 + s * d1;
    result.onSecond = p2 + t * d2;
    result.squaredDistance = (result.onFirst - result.onSecond).lengthSqr();
    return result;
}

Nearness nearness(const Corners& first, const Corners& second)
{
    Nearness best;
    best.squaredDistance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d onSecond = closestPointOnTriangle(first[i], second);
        const double d = (first[i] - onSecond).lengthSqr();
        if (d < best.squaredDistance) best = {first[i], onSecond, d};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d onFirst = closestPointOnTriangle(second[i], first);
        const double d = (second[i] - onFirst).lengthSqr();
        if (d < best.squaredDistance) best = {onFirst, second[i], d};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Nearness edges = segmentNearness(first[i], first[(i + 1) % 3], second[j], second[(j + 1) % 3]);
            if (edges.squaredDistance < best.squaredDistance) best = edges;
        }
    }
    if (pierces(first, second) || pierces(second, first)) best.squaredDistance = 0;
    return best;
}

bool comeWithin(const Corners& first, const Corners& second, double distance)
{
    return !edgesSeparate(first, second, distance) && nearness(first, second).squaredDistance < distance * distance;
}

} // namespace vdbcage::detail
