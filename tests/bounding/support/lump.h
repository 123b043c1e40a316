#pragma once

#include <random>

#include <support/shapes.h>
#include <support/solids.h>
#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/volume/extract.h>

namespace vdbcage::test {

/// The surface of a random solid, and a guard that it bounds a speck in.
struct Lump {
    explicit Lump(unsigned seed)
        : model(box({0.45, 0.45, 0.45}, {0.55, 0.55, 0.55})), guard(model, close()),
          surface(extractSurface(*solid(seed)))
    {
    }
    static GuardOptions close()
    {
        GuardOptions options;
        options.clearance = 1e-6;
        options.minAngleDegrees = 1;
        return options;
    }
    static openvdb::MaskGrid::Ptr solid(unsigned seed)
    {
        auto grid = randomSolid(seed, 4, 0.6, openvdb::Coord(-1));
        grid->tree().setValueOn(openvdb::Coord(0));
        grid->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
        grid->transform().postTranslate(openvdb::Vec3d(0.5));
        return grid;
    }

    Mesh model;
    BoundingGuard guard;
    Mesh surface;
};

/// A model for the same surface: the speck, and some little triangles in each voxel, a part of the model each.
inline Mesh speckled(unsigned seed, int perVoxel)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-0.5, 0.5);
    const auto point = [&](double size) {
        const double x = unit(random), y = unit(random), z = unit(random);
        return size * openvdb::Vec3d(x, y, z);
    };
    Mesh specks = Lump(seed).model;
    const auto grid = Lump::solid(seed);
    for (auto voxel = grid->cbeginValueOn(); voxel; ++voxel) {
        for (int i = 0; i < perVoxel; ++i) {
            const openvdb::Vec3d centre = grid->indexToWorld(voxel.getCoord()) + point(0.9);
            const auto first = static_cast<openvdb::Index32>(specks.points.size());
            for (int k = 0; k < 3; ++k) specks.points.push_back(centre + point(0.04));
            specks.triangles.emplace_back(first, first + 1, first + 2);
        }
    }
    return specks;
}

} // namespace vdbcage::test
