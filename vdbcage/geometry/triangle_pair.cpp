#include <vdbcage/geometry/triangle_pair.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <vdbcage/geometry/triangle_distance.h>

namespace vdbcage::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

Kernel::Point_3 exact(const Vec3d& p)
{
    return {p[0], p[1], p[2]};
}

Kernel::Triangle_3 exact(const Corners& t)
{
    return {exact(t[0]), exact(t[1]), exact(t[2])};
}

/// Returns the sine of the angle between a direction and the nearest one between two others, all from one point; 1 if
/// that is not less than 90 degrees.
double sineBetween(const Vec3d& p, const Vec3d& from, const Vec3d& to, const Vec3d& normal)
{
    const double length2 = p.lengthSqr();
    if (normal.cross(from).dot(p) > 0 && normal.cross(to).dot(p) < 0) {
        return std::abs(normal.dot(p)) / std::sqrt(normal.lengthSqr() * length2);
    }
    double least = 1;
    for (const Vec3d* end : {&from, &to}) {
        if (end->dot(p) > 0) least = std::min(least, end->cross(p).length() / std::sqrt(end->lengthSqr() * length2));
    }
    return least;
}

/// Returns whether a plane that leaves the angle lies between two pairs of directions from one point, and so between
/// all directions between those of each pair. This decides most pairs of triangles that are nearly in one plane.
bool lieApart(const std::array<Vec3d, 2>& first, const std::array<Vec3d, 2>& second, double sine)
{
    const Vec3d u = first[0] + first[1], v = second[0] + second[1];
    const Vec3d across = u / std::sqrt(u.lengthSqr()) - v / std::sqrt(v.lengthSqr());
    const double half = 0.51 * sine, least2 = half * half * across.lengthSqr();
    const auto isBeyond = [&](double height, const Vec3d& p) {
        return height > 0 && height * height > least2 * p.lengthSqr();
    };
    return isBeyond(across.dot(first[0]), first[0]) && isBeyond(across.dot(first[1]), first[1]) &&
           isBeyond(-across.dot(second[0]), second[0]) && isBeyond(-across.dot(second[1]), second[1]);
}

/// Does the same as tooNear() for two triangles with one common corner.
bool tooNearAt(const SurfaceTriangle& a, int tipOfA, const SurfaceTriangle& b, int tipOfB, double sine)
{
    const Vec3d& tip = a.corner(tipOfA);
    const std::array<Vec3d, 2> inA{a.corner(tipOfA + 1) - tip, a.corner(tipOfA + 2) - tip};
    const std::array<Vec3d, 2> inB{b.corner(tipOfB + 1) - tip, b.corner(tipOfB + 2) - tip};
    const auto apart = [&](const SurfaceTriangle& one, const SurfaceTriangle& other, int tipOfOther) {
        const int side = one.plane.sideSeenFrom(tip, other.corner(tipOfOther + 1), sine);
        return side != 0 && one.plane.sideSeenFrom(tip, other.corner(tipOfOther + 2), sine) == side;
    };
    if (apart(a, b, tipOfB) || apart(b, a, tipOfA) || lieApart(inA, inB, sine)) return false;
    for (const Vec3d& p : inA) {
        if (sineBetween(p, inB[0], inB[1], b.plane.normal()) <= sine) return true;
    }
    for (const Vec3d& p : inB) {
        if (sineBetween(p, inA[0], inA[1], a.plane.normal()) <= sine) return true;
    }
    const Kernel::Segment_3 acrossA(exact(a.corner(tipOfA + 1)), exact(a.corner(tipOfA + 2)));
    const Kernel::Segment_3 acrossB(exact(b.corner(tipOfB + 1)), exact(b.corner(tipOfB + 2)));
    return CGAL::do_intersect(exact(a.corners), acrossB) || CGAL::do_intersect(exact(b.corners), acrossA);
}

} // namespace

bool hasNoArea(const Corners& t)
{
    return CGAL::collinear(exact(t[0]), exact(t[1]), exact(t[2]));
}

double minSine(const Corners& t)
{
    const double a = (t[1] - t[2]).lengthSqr(), b = (t[2] - t[0]).lengthSqr(), c = (t[0] - t[1]).lengthSqr();
    const double twiceArea = (t[1] - t[0]).cross(t[2] - t[0]).length();
    const double longest = std::max({a, b, c}), shortest = std::min({a, b, c});
    const double middle = a + b + c - longest - shortest;
    const double product = std::sqrt(longest * middle);
    return product > 0 ? twiceArea / product : 0;
}

bool tooNear(const SurfaceTriangle& a, const SurfaceTriangle& b, const Spacing& spacing)
{
    std::array<int, 3> inA{}, inB{};
    int shared = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (a.ids[i] != b.ids[j]) continue;
            inA[static_cast<std::size_t>(shared)] = i;
            inB[static_cast<std::size_t>(shared)] = j;
            ++shared;
        }
    }
    if (shared == 0) {
        // One plane between them decides most pairs.
        const auto apart = [&](const SurfaceTriangle& one, const SurfaceTriangle& other) {
            const int side = one.plane.side(other.corners[0], spacing.distance);
            return side != 0 && one.plane.side(other.corners[1], spacing.distance) == side &&
                   one.plane.side(other.corners[2], spacing.distance) == side;
        };
        return !apart(a, b) && !apart(b, a) && comeWithin(a.corners, b.corners, distanceBetween(a, b, spacing));
    }
    if (shared == 1) return tooNearAt(a, inA[0], b, inB[0], spacing.sine);
    // Folded onto each other, or not.
    const Vec3d &n = a.plane.normal(), &m = b.plane.normal();
    return shared == 3 ||
           (n.dot(m) < 0 && n.cross(m).lengthSqr() <= spacing.sine * spacing.sine * n.lengthSqr() * m.lengthSqr());
}

bool spreadOut(const SurfaceTriangles& triangles, const Spacing& spacing, double leastSine)
{
    Vec3d direction(0.0);
    for (const SurfaceTriangle& f : triangles) direction += f.plane.normal();
    const double length = direction.length();
    if (!(length > 0)) return false;
    direction /= length;
    const Vec3d& centre = triangles.front().corners[0];
    const Vec3d axis = std::abs(direction[0]) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    Vec3d x = axis.cross(direction);
    x /= x.length();
    const Vec3d y = direction.cross(x);
    const double least = spacing.sine / leastSine;
    int rounds = 0; // times that the link crosses the positive x axis
    for (const SurfaceTriangle& f : triangles) {
        const Vec3d a = f.corners[1] - centre, b = f.corners[2] - centre;
        const double ay = a.dot(y), by = b.dot(y), cross = f.plane.normal().dot(direction);
        if (!(cross > 0 && cross * cross > least * least * f.plane.normal().lengthSqr())) return false;
        rounds += ay < 0 && by >= 0; // a turn to the left by less than half a round
    }
    return rounds == 1;
}

} // namespace vdbcage::detail
