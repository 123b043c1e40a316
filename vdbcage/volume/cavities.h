#pragma once

#include <cstddef>

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// `mask` with every cavity filled: all inactive voxels that no path of face-connected inactive voxels joins to the
/// outside. `cavities`, if not null, gets the number of separate ones (two that touch by an edge or corner only are
/// two). What floats inside a cavity is swallowed with it; a cavity within it is a cavity of its own.
///
/// Same transform, no other metadata. Active tiles and wide empty space are never made dense. TBB-parallel within
/// blocks of 128^3 voxels, same result for any number of threads. O(nodes of the tree); up to 72 bytes a leaf beside
/// the two trees. \throw InputError (coordinates outside [-2^30, 2^30)), Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr fillCavities(const openvdb::MaskGrid& mask, std::size_t* cavities = nullptr,
                                                Interrupter* interrupter = nullptr);

} // namespace vdbcage
