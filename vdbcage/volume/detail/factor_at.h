#pragma once

#include <algorithm>
#include <cmath>

#include <openvdb/tools/Interpolation.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/volume/factor_field.h>

/// The value of a factor field at a place.
namespace vdbcage::detail {

constexpr double largestFactor = 8;

/// \throw InputError a factor or a radius out of range; a coordinate that is not finite
void requireValid(const FactorRegion& region);

/// \throw InputError as requireValid for a region; a value of the grid that is not finite; a transform that is not
/// linear
/// \throw Cancelled
/// Cost: O(values of the grid).
void requireValidDensity(const FactorField& field, Interrupter* interrupter);

bool contains(const FactorRegion& region, const openvdb::Vec3d& point);

/// Returns the field at a point of world space, clamped to 0 to 8. `values` is the tree of the grid or an accessor of
/// it; it is not used if there is no grid.
template <typename Values>
double factorAt(const FactorField& field, const Values* values, const openvdb::Vec3d& world)
{
    double value = 1;
    if (field.grid) {
        const openvdb::Vec3d index = field.grid->transform().worldToIndex(world);
        bool mayBeVoxel = true;
        for (int axis = 0; axis < 3; ++axis) mayBeVoxel = mayBeVoxel && std::abs(index[axis]) < 0x1p31 - 2;
        value = static_cast<double>(mayBeVoxel ? openvdb::tools::BoxSampler::sample(*values, index)
                                               : field.grid->background());
    }
    for (const FactorRegion& region : field.regions) {
        if (contains(region, world)) value *= region.factor;
    }
    return std::clamp(value, 0.0, largestFactor);
}

} // namespace vdbcage::detail
