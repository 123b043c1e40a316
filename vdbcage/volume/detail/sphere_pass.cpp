// Based on: the node-wise overlap tests of Calderon and Boubekeur, Bounding Proxies for Shape Approximation, 2017.
// Differs: exact integer distances to the contour voxels alone (for a point outside a set some nearest voxel of it has
// a face neighbour outside); the tree's nodes are asked as wholes (128^3, 32^3, 16^3, 8^3), each with the contour
// leaves that reach it, and only slots that are neither all in nor all out compute distances, axis by axis as in
// Saito and Toriwaki, New Algorithms for Euclidean Distance Transformation, 1994.
#include <vdbcage/volume/detail/sphere_pass.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <vdbcage/volume/detail/contour_leaves.h>
#include <vdbcage/volume/detail/leaf_distance.h>

namespace vdbcage::detail {

namespace {

using openvdb::CoordBBox;

std::int64_t squaredGap(const CoordBBox& a, const CoordBBox& b)
{
    std::int64_t sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const std::int64_t gap = std::max({a.min()[axis] - b.max()[axis], b.min()[axis] - a.max()[axis], 0});
        sum += gap * gap;
    }
    return sum;
}

CoordBBox worldBox(const Coord& origin, const BitBox& box)
{
    return {origin.offsetBy(box.lower[0], box.lower[1], box.lower[2]),
            origin.offsetBy(box.upper[0], box.upper[1], box.upper[2])};
}

// Contour leaves as arrays by coordinate, relative to a 32^3 part of a block, so that the distance tests run in wide
// vectors. T is int16_t where the radius lets it.
template <class T>
struct Candidates {
    std::array<std::vector<T>, 3> lower, upper, sample;
    std::vector<const ContourLeaf*> leaves;

    void clear()
    {
        for (auto* arrays : {&lower, &upper, &sample}) {
            for (auto& array : *arrays) array.clear();
        }
        leaves.clear();
    }
    void add(const ContourLeaf& leaf, const Coord& base)
    {
        const Coord offset = leaf.origin - base;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int o = offset[static_cast<int>(axis)];
            lower[axis].push_back(static_cast<T>(o + leaf.box.lower[axis]));
            upper[axis].push_back(static_cast<T>(o + leaf.box.upper[axis]));
            sample[axis].push_back(static_cast<T>(o + leaf.sample[axis]));
        }
        leaves.push_back(&leaf);
    }
    void add(const Candidates& other, std::size_t i)
    {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lower[axis].push_back(other.lower[axis][i]);
            upper[axis].push_back(other.upper[axis][i]);
            sample[axis].push_back(other.sample[axis][i]);
        }
        leaves.push_back(other.leaves[i]);
    }
};

// Adds to `nearest` and `farthest` the squared distances along one axis: from the target's interval to the boxes, and
// from the samples to the far end of the interval. Distances are cut at `cap`, which is above the radius.
template <class T>
void addAxis(std::size_t count, const T* __restrict lower, const T* __restrict upper, const T* __restrict sample,
             T targetLower, T targetUpper, T cap, T* __restrict nearest, T* __restrict farthest)
{
    for (std::size_t i = 0; i < count; ++i) {
        const T below = static_cast<T>(lower[i] - targetUpper), above = static_cast<T>(targetLower - upper[i]);
        T gap = below > above ? below : above;
        gap = gap > T(0) ? gap : T(0);
        gap = gap < cap ? gap : cap;
        const T toLower = static_cast<T>(sample[i] - targetLower), toUpper = static_cast<T>(targetUpper - sample[i]);
        T far = toLower > toUpper ? toLower : toUpper;
        far = far < cap ? far : cap;
        nearest[i] = static_cast<T>(nearest[i] + static_cast<T>(gap * gap));
        farthest[i] = static_cast<T>(farthest[i] + static_cast<T>(far * far));
    }
}

// What one thread needs while it works on a 32^3 part of a block.
template <class T>
struct WorkSpace {
    explicit WorkSpace(std::int64_t squaredRadius) : distance(squaredRadius) {}

    LeafDistance<T> distance;
    std::array<Candidates<T>, 3> candidates; // the leaves near the 32^3, those that reach it, those that reach the 16^3
    std::vector<T> nearest, farthest;
    std::array<Words, 64> open; // by slot of the part: the voxels that the pass may change
    std::array<CoordBBox, 64> openBox;
    std::size_t tests = 0; // candidates tested since the interrupter was last asked
};

template <class T>
class SpherePass {
public:
    SpherePass(const MaskTree& base, const MaskTree* keep, ContourOf side, std::int64_t squaredRadius,
               const std::vector<ContourBlock>& contour, const Progress& progress)
        : base_(base), keep_(keep), side_(side), squaredRadius_(squaredRadius), contour_(contour), progress_(progress),
          reach_(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(squaredRadius))))), workSpaces_(squaredRadius)
    {
    }

    MaskTree::Ptr run()
    {
        const std::vector<Coord> targets = targetBlocks();
        std::vector<BuiltBlock> built(targets.size());
        tbb::parallel_for(std::size_t{0}, targets.size(),
                          [&](std::size_t i) { built[i] = build(targets[i], targets.size()); });
        return assemble(fullParts(base_), std::move(built));
    }

private:
    struct Target {
        Coord origin;
        Block base, keep;
        std::vector<std::pair<const ContourBlock*, const ContourGroup*>> groups; // those that reach it
    };

    // The blocks in reach of the contour that the pass may change.
    std::vector<Coord> targetBlocks() const
    {
        std::vector<Coord> targets;
        for (const ContourBlock& block : contour_) {
            CoordBBox box = block.box;
            box.expand(reach_);
            const Coord first = alignedTo(box.min(), blockSize), last = alignedTo(box.max(), blockSize);
            for (int x = first.x(); x <= last.x(); x += blockSize) {
                for (int y = first.y(); y <= last.y(); y += blockSize) {
                    for (int z = first.z(); z <= last.z(); z += blockSize) targets.emplace_back(x, y, z);
                }
            }
        }
        std::sort(targets.begin(), targets.end());
        targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
        const auto isSettled = [&](const Coord& origin) {
            const Block block = blockAt(base_, origin);
            return side_ == ContourOf::mask ? block.isFull() : block.isEmpty();
        };
        targets.erase(std::remove_if(targets.begin(), targets.end(), isSettled), targets.end());
        return targets;
    }

    BuiltBlock build(const Coord& origin, std::size_t targetCount)
    {
        Target target{origin, blockAt(base_, origin), keep_ ? blockAt(*keep_, origin) : Block(), {}};
        gatherGroups(target);
        BlockBuilder builder(origin);
        tbb::parallel_for(0, 64, [&](int part) {
            progress_.check(partsDone_++, 64 * targetCount);
            buildPart(target, part, workSpaces_.local(), builder);
        });
        return builder.finish();
    }

    void gatherGroups(Target& target) const
    {
        const CoordBBox box = CoordBBox::createCube(target.origin, blockSize);
        CoordBBox around = box;
        around.expand(reach_);
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
                        if (squaredGap(group.box, box) <= squaredRadius_) target.groups.emplace_back(&*found, &group);
                    }
                }
            }
        }
    }

    void buildPart(const Target& target, int part, WorkSpace<T>& work, BlockBuilder& builder) const
    {
        const Coord firstSlot(part / 16 * partSlots, part / 4 % 4 * partSlots, part % 4 * partSlots);
        findOpenVoxels(target, firstSlot, work);
        const Coord corner = target.origin + slotOffset(slotIndex(firstSlot.x(), firstSlot.y(), firstSlot.z()));
        const CoordBBox box = CoordBBox::createCube(corner, partSlots * leafSize);
        Candidates<T>& near = work.candidates[0];
        near.clear();
        for (const auto& [block, group] : target.groups) {
            if (squaredGap(group->box, box) > squaredRadius_) continue;
            for (std::size_t i = group->begin; i < group->end; ++i) near.add(block->leaves[i], corner);
        }
        descend({target, firstSlot, corner, work, builder}, Coord(0), partSlots, 0);
    }

    void findOpenVoxels(const Target& target, const Coord& firstSlot, WorkSpace<T>& work) const
    {
        for (int i = 0; i < 64; ++i) {
            const int n = slotIndex(firstSlot.x() + i / 16, firstSlot.y() + i / 4 % 4, firstSlot.z() + i % 4);
            const std::uint64_t* const base = target.base.slot(n);
            const std::uint64_t* const keep = target.keep.slot(n);
            Words& open = work.open[static_cast<std::size_t>(i)];
            std::uint64_t any = 0;
            for (std::size_t x = 0; x < 8; ++x) {
                open[x] = side_ == ContourOf::mask ? ~base[x] : base[x] & ~keep[x];
                any |= open[x];
            }
            CoordBBox& box = work.openBox[static_cast<std::size_t>(i)];
            box.reset();
            if (any != 0) box = worldBox(target.origin + slotOffset(n), bitBox(open.data()));
        }
    }

    // The part that is being built, in the hands of one thread.
    struct Part {
        const Target& target;
        Coord firstSlot, corner;
        WorkSpace<T>& work;
        BlockBuilder& builder;
    };

    // Settles a cube of `slots`^3 slots that starts at slot `first` of the part, given that all leaves that can reach
    // it are among the candidates of `level`.
    void descend(const Part& part, const Coord& first, int slots, std::size_t level) const
    {
        WorkSpace<T>& work = part.work;
        CoordBBox box; // of the open voxels
        forEachSlot(first, slots, [&](int i) { box.expand(work.openBox[static_cast<std::size_t>(i)]); });
        const Candidates<T>& candidates = work.candidates[level];
        if (box.empty() || candidates.leaves.empty()) return settle(part, first, slots, false);
        if (testDistances(part, box, candidates)) return settle(part, first, slots, true);
        const T limit = static_cast<T>(squaredRadius_);
        if (slots == 1) {
            const int i = slotOfPart(first);
            const Coord origin = part.corner + Coord(first.x() * 8, first.y() * 8, first.z() * 8);
            const Words& open = work.open[static_cast<std::size_t>(i)];
            work.distance.start(origin, bitBox(open.data()));
            for (std::size_t c = 0; c < candidates.leaves.size(); ++c) {
                if (work.nearest[c] <= limit) work.distance.add(*candidates.leaves[c]);
            }
            setSlot(part, i, work.distance.within(open));
            return;
        }
        Candidates<T>& reaching = work.candidates[level + 1];
        reaching.clear();
        for (std::size_t c = 0; c < candidates.leaves.size(); ++c) {
            if (work.nearest[c] <= limit) reaching.add(candidates, c);
        }
        const int half = slots / 2;
        for (int child = 0; child < 8; ++child) {
            descend(part, first + Coord(child / 4 * half, child / 2 % 2 * half, child % 2 * half), half,
                    std::min<std::size_t>(level + 1, 2));
        }
    }

    // Fills work.nearest, and tells whether one known contour voxel has the whole box in its reach.
    bool testDistances(const Part& part, const CoordBBox& box, const Candidates<T>& candidates) const
    {
        WorkSpace<T>& work = part.work;
        const std::size_t count = candidates.leaves.size();
        work.tests += count;
        if (work.tests > testsPerCheck) {
            work.tests = 0;
            throwIfInterrupted(progress_.interrupter);
        }
        work.nearest.assign(count, 0);
        work.farthest.assign(count, 0);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            addAxis(count, candidates.lower[axis].data(), candidates.upper[axis].data(), candidates.sample[axis].data(),
                    static_cast<T>(box.min()[a] - part.corner[a]), static_cast<T>(box.max()[a] - part.corner[a]),
                    static_cast<T>(reach_ + 1), work.nearest.data(), work.farthest.data());
        }
        return *std::min_element(work.farthest.begin(), work.farthest.end()) <= static_cast<T>(squaredRadius_);
    }

    // All open voxels of these slots are within reach, or none.
    void settle(const Part& part, const Coord& first, int slots, bool within) const
    {
        forEachSlot(first, slots, [&](int i) {
            setSlot(part, i, within ? part.work.open[static_cast<std::size_t>(i)] : emptyWords);
        });
    }

    // `near`: the open voxels within reach of the contour. They change sides.
    void setSlot(const Part& part, int i, const Words& near) const
    {
        const int n =
            slotIndex(part.firstSlot.x() + i / 16, part.firstSlot.y() + i / 4 % 4, part.firstSlot.z() + i % 4);
        const std::uint64_t* const base = part.target.base.slot(n);
        Words result;
        for (std::size_t x = 0; x < 8; ++x) result[x] = base[x] ^ near[x];
        part.builder.set(n, result.data());
    }

    static int slotOfPart(const Coord& slot) { return slot.x() * 16 + slot.y() * 4 + slot.z(); }

    template <class Visit>
    static void forEachSlot(const Coord& first, int slots, const Visit& visit)
    {
        for (int x = 0; x < slots; ++x) {
            for (int y = 0; y < slots; ++y) {
                for (int z = 0; z < slots; ++z) visit(slotOfPart(first.offsetBy(x, y, z)));
            }
        }
    }

    static constexpr int partSlots = 4;                 // along an axis
    static constexpr std::size_t testsPerCheck = 20000; // a millisecond or so

    const MaskTree& base_;
    const MaskTree* keep_;
    ContourOf side_;
    std::int64_t squaredRadius_;
    const std::vector<ContourBlock>& contour_;
    Progress progress_;
    int reach_; // the radius, rounded up
    tbb::enumerable_thread_specific<WorkSpace<T>> workSpaces_;
    std::atomic<std::size_t> partsDone_{0};
};

MaskTree::Ptr runPass(const MaskTree& base, const MaskTree* keep, ContourOf side, std::int64_t squaredRadius,
                      const Progress& progress)
{
    const std::vector<ContourBlock> contour = contourBlocks(base, side, progress.part(0, 8));
    const Progress rest{progress.interrupter, progress.part(0, 8).to, progress.to};
    if (squaredRadius <= std::int64_t{smallRadius} * smallRadius) {
        return SpherePass<std::int16_t>(base, keep, side, squaredRadius, contour, rest).run();
    }
    return SpherePass<std::int32_t>(base, keep, side, squaredRadius, contour, rest).run();
}

} // namespace

MaskTree::Ptr dilateBySphere(const MaskTree& mask, std::int64_t squaredRadius, const Progress& progress)
{
    return runPass(mask, nullptr, ContourOf::mask, squaredRadius, progress);
}

MaskTree::Ptr erodeBySphere(const MaskTree& mask, const MaskTree* keep, std::int64_t squaredRadius,
                            const Progress& progress)
{
    return runPass(mask, keep, ContourOf::complement, squaredRadius, progress);
}

} // namespace vdbcage::detail
