#pragma once

#include <cstddef>
#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// The result of fillCavities().
struct FilledMask {
    std::shared_ptr<openvdb::MaskGrid> mask; ///< same transform, no other metadata
    /// Number of separate cavities that were filled. Two that touch by an edge or corner only are two.
    std::size_t cavities = 0;
};

/// Fills every cavity: all inactive voxels that no path of face-connected inactive voxels joins to the outside.
///
/// Voxels that float inside a cavity are swallowed with it. A cavity within it is a cavity of its own. Active tiles and
/// wide empty space are never made dense. The work is TBB-parallel within blocks of 128^3 voxels; the result is the
/// same for any number of threads.
/// \param mask active voxels in [-2^30, 2^30)
/// \param interrupter told of progress; may be null
/// \throw InputError when active voxels are out of that range
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(nodes of the tree); up to 72 bytes a leaf beside the two trees.
VDBCAGE_API FilledMask fillCavities(const openvdb::MaskGrid& mask, Interrupter* interrupter = nullptr);

} // namespace vdbcage
