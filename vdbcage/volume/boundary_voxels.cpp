#include <vdbcage/volume/boundary_voxels.h>

#include <utility>
#include <vector>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/volume/detail/contour_blocks.h>

namespace vdbcage {

openvdb::MaskGrid::Ptr contour(const openvdb::MaskGrid& mask, Interrupter* interrupter)
{
    using namespace detail;
    requireSupportedCoordinates(mask.tree());
    const std::vector<ContourBlock> blocks = contourBlocks(mask.tree(), ContourOf::mask, {interrupter});
    std::vector<BuiltBlock> built(blocks.size());
    detail::parallelFor(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter);
        BlockBuilder builder(blocks[i].origin);
        for (std::size_t n = 0; n < blocks[i].leaves.size(); ++n) {
            builder.set(blocks[i].leaves[n].entry, blocks[i].words[n].data());
        }
        built[i] = builder.finish();
    });
    return maskGridLike(mask, assemble({}, std::move(built)));
}

} // namespace vdbcage
