#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// Returns the union of a mask and its mirror image: the smallest symmetric mask that holds it.
///
/// A voxel with the index i along the axis has its image at `sum` - i. The result has the same transform and no other
/// metadata. Tiles stay tiles where the image of one is one.
/// \param mask any mask; its active voxels count
/// \param axis 0, 1, 2: x, y, z
/// \param sum of the index of a voxel and that of its image, along the axis
/// \param interrupter asked whether to stop; may be null
/// \throw InputError when `axis` is out of range
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(active voxels outside of tiles), serial.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> withMirrorImage(const openvdb::MaskGrid& mask, int axis, int sum,
                                                               Interrupter* interrupter = nullptr);

} // namespace vdbcage
