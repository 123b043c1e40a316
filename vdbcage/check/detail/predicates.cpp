// Based on: CGAL's filtered predicates (Exact_predicates_inexact_constructions_kernel, LGPL part);
//           H. Edelsbrunner and E. P. Mücke, "Simulation of Simplicity", 1990 (the ray through edges and corners).
// Differs: triangles are tested edge by edge, so that degenerate ones need no predicates of their own.
#include <vdbcage/check/detail/predicates.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

namespace vdbcage::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = std::array<double, 2>;

int orientation(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    const auto point = [](const Vec3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
    return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

int orientation(const Point2& a, const Point2& b, const Point2& c)
{
    const auto point = [](const Point2& p) { return Kernel::Point_2(p[0], p[1]); };
    return static_cast<int>(CGAL::orientation(point(a), point(b), point(c)));
}

Point2 drop(const Vec3d& p, int axis)
{
    return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

bool between(double x, double a, double b)
{
    return std::min(a, b) <= x && x <= std::max(a, b);
}

// Returns whether p, on the line of a and b, lies on the segment.
bool between(const Point2& p, const Point2& a, const Point2& b)
{
    return between(p[0], a[0], b[0]) && between(p[1], a[1], b[1]);
}

bool segmentsMeet(const Point2& a, const Point2& b, const Point2& c, const Point2& d)
{
    const int abc = orientation(a, b, c), abd = orientation(a, b, d);
    const int cda = orientation(c, d, a), cdb = orientation(c, d, b);
    if (abc * abd < 0 && cda * cdb < 0) return true;
    return (abc == 0 && between(c, a, b)) || (abd == 0 && between(d, a, b)) || (cda == 0 && between(a, c, d)) ||
           (cdb == 0 && between(b, c, d));
}

// Returns whether two segments, which may be points, meet. Four points in one plane: at least one of the three
// projections is one-to-one on their span, so the segments meet if all three projections do.
bool segmentsMeet(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    if (orientation(a, b, c, d) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        if (!segmentsMeet(drop(a, axis), drop(b, axis), drop(c, axis), drop(d, axis))) return false;
    }
    return true;
}

// Returns whether a triangle, which is not degenerate, contains p, which lies in its plane.
bool containsInPlane(const Corners& t, const Vec3d& p)
{
    for (int axis = 0; axis < 3; ++axis) {
        const Point2 a = drop(t[0], axis), b = drop(t[1], axis), c = drop(t[2], axis), q = drop(p, axis);
        const int turn = orientation(a, b, c);
        if (turn == 0) continue; // the plane is seen edge-on
        return turn * orientation(a, b, q) >= 0 && turn * orientation(b, c, q) >= 0 && turn * orientation(c, a, q) >= 0;
    }
    return false;
}

// Returns whether a segment, which may be a point, meets a triangle that is not degenerate.
bool segmentMeetsTriangle(const Vec3d& a, const Vec3d& b, const Corners& t)
{
    const int sideA = orientation(t[0], t[1], t[2], a), sideB = orientation(t[0], t[1], t[2], b);
    if (sideA * sideB > 0) return false;
    if (sideA == 0 && containsInPlane(t, a)) return true;
    if (sideB == 0 && containsInPlane(t, b)) return true;
    if (sideA == 0 && sideB == 0) {
        return segmentsMeet(a, b, t[0], t[1]) || segmentsMeet(a, b, t[1], t[2]) || segmentsMeet(a, b, t[2], t[0]);
    }
    if (sideA == 0 || sideB == 0) return false;
    const int s0 = orientation(a, b, t[0], t[1]), s1 = orientation(a, b, t[1], t[2]),
              s2 = orientation(a, b, t[2], t[0]);
    return (s0 >= 0 && s1 >= 0 && s2 >= 0) || (s0 <= 0 && s1 <= 0 && s2 <= 0);
}

// Returns the segment that a degenerate triangle is. On a line the order of the coordinates is the order of the points.
std::pair<Vec3d, Vec3d> asSegment(const Corners& t)
{
    const auto [first, last] = std::minmax_element(t.begin(), t.end());
    return {*first, *last};
}

// Returns whether all of t lies strictly on one side of the plane of s.
bool planeSeparates(const Corners& s, const Corners& t)
{
    const int side = orientation(s[0], s[1], s[2], t[0]);
    return side != 0 && orientation(s[0], s[1], s[2], t[1]) == side && orientation(s[0], s[1], s[2], t[2]) == side;
}

bool anyEdgeMeets(const Corners& s, const Corners& t)
{
    return segmentMeetsTriangle(s[0], s[1], t) || segmentMeetsTriangle(s[1], s[2], t) ||
           segmentMeetsTriangle(s[2], s[0], t);
}

} // namespace

bool isDegenerate(const Corners& t)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (orientation(drop(t[0], axis), drop(t[1], axis), drop(t[2], axis)) != 0) return false;
    }
    return true;
}

bool trianglesMeet(const Corners& s, const Corners& t)
{
    if (planeSeparates(s, t) || planeSeparates(t, s)) return false;
    const bool sIsSegment = isDegenerate(s), tIsSegment = isDegenerate(t);
    if (sIsSegment && tIsSegment) {
        const auto [a, b] = asSegment(s);
        const auto [c, d] = asSegment(t);
        return segmentsMeet(a, b, c, d);
    }
    if (sIsSegment || tIsSegment) {
        const auto [a, b] = asSegment(sIsSegment ? s : t);
        return segmentMeetsTriangle(a, b, sIsSegment ? t : s);
    }
    // The intersection of two triangles ends on an edge of one of them.
    return anyEdgeMeets(s, t) || anyEdgeMeets(t, s);
}

bool meetBeyondCorner(const Corners& s, const Corners& t)
{
    // The intersection is convex and contains the corner. Seen from there, another shared point lies in a direction in
    // which both triangles extend, up to the nearer of the two edges opposite to the corner.
    return segmentMeetsTriangle(s[1], s[2], t) || segmentMeetsTriangle(t[1], t[2], s);
}

bool foldOver(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    if (orientation(a, b, c, d) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
        const Point2 p = drop(a, axis), q = drop(b, axis);
        const int turn = orientation(p, q, drop(c, axis));
        if (turn != 0) return turn == orientation(p, q, drop(d, axis));
    }
    return false;
}

bool contains(const Corners& t, const Vec3d& p)
{
    if (orientation(t[0], t[1], t[2], p) != 0) return false;
    if (!isDegenerate(t)) return containsInPlane(t, p);
    const auto [a, b] = asSegment(t);
    return segmentsMeet(a, b, p, p);
}

int rayCrossing(const Corners& t, const Vec3d& p)
{
    // In the projection along x, the winding number of the triangle around p, moved by (e * e, e) in y and z for an
    // infinitesimal e > 0: a corner level with p in y lies below it, and an edge through p lies on the lower side of z.
    const Point2 q = drop(p, 0);
    int turns = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Point2 a = drop(t[i], 0), b = drop(t[(i + 1) % 3], 0);
        const bool fromAbove = a[0] > q[0], toAbove = b[0] > q[0];
        if (fromAbove == toAbove) continue;
        const int side = orientation(a, b, q);
        if (toAbove && side < 0) --turns;
        if (fromAbove && side > 0) ++turns;
    }
    if (turns == 0) return 0;
    // The triangle is ahead if p lies below it, seen against the ray.
    return orientation(t[0], t[1], t[2], p) * turns < 0 ? turns : 0;
}

int sideOfPlane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    return orientation(a, b, c, d);
}

int volumeSign(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Interrupter* interrupter)
{
    if (triangles.empty()) return 0;
    const Vec3d origin = points[triangles[0][0]]; // any point will do: the surface has no boundary
    double volume = 0, magnitude = 0, largest = 0;
    for (const Vec3I& t : triangles) {
        const Vec3d a = points[t[0]] - origin, b = points[t[1]] - origin, c = points[t[2]] - origin;
        for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(a[i]), std::abs(b[i]), std::abs(c[i])});
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            volume += a[i] * (b[j] * c[k] - b[k] * c[j]);
            magnitude += std::abs(a[i]) * (std::abs(b[j] * c[k]) + std::abs(b[k] * c[j]));
        }
    }
    // At most 8 roundings a product and one a sum; twice that covers the rounding of the bound itself. 1e-200 covers
    // products that underflow; nothing overflows.
    const double bound = (16 + 6 * static_cast<double>(triangles.size())) * std::numeric_limits<double>::epsilon();
    if (largest < 1e90 && std::abs(volume) > bound * magnitude + 1e-200) return volume > 0 ? 1 : -1;
    using Exact = CGAL::Exact_rational;
    Exact sum(0);
    for (const Vec3I& t : triangles) {
        throwIfInterrupted(interrupter);
        std::array<std::array<Exact, 3>, 3> m;
        for (std::size_t row = 0; row < 3; ++row) {
            for (std::size_t column = 0; column < 3; ++column) {
                const int axis = static_cast<int>(column);
                m[row][column] = Exact(points[t[static_cast<int>(row)]][axis]) - Exact(origin[axis]);
            }
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            sum += m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]);
        }
    }
    return static_cast<int>(CGAL::sign(sum));
}

} // namespace vdbcage::detail
