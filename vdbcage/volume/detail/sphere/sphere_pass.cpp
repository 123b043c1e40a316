// Based on: the node-wise overlap tests of Calderon and Boubekeur, Bounding Proxies for Shape Approximation, 2017.
// Differs: exact integer distances to the contour voxels alone (for a point outside a set some nearest voxel of it has
// a face neighbour outside); the tree's nodes are tested as wholes (128^3, 32^3, 8^3), each with the contour leaves
// within the radius, and voxels are read only in entries that are neither all in nor all out (see sphere_query.h).
#include <vdbcage/volume/detail/sphere/sphere_pass.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <tbb/enumerable_thread_specific.h>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/volume/detail/contour_blocks.h>
#include <vdbcage/volume/detail/sphere/sphere_query.h>
#include <vdbcage/volume/detail/sphere/varying_query.h>

namespace vdbcage::detail {

namespace {

using openvdb::CoordBBox;

std::int64_t squaredGap(const CoordBBox& a, const CoordBBox& b)
{
    std::int64_t sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::int64_t gap = std::max({a.min()[axis] - b.max()[axis], b.min()[axis] - a.max()[axis], 0});
        sum += gap * gap;
    }
    return sum;
}

// The data of one thread for a part of a block.
template <class Query>
struct WorkSpace {
    std::vector<std::size_t> groups; // within the radius of the part
    std::vector<NearLeaf> near;      // their leaves, or samples of them
    // Those that may be within the radius of open entries, by their place along z: see SphereQuery::Leaves.
    std::vector<std::uint16_t> order;
    // The same for the open entries of each pile of the part.
    std::vector<std::uint16_t> lists;
    std::array<std::array<std::size_t, 6>, 16> ends;
    std::optional<Coord> block; // the block of `queryWork`
    typename Query::Work queryWork;
    // By entry of the part: its voxels, and those that the pass may change.
    std::array<const std::uint64_t*, 64> base;
    std::array<const Words*, 64> open;
    std::array<Words, 64> partlyOpen;
};

// `Query` finds the voxels within the radius: SphereQuery or VaryingQuery.
template <class Query>
class SpherePass {
public:
    SpherePass(const MaskTree& base, const MaskTree* keep, ContourOf side, std::int64_t largestSquare,
               const Query& query, const std::vector<ContourBlock>& contour, const Progress& progress)
        : base_(base), keep_(keep), side_(side), squaredRadius_(largestSquare), contour_(contour), progress_(progress),
          radius_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(largestSquare))))), query_(query)
    {
    }

    MaskTree::Ptr run()
    {
        const std::vector<Coord> targets = targetBlocks();
        parts_ = 64 * targets.size();
        std::vector<BuiltBlock> built(targets.size());
        parallelFor(std::size_t{0}, targets.size(), [&](std::size_t i) { built[i] = build(targets[i]); });
        return assemble(fullParts(base_), std::move(built));
    }

private:
    using Work = WorkSpace<Query>;

    struct Target {
        Coord origin;
        Block base, keep;
        struct Group {
            const ContourBlock* block;
            const ContourGroup* group;
            std::size_t firstId; // its leaves are numbered from here
        };
        std::vector<Group> groups; // those within the radius of it
        std::size_t leaves = 0;    // of all groups
    };

    // Returns the blocks within the radius of the contour that the pass may change.
    std::vector<Coord> targetBlocks() const
    {
        std::vector<Coord> targets;
        for (const ContourBlock& block : contour_) {
            CoordBBox box = block.box;
            box.expand(radius_);
            const Coord first = alignedTo(box.min(), blockSize), last = alignedTo(box.max(), blockSize);
            for (int x = first.x(); x <= last.x(); x += blockSize) {
                for (int y = first.y(); y <= last.y(); y += blockSize) {
                    for (int z = first.z(); z <= last.z(); z += blockSize) targets.emplace_back(x, y, z);
                }
            }
        }
        std::sort(targets.begin(), targets.end());
        targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
        const auto isDecided = [&](const Coord& origin) {
            const Block block = blockAt(base_, origin);
            return side_ == ContourOf::mask ? block.isFull() : block.isEmpty();
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isDecided), targets.end());
        return targets;
    }

    BuiltBlock build(const Coord& origin)
    {
        Target target{origin, blockAt(base_, origin), keep_ ? blockAt(*keep_, origin) : Block(), {}, 0};
        gatherGroups(target);
        BlockBuilder builder(origin);
        parallelFor(0, 64, [&](int part) {
            progress_.check(partsDone_++, parts_);
            buildPart(target, part, workSpaces_.local(), builder);
        });
        return builder.finish();
    }

    void gatherGroups(Target& target) const
    {
        const CoordBBox box = CoordBBox::createCube(target.origin, blockSize);
        CoordBBox around = box;
        around.expand(radius_);
        const Coord first = alignedTo(around.min(), blockSize), last = alignedTo(around.max(), blockSize);
        for (int x = first.x(); x <= last.x(); x += blockSize) {
            for (int y = first.y(); y <= last.y(); y += blockSize) {
                for (int z = first.z(); z <= last.z(); z += blockSize) {
                    const Coord origin(x, y, z);
                    const auto found =
                        std::lower_bound(contour_.begin(), contour_.end(), origin,
                                         [](const ContourBlock& block, const Coord& c) { return block.origin < c; });
                    if (found == contour_.end() || found->origin != origin) continue;
                    for (const ContourGroup& group : found->groups) {
                        if (squaredGap(group.box, box) > squaredRadius_) continue;
                        target.groups.push_back({&*found, &group, target.leaves});
                        target.leaves += group.end - group.begin;
                    }
                }
            }
        }
    }

    void buildPart(const Target& target, int part, Work& work, BlockBuilder& builder) const
    {
        const int firstEntry = entryIndex(part / 16 * partEntries, part / 4 % 4 * partEntries, part % 4 * partEntries);
        std::uint64_t open = findOpenVoxels(target, firstEntry, work);
        std::uint64_t covered = 0;
        if (open != 0) {
            const Coord corner = target.origin + entryOffset(firstEntry);
            const std::size_t leaves = selectGroups(target, corner, work), stride = leaves / samples + 1;
            gatherLeaves(target, corner, stride, work);
            query_.startPart(work.queryWork, corner);
            covered = open & query_.coveredEntries(work.near.data(), work.near.size(), open, work.queryWork);
            open &= ~covered;
            if (open != 0 && stride > 1) gatherLeaves(target, corner, 1, work);
        }
        if (open != 0) {
            if (work.block != target.origin) query_.startBlock(work.queryWork, target.leaves);
            work.block = target.origin;
            open &= listLeaves(open, work);
        }
        // The open voxels within the radius change sides.
        for (int pile = 0; pile < 16; ++pile) {
            const int first = 4 * pile;
            SphereQuery::Pile pileOpen{};
            for (std::size_t z = 0; z < 4; ++z) {
                const std::size_t i = static_cast<std::size_t>(first) + z;
                if ((open >> i & 1) != 0) pileOpen[z] = work.open[i];
            }
            std::array<Words, 4> change;
            if ((open >> first & 15) != 0) {
                progress_.check(partsDone_, parts_); // these take time with large radii
                change = query_.within(pileOpen, pile, work.near.data(), leavesOf(pile, work), work.queryWork);
            }
            for (int z = 0; z < 4; ++z) {
                const int i = first + z, n = entryOfBlock(firstEntry, i);
                const auto entry = static_cast<std::size_t>(i);
                const std::uint64_t* const base = work.base[entry];
                if ((covered >> i & 1) != 0) {
                    setChanged(builder, n, base, *work.open[entry]);
                } else if ((open >> i & 1) != 0) {
                    setChanged(builder, n, base, change[static_cast<std::size_t>(z)]);
                } else {
                    builder.set(n, base);
                }
            }
        }
    }

    static void setChanged(BlockBuilder& builder, int n, const std::uint64_t* base, const Words& change)
    {
        Words words;
        for (std::size_t x = 0; x < 8; ++x) words[x] = base[x] ^ change[x];
        builder.set(n, words.data());
    }

    // Finds the entries of the part that have open voxels.
    std::uint64_t findOpenVoxels(const Target& target, int firstEntry, Work& work) const
    {
        std::uint64_t found = 0;
        for (int i = 0; i < 64; ++i) {
            const auto entry = static_cast<std::size_t>(i);
            const int n = entryOfBlock(firstEntry, i);
            const std::uint64_t* const base = work.base[entry] = target.base.entry(n);
            const std::uint64_t* const keep = side_ == ContourOf::mask ? base : target.keep.entry(n);
            const std::uint64_t* const decided = (side_ == ContourOf::mask ? fullWords : emptyWords).data();
            if (base == decided || keep == fullWords.data()) continue;
            if (keep == emptyWords.data() && (base == emptyWords.data() || base == fullWords.data())) {
                work.open[entry] = &fullWords;
                found |= std::uint64_t{1} << i;
                continue;
            }
            Words& open = work.partlyOpen[entry];
            work.open[entry] = &open;
            std::uint64_t any = 0;
            for (std::size_t x = 0; x < 8; ++x) {
                open[x] = (side_ == ContourOf::mask ? ~0ULL : base[x]) & ~keep[x];
                any |= open[x];
            }
            found |= std::uint64_t{any != 0} << i;
        }
        return found;
    }

    // Selects the groups, a nearest one first. Returns the number of their leaves.
    std::size_t selectGroups(const Target& target, const Coord& corner, Work& work) const
    {
        const CoordBBox box = CoordBBox::createCube(corner, partEntries * leafSize);
        work.groups.clear();
        std::size_t leaves = 0;
        std::int64_t least = squaredRadius_ + 1;
        for (std::size_t i = 0; i < target.groups.size(); ++i) {
            const ContourGroup& group = *target.groups[i].group;
            const std::int64_t gap = squaredGap(group.box, box);
            if (gap > squaredRadius_) continue;
            work.groups.push_back(i);
            leaves += group.end - group.begin;
            if (gap < least) std::swap(work.groups.front(), work.groups.back());
            least = std::min(least, gap);
        }
        return leaves;
    }

    // Gathers one of `stride` leaves of the selected groups.
    static void gatherLeaves(const Target& target, const Coord& corner, std::size_t stride, Work& work)
    {
        work.near.clear();
        std::size_t skip = 0; // leaves until the next
        for (const std::size_t index : work.groups) {
            const auto& [block, group, firstId] = target.groups[index];
            const Coord voxels = block->origin - corner,
                        offset(voxels.x() >> 3, voxels.y() >> 3, voxels.z() >> 3); // in entries
            std::size_t i = group->begin + skip;
            for (; i < group->end; i += stride) {
                const ContourLeaf& leaf = block->leaves[i];
                NearLeaf& near = work.near.emplace_back();
                near.id = static_cast<std::uint32_t>(firstId + i - group->begin);
                near.words = &block->words[i];
                near.x = static_cast<std::int16_t>(offset.x() + (leaf.entry >> 8));
                near.y = static_cast<std::int16_t>(offset.y() + (leaf.entry >> 4 & 15));
                near.z = static_cast<std::int16_t>(offset.z() + (leaf.entry & 15));
                near.box = leaf.box;
                near.sample = leaf.sample;
            }
            skip = i - group->end;
        }
    }

    // Finds the open entries that may be within the radius of a leaf.
    std::uint64_t listLeaves(std::uint64_t open, Work& work) const
    {
        constexpr std::uint64_t bottoms = 0x1111111111111111ULL; // the first entry of each pile
        const std::size_t size = work.near.size();
        query_.nearEntries(work.near.data(), size, work.queryWork);
        std::uint64_t any = 0;
        std::array<std::size_t, 7> starts{};
        const auto kindOf = [&](const NearLeaf& leaf) {
            return static_cast<std::size_t>(std::clamp(leaf.z + 1, 0, partEntries + 1));
        };
        for (const NearLeaf& leaf : work.near) {
            if ((leaf.entriesInRadius & open) == 0) continue;
            any |= leaf.entriesInRadius & open;
            ++starts[kindOf(leaf) + 1];
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        const auto kindEnds = starts;
        if (work.order.size() < size) work.order.resize(size);
        for (std::size_t i = 0; i < size; ++i) {
            if ((work.near[i].entriesInRadius & open) == 0) continue;
            work.order[starts[kindOf(work.near[i])]++] = static_cast<std::uint16_t>(i);
        }
        if (work.lists.size() < 16 * size) work.lists.resize(16 * size);
        std::array<std::size_t, 16> counts{};
        for (std::size_t kind = 0; kind < 6; ++kind) {
            for (std::size_t k = kindEnds[kind]; k < kindEnds[kind + 1]; ++k) {
                const std::uint16_t i = work.order[k];
                std::uint64_t piles = work.near[i].entriesInRadius & open;
                piles |= piles >> 2;
                piles |= piles >> 1;
                for (piles &= bottoms; piles != 0; piles &= piles - 1) {
                    const auto pile = static_cast<std::size_t>(__builtin_ctzll(piles)) / 4;
                    work.lists[pile * size + counts[pile]++] = i;
                }
            }
            for (std::size_t pile = 0; pile < 16; ++pile) work.ends[pile][kind] = counts[pile];
        }
        return any;
    }

    static SphereQuery::Leaves leavesOf(int pile, const Work& work)
    {
        const auto i = static_cast<std::size_t>(pile);
        return {work.lists.data() + i * work.near.size(), work.ends[i]};
    }

    // Returns the entry of the block that is bit i of the part.
    static int entryOfBlock(int firstEntry, int i) { return firstEntry + entryIndex(i / 16, i / 4 % 4, i % 4); }

    static constexpr int partEntries = 4;      // along an axis
    static constexpr std::size_t samples = 48; // leaves that may cover entries alone: more leaves hardly decide more

    const MaskTree& base_;
    const MaskTree* keep_;
    ContourOf side_;
    std::int64_t squaredRadius_; // the largest
    const std::vector<ContourBlock>& contour_;
    Progress progress_;
    int radius_; // the largest, rounded up
    const Query& query_;
    tbb::enumerable_thread_specific<Work> workSpaces_;
    std::size_t parts_ = 0;
    std::atomic<std::size_t> partsDone_{0};
};

template <class Query>
MaskTree::Ptr runPass(const MaskTree& base, const MaskTree* keep, ContourOf side, std::int64_t largestSquare,
                      const Query& query, const Progress& progress)
{
    const std::vector<ContourBlock> contour = contourBlocks(base, side, progress.part(0, 8));
    const Progress rest{progress.interrupter, progress.part(0, 8).to, progress.to};
    return SpherePass<Query>(base, keep, side, largestSquare, query, contour, rest).run();
}

std::int64_t largestSquare(const RadiusField& field, double factor)
{
    return field.squareOf(field.largest() * factor);
}

} // namespace

MaskTree::Ptr dilateBySphere(const MaskTree& mask, std::int64_t squaredRadius, const Progress& progress, Simd simd)
{
    const SphereQuery query(squaredRadius, simd, progress.part(0, 100));
    return runPass(mask, nullptr, ContourOf::mask, squaredRadius, query, progress);
}

MaskTree::Ptr erodeBySphere(const MaskTree& mask, const MaskTree* keep, std::int64_t squaredRadius,
                            const Progress& progress, Simd simd)
{
    const SphereQuery query(squaredRadius, simd, progress.part(0, 100));
    return runPass(mask, keep, ContourOf::complement, squaredRadius, query, progress);
}

MaskTree::Ptr dilateByField(const MaskTree& mask, const RadiusField& field, const Progress& progress, Simd simd)
{
    const VaryingQuery query(field, 1, VaryingQuery::By::target, simd);
    return runPass(mask, nullptr, ContourOf::mask, largestSquare(field, 1), query, progress);
}

MaskTree::Ptr erodeByField(const MaskTree& mask, const MaskTree* keep, const RadiusField& field, double factor,
                           const Progress& progress, Simd simd)
{
    const VaryingQuery query(field, factor, VaryingQuery::By::source, simd);
    return runPass(mask, keep, ContourOf::complement, largestSquare(field, factor), query, progress);
}

} // namespace vdbcage::detail
