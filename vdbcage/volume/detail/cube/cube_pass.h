#pragma once

#include <initializer_list>

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

/// One dilation or erosion by the cube of the voxels within `radius` along every axis.
struct CubeStep {
    enum Kind { dilation, erosion } kind;
    int radius; ///< in voxels
};

/// Returns the mask after the steps, one after the other. Only the last result becomes a tree.
/// \throw Cancelled
/// Cost: O(blocks on the mask's surface) for each step, for any radius.
MaskTree::Ptr applyCube(const MaskTree& mask, std::initializer_list<CubeStep> steps, const Progress& progress);

} // namespace vdbcage::detail
