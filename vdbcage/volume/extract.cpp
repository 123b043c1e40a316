// Based on: Latecki, 3D Well-Composed Pictures, Graphical Models and Image Processing 59(3), 1997.
// Differs: repaired by adding voxels only, never by changing the sampling, and found with bit operations on 8^3 blocks.
#include <vdbcage/volume/extract.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>

#include <openvdb/tree/ValueAccessor.h>
#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

using openvdb::Coord;
using openvdb::Index32;
using Tree = openvdb::MaskTree;
using Accessor = openvdb::tree::ValueAccessor<const Tree>;

constexpr int blockSide = Tree::LeafNodeType::DIM;
static_assert(blockSide == 8, "the bit operations below are for 8^3 voxels");

/// The voxels of a block and the layer around it: voxel (x, y, z) of the block, each in [-1, 8], is bit z + 1 of
/// rows[x + 1][y + 1].
struct Window {
    static constexpr int side = blockSide + 2;
    static constexpr unsigned full = (1U << side) - 1;
    std::array<std::array<std::uint16_t, side>, side> rows;

    /// Whether every voxel has the same state: then there is no surface here.
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

Window readWindow(const Accessor& tree, const Coord& block)
{
    Window window;
    for (auto& slab : window.rows) slab.fill(0);
    const auto first = [](int step) { return step < 0 ? blockSide - 1 : 0; };
    const auto last = [](int step) { return step > 0 ? 0 : blockSide - 1; };
    for (int dx = -1; dx <= 1; ++dx) {
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dz = -1; dz <= 1; ++dz) {
                const Coord origin = block.offsetBy(dx * blockSide, dy * blockSide, dz * blockSide);
                const auto* leaf = tree.probeConstLeaf(origin);
                const bool tile = !leaf && tree.isValueOn(origin);
                if (!leaf && !tile) continue;
                for (int x = first(dx); x <= last(dx); ++x) {
                    const std::uint64_t slab =
                        leaf ? leaf->valueMask().getWord<std::uint64_t>(Index32(x)) : ~std::uint64_t(0);
                    for (int y = first(dy); y <= last(dy); ++y) {
                        const unsigned bits = unsigned(slab >> (blockSide * y)) & 0xffU;
                        const unsigned row = dz == 0 ? bits << 1 : dz < 0 ? bits >> 7 : (bits & 1U) << 9;
                        auto& target =
                            window.rows[std::size_t(x + dx * blockSide + 1)][std::size_t(y + dy * blockSide + 1)];
                        target = std::uint16_t(target | row);
                    }
                }
            }
        }
    }
    return window;
}

/// Calls visit(i, accessor) for every i below `count`, in parallel, each task with an accessor of its own.
template <typename Visit>
void forEach(std::size_t count, const Tree& tree, Interrupter* interrupter, const Visit& visit)
{
    detail::parallelFor(tbb::blocked_range<std::size_t>(0, count, 64), [&](const auto& range) {
        throwIfInterrupted(interrupter);
        const Accessor accessor(tree);
        for (std::size_t i = range.begin(); i != range.end(); ++i) visit(i, accessor);
    });
}

void sortUnique(std::vector<Coord>& coords)
{
    detail::parallelSort(coords.begin(), coords.end());
    coords.erase(std::unique(coords.begin(), coords.end()), coords.end());
}

// What a small file can ask for with tiles: more would take tens of gigabytes.
constexpr std::size_t mostCandidates = std::size_t(1) << 26, mostBlocks = std::size_t(1) << 22, mostQuads = 100000000;

void requireAtMost(std::size_t most, std::size_t count, const char* things)
{
    if (count <= most) return;
    throw InputError("the surface of the voxels is too large: " + std::to_string(count) + " " + things +
                     "; there may be " + std::to_string(most));
}

/// Steps from one voxel to another must not leave the range of coordinates.
void requireSupported(const openvdb::CoordBBox& box)
{
    constexpr int limit = 1 << 30;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (box.min()[axis] >= -limit && box.max()[axis] < limit) continue;
        std::ostringstream text;
        text << "there are active voxels near " << box.min() << "; coordinates must be in [-2^30, 2^30)";
        throw InputError(text.str());
    }
}

/// The origins of the 8^3 blocks that hold active voxels and touch a surface, sorted. Of an active tile only the
/// blocks of its outer layer can.
std::vector<Coord> surfaceBlocks(const Tree& tree, Interrupter* interrupter)
{
    std::vector<Coord> blocks;
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
        if (leaf->isEmpty()) continue;
        requireSupported(leaf->getNodeBoundingBox());
        blocks.push_back(leaf->origin());
    }
    std::size_t candidates = blocks.size();
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(Tree::ValueOnCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
        openvdb::CoordBBox box;
        tile.getBoundingBox(box);
        requireSupported(box);
        const auto side = static_cast<std::size_t>(box.dim().x() / blockSide),
                   inner = side - std::min(side, std::size_t(2));
        candidates += side * side * side - inner * inner * inner;
        requireAtMost(mostCandidates, candidates, "blocks of 8^3 voxels are outermost in tiles");
        const Coord low = box.min(), high = box.max().offsetBy(1 - blockSide);
        for (int x = low.x(); x <= high.x(); x += blockSide) {
            throwIfInterrupted(interrupter);
            for (int y = low.y(); y <= high.y(); y += blockSide) {
                const bool isInner = x != low.x() && x != high.x() && y != low.y() && y != high.y();
                const int step = isInner ? std::max(blockSide, high.z() - low.z()) : blockSide;
                for (int z = low.z(); z <= high.z(); z += step) blocks.emplace_back(x, y, z);
            }
        }
    }
    std::vector<char> keep(blocks.size());
    forEach(blocks.size(), tree, interrupter,
            [&](std::size_t i, const Accessor& accessor) { keep[i] = !readWindow(accessor, blocks[i]).uniform(); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (keep[i]) blocks[kept++] = blocks[i];
    }
    requireAtMost(mostBlocks, kept, "blocks of 8^3 voxels");
    blocks.resize(kept);
    sortUnique(blocks);
    return blocks;
}

/// Of the box of voxels at `low` with the given sides, the inactive one with most active face neighbours (adding it
/// makes the least new surface); the first of them in order x, y, z.
Coord voxelToAdd(const Accessor& tree, const Coord& low, const Coord& sides)
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
void findCritical(const Accessor& tree, const Coord& block, std::vector<Coord>& added)
{
    const Window window = readWindow(tree, block);
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

/// The part of the surface in one block: its corners of voxels and its faces.
struct SurfaceBlock {
    Window window;
    std::array<std::uint64_t, blockSide> corners; // bit 8 y + z of [x]: the corner at the low end of voxel (x, y, z)
    std::array<Index32, blockSide> firstPoint;    // number of the first point of each x
    std::size_t pointCount = 0;
    std::size_t firstQuad = 0, quadCount = 0;
};

/// A corner of eight voxels is on the surface if they do not all have the same state.
void findCorners(SurfaceBlock& block)
{
    block.pointCount = 0;
    for (std::size_t x = 0; x < blockSide; ++x) {
        std::uint64_t corners = 0;
        for (std::size_t y = 0; y < blockSide; ++y) {
            const auto& low = block.window.rows[x];
            const auto& high = block.window.rows[x + 1];
            const unsigned any = low[y] | low[y + 1] | high[y] | high[y + 1];
            const unsigned all = low[y] & low[y + 1] & high[y] & high[y + 1];
            const unsigned mixed = (any | any >> 1) & ~(all & all >> 1) & 0xffU;
            corners |= std::uint64_t(mixed) << (blockSide * y);
        }
        block.corners[x] = corners;
        block.pointCount += std::size_t(__builtin_popcountll(corners));
    }
}

/// A face's four corners as steps from the voxel's low corner, counter-clockwise from outside.
using FaceCorners = std::array<std::array<int, 3>, 4>;
constexpr std::array<FaceCorners, 6> faces = {{{{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
                                               {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}},
                                               {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
                                               {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}},
                                               {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}},
                                               {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}}};

/// Calls visit(x, y, z, face) for every face between an active voxel of the block and an inactive one.
template <typename Visit>
void forEachFace(const Window& window, const Visit& visit)
{
    for (std::size_t x = 1; x <= blockSide; ++x) {
        for (std::size_t y = 1; y <= blockSide; ++y) {
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

/// Numbers the points and quads of all blocks in order and makes room for them.
void number(std::vector<SurfaceBlock>& blocks, Mesh& mesh)
{
    std::size_t points = 0, quads = 0;
    for (SurfaceBlock& block : blocks) {
        std::size_t next = points;
        for (std::size_t x = 0; x < blockSide; ++x) {
            block.firstPoint[x] = Index32(next);
            next += std::size_t(__builtin_popcountll(block.corners[x]));
        }
        block.firstQuad = quads;
        points += block.pointCount;
        quads += block.quadCount;
    }
    requireAtMost(mostQuads, quads, "quads"); // so that 32 bits number the points too
    mesh.points.resize(points);
    mesh.quads.resize(quads);
}

} // namespace

openvdb::MaskGrid::Ptr makeWellComposed(const openvdb::MaskGrid& solid, Interrupter* interrupter)
{
    const openvdb::MaskGrid::Ptr result =
        detail::maskGridLike(solid, std::make_shared<openvdb::MaskTree>(solid.tree()));
    Tree& tree = result->tree();
    // Voxels are added inside the box of those that are there, so this ends.
    for (std::vector<Coord> blocks = surfaceBlocks(tree, interrupter); !blocks.empty();) {
        std::vector<std::vector<Coord>> found(blocks.size());
        forEach(blocks.size(), tree, interrupter,
                [&](std::size_t i, const Accessor& accessor) { findCritical(accessor, blocks[i], found[i]); });
        // What is found depends on the state before the round alone: the order does not matter.
        blocks.clear();
        openvdb::tree::ValueAccessor<Tree> accessor(tree);
        for (const std::vector<Coord>& voxels : found) {
            for (const Coord& voxel : voxels) {
                accessor.setValueOn(voxel);
                blocks.push_back(voxel & ~(blockSide - 1));
            }
        }
        sortUnique(blocks);
    }
    return result;
}

Mesh extractSurface(const openvdb::MaskGrid& solid, Interrupter* interrupter)
{
    const openvdb::math::Transform& transform = solid.transform();
    if (!transform.isLinear()) throw InputError("the grid's transform is a frustum; it must be linear");

    const openvdb::MaskGrid::Ptr grid = makeWellComposed(solid, interrupter);
    const Tree& tree = grid->tree();

    // A corner of voxels belongs to the block whose voxel has it as its low end, which need not hold active voxels.
    std::vector<Coord> origins = surfaceBlocks(tree, interrupter);
    for (const Coord& step : {Coord(blockSide, 0, 0), Coord(0, blockSide, 0), Coord(0, 0, blockSide)}) {
        const std::size_t count = origins.size();
        for (std::size_t i = 0; i < count; ++i) origins.push_back(origins[i] + step);
        sortUnique(origins);
    }

    std::vector<SurfaceBlock> blocks(origins.size());
    forEach(blocks.size(), tree, interrupter, [&](std::size_t i, const Accessor& accessor) {
        SurfaceBlock& block = blocks[i];
        block.window = readWindow(accessor, origins[i]);
        findCorners(block);
        forEachFace(block.window, [&](int, int, int, const FaceCorners&) { ++block.quadCount; });
    });
    Mesh mesh;
    number(blocks, mesh);

    const bool mirrored = transform.baseMap()->determinant() < 0;
    forEach(blocks.size(), tree, interrupter, [&](std::size_t i, const Accessor&) {
        const SurfaceBlock& block = blocks[i];
        for (int x = 0; x < blockSide; ++x) {
            std::size_t point = block.firstPoint[std::size_t(x)];
            const std::uint64_t corners = block.corners[std::size_t(x)];
            for (int bit = 0; bit < 64; ++bit) {
                if (!(corners >> bit & 1U)) continue;
                const Coord corner = origins[i].offsetBy(x, bit >> 3, bit & 7);
                mesh.points[point++] = transform.indexToWorld(corner.asVec3d() - openvdb::Vec3d(0.5));
            }
        }
        if (block.quadCount == 0) return;

        std::array<const SurfaceBlock*, 8> around;
        for (int n = 0; n < 8; ++n) {
            const Coord origin =
                origins[i].offsetBy(blockSide * (n >> 2), blockSide * (n >> 1 & 1), blockSide * (n & 1));
            const auto place = std::lower_bound(origins.begin(), origins.end(), origin);
            around[std::size_t(n)] = &blocks[std::size_t(place - origins.begin())];
        }
        const auto pointAt = [&](int x, int y, int z) {
            const SurfaceBlock& owner = *around[std::size_t((x >> 3) << 2 | (y >> 3) << 1 | z >> 3)];
            const std::size_t slab = std::size_t(x & 7);
            const std::uint64_t before = (std::uint64_t(1) << ((y & 7) * blockSide + (z & 7))) - 1;
            return owner.firstPoint[slab] + Index32(__builtin_popcountll(owner.corners[slab] & before));
        };
        std::size_t quad = block.firstQuad;
        forEachFace(block.window, [&](int x, int y, int z, const FaceCorners& corners) {
            openvdb::Vec4I& target = mesh.quads[quad++];
            for (int n = 0; n < 4; ++n) {
                const auto& step = corners[std::size_t(mirrored ? 3 - n : n)];
                target[n] = pointAt(x + step[0], y + step[1], z + step[2]);
            }
        });
    });
    return mesh;
}

} // namespace vdbcage
