#include <vdbcage/surface/detail/facet.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

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

bool meetBeyondShared(const Facet& a, const Facet& b)
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
        // One plane between them settles most pairs.
        const auto apart = [](const Facet& one, const Facet& other) {
            const int side = one.plane.side(other.corners[0]);
            return side != 0 && one.plane.side(other.corners[1]) == side && one.plane.side(other.corners[2]) == side;
        };
        return !apart(a, b) && !apart(b, a) && CGAL::do_intersect(exact(a.corners), exact(b.corners));
    }
    if (shared == 1) {
        const auto apart = [](const Facet& one, const Facet& other, int tip) {
            const int side = one.plane.side(other.corner(tip + 1));
            return side != 0 && one.plane.side(other.corner(tip + 2)) == side;
        };
        const int i = inA[0], j = inB[0];
        if (apart(a, b, j) || apart(b, a, i)) return false;
        const Kernel::Segment_3 acrossA(exact(a.corner(i + 1)), exact(a.corner(i + 2)));
        const Kernel::Segment_3 acrossB(exact(b.corner(j + 1)), exact(b.corner(j + 2)));
        return CGAL::do_intersect(exact(a.corners), acrossB) || CGAL::do_intersect(exact(b.corners), acrossA);
    }
    if (shared == 2) {
        // Folded onto each other, or not at all.
        const Vec3d& q = b.corner(3 - inB[0] - inB[1]);
        if (a.plane.side(q) != 0) return false;
        const Vec3d &u = a.corner(inA[0]), &v = a.corner(inA[1]), &p = a.corner(3 - inA[0] - inA[1]);
        return CGAL::coplanar(exact(u), exact(v), exact(p), exact(q)) &&
               CGAL::coplanar_orientation(exact(u), exact(v), exact(p), exact(q)) == CGAL::POSITIVE;
    }
    return true;
}

bool spreadOut(const Facets& facets)
{
    Vec3d direction(0.0);
    for (const Facet& f : facets) direction += f.plane.normal();
    const double length = direction.length();
    if (!(length > 0)) return false;
    direction /= length;
    const Vec3d& centre = facets.front().corners[0];
    const Vec3d axis = std::abs(direction[0]) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    Vec3d x = axis.cross(direction);
    x /= x.length();
    const Vec3d y = direction.cross(x);
    int rounds = 0; // times that the rim crosses the positive x axis
    for (const Facet& f : facets) {
        const Vec3d a = f.corners[1] - centre, b = f.corners[2] - centre;
        const double ax = a.dot(x), ay = a.dot(y), bx = b.dot(x), by = b.dot(y), cross = ax * by - ay * bx;
        if (!(cross > 0 && cross * cross > 1e-24 * a.lengthSqr() * b.lengthSqr())) return false;
        rounds += ay < 0 && by >= 0; // a turn to the left by less than half a round
    }
    return rounds == 1;
}

} // namespace vdbcage::detail
