#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/volume/detail/mask_blocks.h>
#include <vdbcage/volume/detail/progress.h>

namespace vdbcage::detail {

/// The rough place of the contour voxels of one entry.
struct ContourLeaf {
    std::uint16_t entry;               ///< of the block
    BitBox box;                        ///< of the voxels, in the entry
    std::array<std::int8_t, 3> sample; ///< one of the voxels, near the middle of them
};

/// The contour leaves within one 32^3 part of a block.
struct ContourGroup {
    openvdb::CoordBBox box; ///< of the voxels
    std::size_t begin, end; ///< in ContourBlock::leaves
};

struct ContourBlock {
    Coord origin;
    openvdb::CoordBBox box; ///< of the voxels
    std::vector<ContourLeaf> leaves;
    std::vector<Words> words; ///< the voxels of each leaf
    std::vector<ContourGroup> groups;
};

enum class ContourOf {
    mask,      ///< active voxels with an inactive face neighbour
    complement ///< inactive voxels with an active face neighbour
};

/// Returns the blocks with contour voxels of the mask or of its complement, sorted by origin.
/// \throw Cancelled
std::vector<ContourBlock> contourBlocks(const MaskTree& tree, ContourOf side, const Progress& progress);

} // namespace vdbcage::detail
