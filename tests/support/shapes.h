#pragma once

#include <cmath>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

/// Returns a box from `low` to `high`, six quads facing outward.
inline Mesh box(const openvdb::Vec3d& low, const openvdb::Vec3d& high)
{
    Mesh mesh;
    for (int corner = 0; corner < 8; ++corner) {
        mesh.points.emplace_back(corner & 1 ? high.x() : low.x(), corner & 2 ? high.y() : low.y(),
                                 corner & 4 ? high.z() : low.z());
    }
    mesh.quads = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return mesh;
}

/// Returns a closed sphere of `rings` x `2 rings` faces: quads with triangles at the poles, facing outward.
inline Mesh sphere(const openvdb::Vec3d& centre, double radius, int rings)
{
    const int around = 2 * rings;
    Mesh mesh;
    mesh.points.push_back(centre + openvdb::Vec3d(0, 0, radius));
    for (int ring = 1; ring < rings; ++ring) {
        for (int i = 0; i < around; ++i) {
            const double polar = detail::pi * ring / rings, azimuth = 2 * detail::pi * i / around;
            mesh.points.push_back(centre + radius * openvdb::Vec3d(std::sin(polar) * std::cos(azimuth),
                                                                   std::sin(polar) * std::sin(azimuth),
                                                                   std::cos(polar)));
        }
    }
    mesh.points.push_back(centre - openvdb::Vec3d(0, 0, radius));
    const auto at = [&](int ring, int i) {
        return static_cast<openvdb::Index32>(1 + (ring - 1) * around + (i + around) % around);
    };
    const auto south = static_cast<openvdb::Index32>(mesh.points.size() - 1);
    for (int i = 0; i < around; ++i) {
        mesh.triangles.emplace_back(0U, at(1, i), at(1, i + 1));
        for (int ring = 1; ring + 1 < rings; ++ring) {
            mesh.quads.emplace_back(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1));
        }
        mesh.triangles.emplace_back(south, at(rings - 1, i + 1), at(rings - 1, i));
    }
    return mesh;
}

/// Returns a closed torus around the z axis, `around` x `across` quads facing outward.
inline Mesh torus(double radius, double tube, int around, int across)
{
    Mesh mesh;
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            const double u = 2 * detail::pi * i / around, v = 2 * detail::pi * j / across;
            const double reach = radius + tube * std::cos(v);
            mesh.points.emplace_back(reach * std::cos(u), reach * std::sin(u), tube * std::sin(v));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<openvdb::Index32>((i % around) * across + j % across); };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j)
            mesh.quads.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return mesh;
}

/// Returns the mesh turned about the z axis through the origin.
inline Mesh turnedAboutZ(Mesh mesh, double degrees)
{
    const double angle = degrees * detail::pi / 180, c = std::cos(angle), s = std::sin(angle);
    for (openvdb::Vec3d& p : mesh.points) p = openvdb::Vec3d(c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]);
    return mesh;
}

/// Returns the mesh with every point scaled, then moved.
inline Mesh transformed(Mesh mesh, double scale, const openvdb::Vec3d& move)
{
    for (openvdb::Vec3d& point : mesh.points) point = scale * point + move;
    return mesh;
}

/// Returns both meshes in one.
inline Mesh joined(Mesh a, const Mesh& b)
{
    const auto offset = static_cast<openvdb::Index32>(a.points.size());
    a.points.insert(a.points.end(), b.points.begin(), b.points.end());
    for (const auto& t : b.triangles) a.triangles.emplace_back(t[0] + offset, t[1] + offset, t[2] + offset);
    for (const auto& q : b.quads) {
        a.quads.emplace_back(q[0] + offset, q[1] + offset, q[2] + offset, q[3] + offset);
    }
    return a;
}

inline bool sameMesh(const Mesh& a, const Mesh& b)
{
    return a.points == b.points && a.triangles == b.triangles && a.quads == b.quads;
}

} // namespace vdbcage::test
