#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// The contour of `mask`: its active voxels with a face neighbour that is not active. It has the same transform and no
/// other metadata. Full tiles are never made dense.
/// \throw InputError active voxels outside [-2^30, 2^30)
/// \throw Cancelled
/// Cost: O(nodes of the tree + entries on the faces of tiles), in parallel.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> contour(const openvdb::MaskGrid& mask,
                                                       Interrupter* interrupter = nullptr);

} // namespace vdbcage
