#pragma once

#include <vdbcage/core/detail/grids.h>

/// What a user would close masks with otherwise; exact, TBB-parallel.
namespace vdbcage::bench {

/// The closing by a sphere of `radius` by two exact Euclidean distance transforms of the mask's dense box.
openvdb::MaskTree::Ptr closeByDenseDistances(const openvdb::MaskTree& mask, int radius);

/// The closing by a cube: OpenVDB's dilateActiveValues and erodeActiveValues, 26 neighbours, `radius` times each.
openvdb::MaskTree::Ptr closeByRepetition(const openvdb::MaskTree& mask, int radius);

} // namespace vdbcage::bench
