#include <vdbcage/volume/detail/boundary_topology.h>

#include <vdbcage/geometry/union_find.h>
#include <vdbcage/volume/detail/surface_blocks.h>
#include <vdbcage/volume/extract.h>

namespace vdbcage::detail {

BoundaryTopology boundaryTopology(const openvdb::MaskGrid& solid, Interrupter* interrupter)
{
    const openvdb::MaskGrid::Ptr grid = makeWellComposed(solid, interrupter);
    const SurfaceBlocks blocks(grid->tree(), interrupter);
    UnionFind parts(blocks.pointCount());
    forEachBlock(blocks.size(), grid->tree(), interrupter, [&](std::size_t i, const MaskAccessor&) {
        blocks.forEachQuad(i, [&](std::size_t, const openvdb::Vec4I& points) {
            for (int n = 1; n < 4; ++n) parts.unite(points[0], points[n]);
        });
    });
    std::size_t components = 0;
    for (std::uint32_t point = 0; point < blocks.pointCount(); ++point) components += parts.find(point) == point;
    // Each quad has four edges and each edge two quads.
    const auto euler = std::int64_t(blocks.pointCount()) - std::int64_t(blocks.quadCount());
    return {components, std::int64_t(components) - euler / 2};
}

} // namespace vdbcage::detail
