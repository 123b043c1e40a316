#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// All voxels whose centre lies in the convex hull of the active voxels of `mask`, each a whole cube, or within 1e-7
/// voxels of it; so the result is connected by faces. Same transform, no other metadata; empty for an empty mask.
/// Serial, O(a + c * f) for a active voxels (a tile: those of one side), c columns of voxels along z in the bounding
/// box and f facets of the hull; 8 bytes a column. \throw Cancelled, Error (an extent of more than 2^20 voxels, more
/// than 2^28 columns)
VDBCAGE_API openvdb::MaskGrid::Ptr convexHull(const openvdb::MaskGrid& mask, Interrupter* interrupter = nullptr);

} // namespace vdbcage
