#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// Returns the contour of a mask: its active voxels with a face neighbour that is not active.
///
/// The result has the same transform and no other metadata. Full tiles are never made dense.
/// \param mask active voxels in [-2^30, 2^30)
/// \param interrupter told of progress; may be null
/// \throw InputError when active voxels are out of that range
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(nodes of the tree + entries on the faces of tiles), in parallel.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> contour(const openvdb::MaskGrid& mask,
                                                       Interrupter* interrupter = nullptr);

} // namespace vdbcage
