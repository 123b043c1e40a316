#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// `mask` and its mirror image across `axis` (0, 1, 2: x, y, z), united.
///
/// A voxel with the index i along the axis has its image at `sum` - i. The result is the smallest symmetric mask that
/// holds `mask`. It has the same transform and no other metadata. Tiles stay tiles where the image of one is one.
/// \throw InputError `axis` out of range
/// \throw Cancelled
/// Cost: O(active voxels outside of tiles), serial.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> withMirrorImage(const openvdb::MaskGrid& mask, int axis, int sum,
                                                               Interrupter* interrupter = nullptr);

} // namespace vdbcage
