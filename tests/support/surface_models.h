#pragma once

#include <random>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/volume/extract.h>

#include "support/solids.h"

namespace vdbcage::test {

/// Returns random triangles in a ball of radius 0.4: needles, crossings, one piece each.
inline Mesh soup(unsigned seed, int count, double size)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto point = [&](double radius) {
        for (;;) {
            const openvdb::Vec3d p(unit(random), unit(random), unit(random));
            if (p.length() < 1) return radius * p;
        }
    };
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const openvdb::Vec3d centre = point(0.4 - size);
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        for (int k = 0; k < 3; ++k) mesh.points.push_back(centre + point(size));
        if (i % 5 == 0) mesh.points.back() = mesh.points[first] + 1e-3 * point(size); // a needle
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

/// Returns a surface with a clearance around everything in the ball of radius 0.42.
inline Mesh ball(int resolution = 16)
{
    return extractSurface(*sample(resolution, [](const openvdb::Vec3d& p) { return inSphere(p, 0.48); }));
}

/// Returns a guard around `inside`, symmetric in the plane x = 0 if `isSymmetric`.
inline BoundingGuard guardOf(const Mesh& inside, bool isSymmetric)
{
    GuardOptions options;
    if (isSymmetric) options.symmetry = SymmetryPlane{0, 0};
    return BoundingGuard(inside, options);
}

} // namespace vdbcage::test
