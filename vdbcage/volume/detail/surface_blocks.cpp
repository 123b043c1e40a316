#include <vdbcage/volume/detail/surface_blocks.h>

#include <algorithm>
#include <sstream>
#include <string>

#include <vdbcage/core/error.h>

namespace vdbcage::detail {

using openvdb::Coord;
using openvdb::Index32;
using Tree = openvdb::MaskTree;

static_assert(surfaceBlockSide == Tree::LeafNodeType::DIM && surfaceBlockSide == 8,
              "the bit operations below are for 8^3 voxels");

namespace {

constexpr int blockSide = surfaceBlockSide;

// The largest numbers that a small file can ask for with tiles: more would take tens of gigabytes.
constexpr std::size_t mostCandidates = std::size_t(1) << 26, mostBlocks = std::size_t(1) << 22, mostQuads = 100000000;

void requireAtMost(std::size_t most, std::size_t count, const char* things)
{
    if (count <= most) return;
    throw InputError("the surface of the voxels is too large: " + std::to_string(count) + " " + things +
                     "; there may be " + std::to_string(most));
}

/// Checks that steps from one voxel to another do not leave the range of coordinates.
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

} // namespace

Window readWindow(const MaskAccessor& tree, const Coord& block)
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

void sortUnique(std::vector<Coord>& coords)
{
    parallelSort(coords.begin(), coords.end());
    coords.erase(std::unique(coords.begin(), coords.end()), coords.end());
}

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
    forEachBlock(blocks.size(), tree, interrupter, [&](std::size_t i, const MaskAccessor& accessor) {
        keep[i] = !readWindow(accessor, blocks[i]).uniform();
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (keep[i]) blocks[kept++] = blocks[i];
    }
    requireAtMost(mostBlocks, kept, "blocks of 8^3 voxels");
    blocks.resize(kept);
    sortUnique(blocks);
    return blocks;
}

const std::array<SurfaceBlocks::FaceCorners, 6> SurfaceBlocks::faces = {
    {{{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}}},
     {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}}},
     {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}},
     {{{0, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 1, 0}}},
     {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}}},
     {{{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}}}};

void SurfaceBlocks::findCorners(Block& block)
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

SurfaceBlocks::SurfaceBlocks(const Tree& tree, Interrupter* interrupter)
    // A corner of voxels belongs to the block whose voxel has it as its low end; the block need not have active voxels.
    : origins_(surfaceBlocks(tree, interrupter))
{
    for (const Coord& step : {Coord(blockSide, 0, 0), Coord(0, blockSide, 0), Coord(0, 0, blockSide)}) {
        const std::size_t count = origins_.size();
        for (std::size_t i = 0; i < count; ++i) origins_.push_back(origins_[i] + step);
        sortUnique(origins_);
    }
    blocks_.resize(origins_.size());
    forEachBlock(blocks_.size(), tree, interrupter, [&](std::size_t i, const MaskAccessor& accessor) {
        Block& block = blocks_[i];
        block.window = readWindow(accessor, origins_[i]);
        findCorners(block);
        forEachFace(block.window, [&](int, int, int, const FaceCorners&) { ++block.quadCount; });
    });
    number();
}

void SurfaceBlocks::number()
{
    for (Block& block : blocks_) {
        std::size_t next = points_;
        for (std::size_t x = 0; x < blockSide; ++x) {
            block.firstPoint[x] = Index32(next);
            next += std::size_t(__builtin_popcountll(block.corners[x]));
        }
        block.firstQuad = quads_;
        points_ += block.pointCount;
        quads_ += block.quadCount;
    }
    requireAtMost(mostQuads, quads_, "quads"); // so that 32 bits number the points, too
}

SurfaceBlocks::Around SurfaceBlocks::blocksAround(std::size_t i) const
{
    Around around;
    for (int n = 0; n < 8; ++n) {
        const Coord origin = origins_[i].offsetBy(blockSide * (n >> 2), blockSide * (n >> 1 & 1), blockSide * (n & 1));
        const auto place = std::lower_bound(origins_.begin(), origins_.end(), origin);
        around[std::size_t(n)] = &blocks_[std::size_t(place - origins_.begin())];
    }
    return around;
}

} // namespace vdbcage::detail
