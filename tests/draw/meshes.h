#pragma once

#include <cmath>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

/// A cube with corners at +-1: six quads.
inline Mesh cube()
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.points.emplace_back((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0, (i & 4) != 0 ? 1.0 : -1.0);
    }
    mesh.quads = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return mesh;
}

/// A sphere of radius 1: each side of a cube cut into n x n quads, its points pushed out. Sides do not share points.
inline Mesh sphere(unsigned n)
{
    const Mesh box = cube();
    Mesh mesh;
    for (const openvdb::Vec4I& side : box.quads) {
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        const openvdb::Vec3d origin = box.points[side[0]];
        for (unsigned j = 0; j <= n; ++j) {
            for (unsigned i = 0; i <= n; ++i) {
                const openvdb::Vec3d point = origin + (box.points[side[1]] - origin) * (double(i) / n) +
                                             (box.points[side[3]] - origin) * (double(j) / n);
                mesh.points.push_back(point / point.length());
            }
        }
        for (unsigned j = 0; j < n; ++j) {
            for (unsigned i = 0; i < n; ++i) {
                const openvdb::Index32 corner = first + j * (n + 1) + i;
                mesh.quads.emplace_back(corner, corner + 1, corner + n + 2, corner + n + 1);
            }
        }
    }
    return mesh;
}

inline Mesh moved(Mesh mesh, double scale, const openvdb::Vec3d& shift = openvdb::Vec3d(0))
{
    for (openvdb::Vec3d& point : mesh.points) point = scale * point + shift;
    return mesh;
}

} // namespace vdbcage::test
