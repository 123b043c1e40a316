#pragma once

#include <vdbcage/core/detail/grids.h>

/// Other ways to close masks; exact, TBB-parallel.
namespace vdbcage::bench {

/// Returns the closing by a sphere of `radius`, by two exact Euclidean distance transforms of the mask's dense box.
openvdb::MaskTree::Ptr closeByDenseDistances(const openvdb::MaskTree& mask, int radius);

/// Returns the closing by a cube, by OpenVDB's dilateActiveValues and erodeActiveValues, 26 neighbours, `radius` times
/// each.
openvdb::MaskTree::Ptr closeByRepetition(const openvdb::MaskTree& mask, int radius);

} // namespace vdbcage::bench
