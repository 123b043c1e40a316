// Based on: Latecki, 3D Well-Composed Pictures, Graphical Models and Image Processing 59(3), 1997.
// Differs: repaired by adding voxels only, never by changing the sampling, and found with bit operations on 8^3 blocks.

#include <vdbcage/volume/extract.h>

#include <array>
#include <vector>

#include <openvdb/tree/ValueAccessor.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/surface_blocks.h>

namespace vdbcage {

namespace {

using detail::MaskAccessor;
using detail::Window;
using openvdb::Coord;

/// Returns the voxel to add in the box of voxels at `low` with the given sides: the inactive one with most active face
/// neighbours (adding it makes the least new surface), the first in order x, y, z.
Coord voxelToAdd(const MaskAccessor& tree, const Coord& low, const Coord& sides)
{
    Coord best = low;
    int bestNeighbours = -1;
    for (int x = 0; x < sides.x(); ++x) {
        for (int y = 0; y < sides.y(); ++y) {
            for (int z = 0; z < sides.z(); ++z) {
                const Coord voxel = low.offsetBy(x, y, z);
                if (tree.isValueOn(voxel)) continue;
                const int neighbours =
                    tree.isValueOn(voxel.offsetBy(-1, 0, 0)) + tree.isValueOn(voxel.offsetBy(1, 0, 0)) +
                    tree.isValueOn(voxel.offsetBy(0, -1, 0)) + tree.isValueOn(voxel.offsetBy(0, 1, 0)) +
                    tree.isValueOn(voxel.offsetBy(0, 0, -1)) + tree.isValueOn(voxel.offsetBy(0, 0, 1));
                if (neighbours > bestNeighbours) {
                    bestNeighbours = neighbours;
                    best = voxel;
                }
            }
        }
    }
    return best;
}

/// Adds to `added` one voxel for each critical configuration that overlaps the block: a 2x2 square whose one
/// diagonal pair differs from the other, or a 2x2x2 cube of which one space-diagonal pair differs from the other six.
void findCritical(const MaskAccessor& tree, const Coord& block, std::vector<Coord>& added)
{
    const Window window = detail::readWindow(tree, block);
    if (window.uniform()) return;
    const auto add = [&](int x, int y, unsigned bits, const Coord& sides) {
        for (int z = 0; bits >> z; ++z) {
            if (bits >> z & 1U) added.push_back(voxelToAdd(tree, block.offsetBy(x - 1, y - 1, z - 1), sides));
        }
    };
    const auto square = [](unsigned a, unsigned b, unsigned c, unsigned d) { return (a ^ b) & (a ^ c) & ~(a ^ d); };
    constexpr unsigned pairs = Window::full >> 1; // where voxel z + 1 is in the window too
    for (int x = 0; x < Window::side; ++x) {
        for (int y = 0; y < Window::side; ++y) {
            const auto row = [&](int dx, int dy) -> unsigned {
                return window.rows[std::size_t(x + dx)][std::size_t(y + dy)];
            };
            const bool nextX = x + 1 < Window::side, nextY = y + 1 < Window::side;
            const unsigned a = row(0, 0);
            if (nextX) add(x, y, square(a, row(1, 0), a >> 1, row(1, 0) >> 1) & pairs, Coord(2, 1, 2));
            if (nextY) add(x, y, square(a, row(0, 1), a >> 1, row(0, 1) >> 1) & pairs, Coord(1, 2, 2));
            if (!nextX || !nextY) continue;
            add(x, y, square(a, row(1, 0), row(0, 1), row(1, 1)) & Window::full, Coord(2, 2, 1));
            const std::array<unsigned, 8> cube = {a,      row(0, 1),      row(1, 0),      row(1, 1),
                                                  a >> 1, row(0, 1) >> 1, row(1, 0) >> 1, row(1, 1) >> 1};
            for (unsigned i = 0; i < 4; ++i) {
                unsigned critical = pairs;
                for (unsigned j = 0; j < 8; ++j) {
                    const unsigned differs = cube[i] ^ cube[j];
                    critical &= j == i || j == 7 - i ? ~differs : differs;
                }
                add(x, y, critical, Coord(2, 2, 2));
            }
        }
    }
}

} // namespace

openvdb::MaskGrid::Ptr makeWellComposed(const openvdb::MaskGrid& solid, Interrupter* interrupter)
{
    const openvdb::MaskGrid::Ptr result = detail::maskGridLike(solid, detail::maskTreeLike(solid.tree()));
    openvdb::MaskTree& tree = result->tree();
    // Voxels are added only inside the box of those that exist, so this ends.
    for (std::vector<Coord> blocks = detail::surfaceBlocks(tree, interrupter); !blocks.empty();) {
        std::vector<std::vector<Coord>> found(blocks.size());
        detail::forEachBlock(blocks.size(), tree, interrupter, [&](std::size_t i, const MaskAccessor& accessor) {
            findCritical(accessor, blocks[i], found[i]);
        });
        // The voxels found depend only on the state before the round: the order does not matter.
        blocks.clear();
        openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(tree);
        for (const std::vector<Coord>& voxels : found) {
            for (const Coord& voxel : voxels) {
                accessor.setValueOn(voxel);
                blocks.push_back(voxel & ~(detail::surfaceBlockSide - 1));
            }
        }
        detail::sortUnique(blocks);
    }
    return result;
}

Mesh extractSurface(const openvdb::MaskGrid& solid, Interrupter* interrupter)
{
    const openvdb::math::Transform& transform = solid.transform();
    if (!transform.isLinear()) throw InputError("the grid's transform is a frustum; it must be linear");

    const openvdb::MaskGrid::Ptr grid = makeWellComposed(solid, interrupter);
    const detail::SurfaceBlocks blocks(grid->tree(), interrupter);
    Mesh mesh;
    mesh.points.resize(blocks.pointCount());
    mesh.quads.resize(blocks.quadCount());
    const bool mirrored = transform.baseMap()->determinant() < 0;
    detail::forEachBlock(blocks.size(), grid->tree(), interrupter, [&](std::size_t i, const MaskAccessor&) {
        blocks.forEachPoint(i, [&](std::size_t point, const Coord& corner) {
            mesh.points[point] = transform.indexToWorld(corner.asVec3d() - openvdb::Vec3d(0.5));
        });
        blocks.forEachQuad(i, [&](std::size_t quad, const openvdb::Vec4I& points) {
            mesh.quads[quad] = mirrored ? openvdb::Vec4I(points[3], points[2], points[1], points[0]) : points;
        });
    });
    return mesh;
}

} // namespace vdbcage
