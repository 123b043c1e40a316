#pragma once

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

/// The voxels p with a voxel q of `mask` such that max |p - q| <= radius.
MaskTree::Ptr dilateByCube(const MaskTree& mask, int radius, const Progress& progress);

/// The voxels p such that every q with max |p - q| <= radius is in `mask`.
MaskTree::Ptr erodeByCube(const MaskTree& mask, int radius, const Progress& progress);

} // namespace vdbcage::detail
