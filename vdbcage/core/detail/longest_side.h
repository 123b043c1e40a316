#pragma once

#include <openvdb/math/BBox.h>

namespace vdbcage::detail {

/// Returns the longest side of `box`: the unit of most lengths. It is negative if the box is empty.
inline double longestSide(const openvdb::BBoxd& box)
{
    return box.extents()[static_cast<int>(box.maxExtent())];
}

} // namespace vdbcage::detail
