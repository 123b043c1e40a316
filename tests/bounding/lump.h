#pragma once

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

} // namespace vdbcage::test
