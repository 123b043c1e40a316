#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// `mask` and its mirror image across `axis` (0, 1, 2: x, y, z): a voxel with the index i along the axis has its image
/// at `sum` - i. Symmetric, and the least such mask that holds `mask`. Same transform, no other metadata; tiles stay
/// tiles where the image of one is one. Serial, O(active voxels outside of tiles).
/// \throw InputError (axis), Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr withMirrorImage(const openvdb::MaskGrid& mask, int axis, int sum,
                                                   Interrupter* interrupter = nullptr);

} // namespace vdbcage
