#include <vdbcage/deform/detail/triangles.h>

#include <algorithm>

namespace vdbcage::detail {

std::vector<openvdb::Vec3I> triangulateByShorterDiagonal(const Mesh& cage)
{
    std::vector<openvdb::Vec3I> triangles = cage.triangles;
    triangles.reserve(triangles.size() + 2 * cage.quads.size());
    for (const openvdb::Vec4I& q : cage.quads) {
        const auto diagonal = [&](int i) { return (cage.points[q[i]] - cage.points[q[i + 2]]).lengthSqr(); };
        const double first = diagonal(0), second = diagonal(1);
        const bool leastIsFirst = std::min(q[0], q[2]) < std::min(q[1], q[3]);
        const int from = first < second || (first == second && leastIsFirst) ? 0 : 1;
        const auto corner = [&](int i) { return q[(from + i) % 4]; };
        triangles.emplace_back(corner(0), corner(1), corner(2));
        triangles.emplace_back(corner(0), corner(2), corner(3));
    }
    return triangles;
}

double sixfoldVolume(const std::vector<openvdb::Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles)
{
    double volume = 0; // relative to one of the points, so that no digits are lost far from the origin
    for (const openvdb::Vec3I& t : triangles) {
        const openvdb::Vec3d& apex = points[triangles.front()[0]];
        volume += (points[t[0]] - apex).dot((points[t[1]] - apex).cross(points[t[2]] - apex));
    }
    return volume;
}

} // namespace vdbcage::detail
