#include <vdbcage/volume/mirror.h>

#include <cstddef>
#include <memory>
#include <string>

#include <openvdb/tools/Prune.h>
#include <openvdb/tree/ValueAccessor.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

openvdb::MaskGrid::Ptr withMirrorImage(const openvdb::MaskGrid& mask, int axis, int sum, Interrupter* interrupter)
{
    using openvdb::Coord;
    if (axis < 0 || axis > 2) {
        throw InputError("axis", std::to_string(axis) + " is not allowed; it must be 0, 1 or 2");
    }
    const auto a = static_cast<std::size_t>(axis); // the index in OpenVDB's Coord
    const auto image = [&](Coord voxel) {
        voxel[a] = sum - voxel[a];
        return voxel;
    };
    const openvdb::MaskGrid::Ptr result = detail::maskGridLike(mask, detail::maskTreeLike(mask.tree()));
    openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(result->tree());
    for (auto leaf = mask.tree().cbeginLeaf(); leaf; ++leaf) {
        throwIfInterrupted(interrupter);
        for (auto voxel = leaf->cbeginValueOn(); voxel; ++voxel) accessor.setValueOn(image(voxel.getCoord()));
    }
    accessor.clear();
    auto tile = mask.tree().cbeginValueOn();
    tile.setMaxDepth(openvdb::MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        throwIfInterrupted(interrupter);
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        Coord low = box.min(), high = box.max();
        low[a] = sum - box.max()[a];
        high[a] = sum - box.min()[a];
        result->tree().fill(openvdb::CoordBBox(low, high), true, true);
    }
    detail::isolated([&] { openvdb::tools::prune(result->tree()); });
    return result;
}

} // namespace vdbcage
