#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// The contour of `mask`: its active voxels with a face neighbour that is not active. Same transform, no other
/// metadata. Full tiles are never made dense; TBB-parallel, O(nodes of the tree and entries on the faces of tiles).
/// \throw InputError (coordinates outside [-2^30, 2^30)), Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr contour(const openvdb::MaskGrid& mask, Interrupter* interrupter = nullptr);

} // namespace vdbcage
