#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/tree/ValueAccessor.h>
#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/interrupter.h>

/// The boundary of a well-composed mask, block by block of 8^3 voxels, before it becomes a mesh.
namespace vdbcage::detail {

using MaskAccessor = openvdb::tree::ValueAccessor<const openvdb::MaskTree>;

constexpr int surfaceBlockSide = 8;

/// The voxels of a block and the layer around it. Voxel (x, y, z) of the block, each in [-1, 8], is bit z + 1 of
/// rows[x + 1][y + 1].
struct Window {
    static constexpr int side = surfaceBlockSide + 2;
    static constexpr unsigned full = (1U << side) - 1;
    std::array<std::array<std::uint16_t, side>, side> rows;

    /// Returns whether all voxels have the same state, so that there is no surface here.
    bool uniform() const
    {
        unsigned any = 0, all = full;
        for (const auto& slab : rows) {
            for (const unsigned row : slab) {
                any |= row;
                all &= row;
            }
        }
        return any == 0 || all == full;
    }
};

Window readWindow(const MaskAccessor& tree, const openvdb::Coord& block);

/// Calls visit(i, accessor) for every i below `count`, in parallel; each task has its own accessor.
/// \throw Cancelled
template <typename Visit>
void forEachBlock(std::size_t count, const openvdb::MaskTree& tree, Interrupter* interrupter, const Visit& visit)
{
    parallelFor(tbb::blocked_range<std::size_t>(0, count, 64), [&](const auto& range) {
        throwIfInterrupted(interrupter);
        const MaskAccessor accessor(tree);
        for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i, accessor);
    });
}

void sortUnique(std::vector<openvdb::Coord>& coords);

/// Returns the origins of the 8^3 blocks that have active voxels and touch a surface, sorted. Only the blocks of the
/// outer layer of an active tile can.
/// \throw InputError active voxels outside [-2^30, 2^30); more than 2^22 blocks; more than 2^26 to examine, which are
/// the leaves and the outer layers of tiles
/// \throw Cancelled
std::vector<openvdb::Coord> surfaceBlocks(const openvdb::MaskTree& tree, Interrupter* interrupter);

/// The quads and points of the boundary of a well-composed mask, numbered in the order of their blocks.
class SurfaceBlocks {
public:
    /// \throw InputError as surfaceBlocks; more than 10^8 quads, so that 32 bits number the points
    /// \throw Cancelled
    SurfaceBlocks(const openvdb::MaskTree& tree, Interrupter* interrupter);

    std::size_t size() const { return blocks_.size(); }
    std::size_t pointCount() const { return points_; }
    std::size_t quadCount() const { return quads_; }

    /// Calls visit(number, corner) for each point of block i. The point is at the low end of voxel `corner`.
    template <typename Visit>
    void forEachPoint(std::size_t i, const Visit& visit) const
    {
        const Block& block = blocks_[i];
        for (int x = 0; x < surfaceBlockSide; ++x) {
            std::size_t point = block.firstPoint[std::size_t(x)];
            const std::uint64_t corners = block.corners[std::size_t(x)];
            for (int bit = 0; bit < 64; ++bit) {
                if (corners >> bit & 1U) visit(point++, origins_[i].offsetBy(x, bit >> 3, bit & 7));
            }
        }
    }
    /// Calls visit(number, points) for each quad of block i. Points are counter-clockwise from outside.
    template <typename Visit>
    void forEachQuad(std::size_t i, const Visit& visit) const
    {
        const Block& block = blocks_[i];
        if (block.quadCount == 0) return;
        const Around around = blocksAround(i);
        std::size_t quad = block.firstQuad;
        forEachFace(block.window, [&](int x, int y, int z, const FaceCorners& corners) {
            openvdb::Vec4I points;
            for (int n = 0; n < 4; ++n) {
                const auto& step = corners[std::size_t(n)];
                points[n] = pointAt(around, x + step[0], y + step[1], z + step[2]);
            }
            visit(quad++, points);
        });
    }

private:
    /// A face's four corners as steps from the voxel's low corner, counter-clockwise from outside.
    using FaceCorners = std::array<std::array<int, 3>, 4>;
    static const std::array<FaceCorners, 6> faces;

    /// The part of the surface in one block: its corners of voxels and its faces.
    struct Block {
        Window window;
        /// Bit 8 y + z of [x] is the corner at the low end of voxel (x, y, z). It is set if the corner is on the
        /// surface: the eight voxels around it do not all have the same state.
        std::array<std::uint64_t, surfaceBlockSide> corners;
        std::array<openvdb::Index32, surfaceBlockSide> firstPoint; ///< number of the first point of each x
        std::size_t pointCount = 0;
        std::size_t firstQuad = 0, quadCount = 0;
    };
    /// A block and the seven that follow it along the axes, which have the points of its faces.
    using Around = std::array<const Block*, 8>;

    /// Calls visit(x, y, z, face) for every face between an active voxel of the block and an inactive one.
    template <typename Visit>
    static void forEachFace(const Window& window, const Visit& visit)
    {
        for (std::size_t x = 1; x <= surfaceBlockSide; ++x) {
            for (std::size_t y = 1; y <= surfaceBlockSide; ++y) {
                const unsigned row = window.rows[x][y];
                if (!(row & 0x1feU)) continue;
                const std::array<unsigned, 6> beside = {window.rows[x - 1][y],
                                                        window.rows[x + 1][y],
                                                        window.rows[x][y - 1],
                                                        window.rows[x][y + 1],
                                                        row << 1U,
                                                        row >> 1U};
                for (std::size_t face = 0; face < faces.size(); ++face) {
                    const unsigned exposed = row & ~beside[face] & 0x1feU;
                    for (int z = 0; exposed >> (z + 1); ++z) {
                        if (exposed >> (z + 1) & 1U) visit(int(x) - 1, int(y) - 1, z, faces[face]);
                    }
                }
            }
        }
    }

    static openvdb::Index32 pointAt(const Around& around, int x, int y, int z)
    {
        const Block& owner = *around[std::size_t((x >> 3) << 2 | (y >> 3) << 1 | z >> 3)];
        const std::size_t slab = std::size_t(x & 7);
        const std::uint64_t before = (std::uint64_t(1) << ((y & 7) * surfaceBlockSide + (z & 7))) - 1;
        return owner.firstPoint[slab] + openvdb::Index32(__builtin_popcountll(owner.corners[slab] & before));
    }

    static void findCorners(Block& block);
    Around blocksAround(std::size_t i) const;
    void number();

    std::vector<openvdb::Coord> origins_; // sorted
    std::vector<Block> blocks_;
    std::size_t points_ = 0, quads_ = 0;
};

} // namespace vdbcage::detail
