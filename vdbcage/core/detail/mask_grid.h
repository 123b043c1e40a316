#pragma once

#include <memory>
#include <utility>

#include <openvdb/openvdb.h>

namespace vdbcage::detail {

/// Gives `grid` a copy of the transform of `source`. Where voxels are smaller than some 1e-5 the two share one: OpenVDB
/// can read and write it, but refuses to copy it.
inline void copyTransform(const openvdb::GridBase& source, openvdb::GridBase& grid)
{
    try {
        grid.setTransform(source.transform().copy());
    } catch (const openvdb::ArithmeticError&) {
        grid.setTransform(std::const_pointer_cast<openvdb::math::Transform>(source.constTransformPtr()));
    }
}

/// A grid around `tree` with a copy of the transform of `source`, and no metadata.
inline openvdb::MaskGrid::Ptr maskGridLike(const openvdb::GridBase& source, openvdb::MaskTree::Ptr tree)
{
    auto grid = openvdb::MaskGrid::create(std::move(tree));
    copyTransform(source, *grid);
    return grid;
}

} // namespace vdbcage::detail
