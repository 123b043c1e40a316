#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// Returns all voxels whose centre lies in the convex hull of the active voxels, or within 1e-7 voxels of it.
///
/// Each active voxel counts as a whole cube, so the result is connected by faces. It has the same transform and no
/// other metadata. It is empty for an empty mask.
/// \param mask at most 2^20 voxels along each side of its box, and 2^28 columns
/// \param interrupter asked whether to stop; may be null
/// \throw Error when the mask is larger, or Qhull fails
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(a + c * f) for a active voxels (of a tile, those of one side), c columns of voxels along z in the bounding
/// box, and f facets of the hull. Serial; 8 bytes a column.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> convexHull(const openvdb::MaskGrid& mask,
                                                          Interrupter* interrupter = nullptr);

} // namespace vdbcage
