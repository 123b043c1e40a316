#pragma once

#include <utility>

#include <openvdb/openvdb.h>

namespace vdbcage::detail {

/// A grid around `tree` with a copy of the transform of `source`, and no metadata.
inline openvdb::MaskGrid::Ptr maskGridLike(const openvdb::GridBase& source, openvdb::MaskTree::Ptr tree)
{
    auto grid = openvdb::MaskGrid::create(std::move(tree));
    grid->setTransform(source.transform().copy());
    return grid;
}

} // namespace vdbcage::detail
