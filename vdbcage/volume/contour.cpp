#include <vdbcage/volume/contour.h>

#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include <vdbcage/volume/detail/contour_leaves.h>
#include <vdbcage/core/detail/mask_grid.h>

namespace vdbcage {

openvdb::MaskGrid::Ptr contour(const openvdb::MaskGrid& mask, Interrupter* interrupter)
{
    using namespace detail;
    requireSupportedCoordinates(mask.tree());
    const std::vector<ContourBlock> blocks = contourBlocks(mask.tree(), ContourOf::mask, {interrupter});
    std::vector<BuiltBlock> built(blocks.size());
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter);
        BlockBuilder builder(blocks[i].origin);
        for (const ContourLeaf& leaf : blocks[i].leaves) {
            builder.set(static_cast<int>(MaskBlock::coordToOffset(leaf.origin)), leaf.words.data());
        }
        built[i] = builder.finish();
    });
    return maskGridLike(mask, assemble({}, std::move(built)));
}

} // namespace vdbcage
