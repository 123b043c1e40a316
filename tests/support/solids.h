#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

/// Solids made of voxels, from implicit functions or at random.
namespace vdbcage::test {

using openvdb::Vec3d;

/// Returns the voxels of the unit cube around the origin, `resolution` along a side, for which `inside` (of a world
/// point) is true.
template <typename Inside>
openvdb::MaskGrid::Ptr sample(int resolution, const Inside& inside)
{
    auto grid = openvdb::MaskGrid::create();
    grid->setTransform(openvdb::math::Transform::createLinearTransform(1.0 / resolution));
    auto accessor = grid->getAccessor();
    const int half = resolution / 2 + 2;
    for (int x = -half; x <= half; ++x) {
        for (int y = -half; y <= half; ++y) {
            for (int z = -half; z <= half; ++z) {
                const openvdb::Coord voxel(x, y, z);
                if (inside(grid->indexToWorld(voxel))) accessor.setValueOn(voxel);
            }
        }
    }
    openvdb::tools::prune(grid->tree());
    return grid;
}

inline bool inSphere(const Vec3d& p, double radius = 0.45)
{
    return p.length() < radius;
}

inline bool inTorus(const Vec3d& p)
{
    return std::hypot(std::hypot(p.x(), p.y()) - 0.3, p.z()) < 0.13;
}

/// Returns the approximate distance to a cone-shaped limb from a (radius ra) to b (radius rb).
inline double limb(const Vec3d& p, const Vec3d& a, const Vec3d& b, double ra, double rb)
{
    const double t = std::clamp((p - a).dot(b - a) / (b - a).lengthSqr(), 0.0, 1.0);
    return (p - (a + (b - a) * t)).length() - (ra + (rb - ra) * t);
}

/// Returns whether p is in a four-legged animal with horns and a tail, its limbs blended into one skin.
inline bool inCreature(const Vec3d& p)
{
    const auto blend = [](double a, double b) {
        const double k = 0.06, h = std::max(k - std::abs(a - b), 0.0) / k;
        return std::min(a, b) - h * h * k / 4;
    };
    const Vec3d q(p.x(), p.y(), std::abs(p.z()));
    double d = limb(p, {-0.22, 0.02, 0}, {0.16, 0.05, 0}, 0.13, 0.12);
    d = blend(d, limb(p, {0.16, 0.06, 0}, {0.33, 0.22, 0}, 0.08, 0.07));
    d = blend(d, limb(p, {0.33, 0.22, 0}, {0.45, 0.17, 0}, 0.085, 0.04));
    d = blend(d, limb(q, {0.14, 0, 0.09}, {0.17, -0.38, 0.12}, 0.06, 0.035));
    d = blend(d, limb(q, {-0.22, 0, 0.09}, {-0.25, -0.38, 0.12}, 0.07, 0.035));
    d = blend(d, limb(q, {0.32, 0.28, 0.03}, {0.27, 0.44, 0.13}, 0.03, 0.012));
    d = blend(d, limb(p, {-0.32, 0.06, 0}, {-0.46, 0.22, 0}, 0.035, 0.015));
    return d < 0;
}

/// Returns a cube of `side` voxels at `low`, each active with the given probability.
inline openvdb::MaskGrid::Ptr randomSolid(std::uint32_t seed, int side, double density, const openvdb::Coord& low)
{
    std::mt19937 random(seed);
    const double limit = density * double(random.max());
    auto grid = openvdb::MaskGrid::create();
    auto accessor = grid->getAccessor();
    for (int n = 0; n < side * side * side; ++n) {
        if (double(random()) < limit) accessor.setValueOn(low.offsetBy(n / side / side, n / side % side, n % side));
    }
    return grid;
}

} // namespace vdbcage::test
