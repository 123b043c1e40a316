#pragma once

#include <memory>
#include <sstream>
#include <utility>

#include <openvdb/openvdb.h>

namespace vdbcage::detail {

/// A copy of `transform`. Not Transform::copy: that refuses voxels smaller than some 1e-5, which can be written and read.
inline openvdb::math::Transform::Ptr copyTransform(const openvdb::math::Transform& transform)
{
    openvdb::initialize(); // the registry of maps
    std::stringstream stream(std::ios::in | std::ios::out | std::ios::binary);
    transform.write(stream);
    auto copy = std::make_shared<openvdb::math::Transform>();
    copy->read(stream);
    return copy;
}

/// A grid around `tree` with a copy of the transform of `source`, and no metadata.
inline openvdb::MaskGrid::Ptr maskGridLike(const openvdb::GridBase& source, openvdb::MaskTree::Ptr tree)
{
    auto grid = openvdb::MaskGrid::create(std::move(tree));
    grid->setTransform(copyTransform(source.transform()));
    return grid;
}

} // namespace vdbcage::detail
