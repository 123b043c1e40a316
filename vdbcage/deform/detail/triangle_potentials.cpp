// Based on: Wilton and others, "Potential Integrals for Uniform and Linear Source Distributions on Polygonal and
// Polyhedral Domains", 1984; for solid angles van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", 1983.

#include <vdbcage/deform/detail/triangle_potentials.h>

#include <algorithm>
#include <cmath>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

/// Returns the integral of 1 / distance from the origin along the edge from `a` to `b`; 0 if it would be infinite.
double edgePotential(const Vec3d& a, const Vec3d& b)
{
    const Vec3d edge = b - a;
    const double length = edge.length();
    if (!(length > 0)) return 0;
    const Vec3d along = edge / length;
    const double square = along.cross(a).lengthSqr();
    // |a| + |b| - length without cancellation: each distance minus its share of the edge.
    const auto excess = [&](double distance, double share) {
        return share > 0 ? square / (distance + share) : distance - share;
    };
    const double gap = excess(a.length(), -a.dot(along)) + excess(b.length(), b.dot(along));
    return gap > 0 ? std::log1p(2 * length / gap) : 0;
}

} // namespace

bool isSliver(const Vec3d& a, const Vec3d& b)
{
    const double longest = std::max({a.lengthSqr(), b.lengthSqr(), (a - b).lengthSqr()});
    return !(a.cross(b).length() > sliverWidth * longest);
}

double halfSolidAngle(const Vec3d& a, const Vec3d& b, const Vec3d& c, double determinant)
{
    const double la = a.length(), lb = b.length(), lc = c.length();
    return std::atan2(determinant, la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

TrianglePotentials trianglePotentials(const std::array<Vec3d, 3>& c, bool onFace)
{
    TrianglePotentials t;
    const Vec3d areaNormal = (c[1] - c[0]).cross(c[2] - c[0]);
    t.area = areaNormal.length();
    t.normal = areaNormal / t.area;
    t.height = t.solid = 0;
    if (!onFace) {
        t.height = t.normal.dot(c[0]);
        t.solid = 2 * halfSolidAngle(c[0], c[1], c[2], c[0].dot(c[1].cross(c[2])));
    }
    t.single = -t.height * t.solid;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d &from = c[i], &to = c[(i + 1) % 3];
        t.along[i] = to - from;
        t.along[i] /= t.along[i].length();
        t.edge[i] = edgePotential(from, to);
        t.foot[i] = t.outward(i).dot(from);
        t.single += t.foot[i] * t.edge[i];
    }
    Vec3d turned(0);
    for (std::size_t i = 0; i < 3; ++i) turned += t.edge[i] * t.along[i];
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d &from = c[(i + 1) % 3], &to = c[(i + 2) % 3];
        const double atFoot = t.normal.dot(from.cross(to)) / t.area;
        t.hatSolid[i] = atFoot * t.solid + t.height * turned.dot(to - from) / t.area;
    }
    return t;
}

} // namespace vdbcage::detail
