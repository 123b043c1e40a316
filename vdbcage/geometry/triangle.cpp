// Based on: C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5 (closest point on a triangle).
#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

namespace {

Vec3d closestPointOnSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b)
{
    const Vec3d ab = b - a;
    const double length2 = ab.dot(ab);
    const double t = length2 > 0 ? std::clamp(ab.dot(p - a) / length2, 0.0, 1.0) : 0.0;
    return a + t * ab;
}

} // namespace

Box Box::of(const Corners& t)
{
    return {openvdb::math::minComponent(t[0], openvdb::math::minComponent(t[1], t[2])),
            openvdb::math::maxComponent(t[0], openvdb::math::maxComponent(t[1], t[2]))};
}

void Box::expand(const Box& other)
{
    lo = openvdb::math::minComponent(lo, other.lo);
    hi = openvdb::math::maxComponent(hi, other.hi);
}

Vec3d closestPointOnTriangle(const Vec3d& p, const Corners& triangle)
{
    // The region of seven above which p lies: a corner's, an edge's or the inside's.
    const auto& [a, b, c] = triangle;
    const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double wa = d3 * d6 - d5 * d4, wb = d5 * d2 - d1 * d6, wc = d1 * d4 - d3 * d2;
    if (wa > 0 && wb > 0 && wc > 0) return a + (wb / (wa + wb + wc)) * ab + (wc / (wa + wb + wc)) * ac;
    if (wc <= 0 && d1 > 0 && d3 < 0) return a + (d1 / (d1 - d3)) * ab;
    if (wb <= 0 && d2 > 0 && d6 < 0) return a + (d2 / (d2 - d6)) * ac;
    if (wa <= 0 && d4 > d3 && d5 > d6) return b + ((d4 - d3) / (d4 - d3 + d5 - d6)) * (c - b);
    // Only for degenerate or nearly degenerate triangles: the nearest point of the three edges.
    Vec3d best = closestPointOnSegment(p, a, b);
    for (const Vec3d& other : {closestPointOnSegment(p, b, c), closestPointOnSegment(p, c, a)}) {
        if ((other - p).lengthSqr() < (best - p).lengthSqr()) best = other;
    }
    return best;
}

Vec3d barycentric(const Vec3d& p, const Corners& t)
{
    const Vec3d u = t[1] - t[0], v = t[2] - t[0], w = p - t[0];
    const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
    const double determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) return Vec3d(0.0);
    const double b = (wu * vv - wv * uv) / determinant, c = (wv * uu - wu * uv) / determinant;
    return {1 - b - c, b, c};
}

} // namespace vdbcage::detail
