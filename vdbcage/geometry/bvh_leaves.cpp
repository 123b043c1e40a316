#include <vdbcage/geometry/bvh_leaves.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

constexpr std::size_t blockSize = 16384; // fixed, so that the leaves are the same for any number of threads
// Trees of many triangles have leaves of several, which makes far fewer nodes, since memory limits their speed. Smaller
// trees fit into caches and gain nothing.
constexpr std::size_t manyTriangles = 1U << 19;
constexpr std::uint32_t leafSize = 4;
constexpr float leafGrowth = 1.6F; // the largest ratio of a leaf's box to the largest of its triangles', in area

LeafRef refOf(const BvhTriangles& triangles, std::size_t triangle)
{
    const Corners t = triangles.cornersInUnits(triangle);
    const FloatBox box = roundedOutward(Box::of(t));
    LeafRef ref;
    ref.lo = box.lo;
    ref.hi = box.hi;
    ref.triangle = static_cast<std::uint32_t>(triangle);
    ref.count = 1;
    // Boxes of any thinness are rounded outward, by less than 3e-7.
    const Vec3d u = t[1] - t[0], v = t[2] - t[0];
    const double length = std::max(maxAbs(u), maxAbs(v));
    ref.leastArea = static_cast<float>(u.cross(v).length() + 1e-6 * length + 1e-12);
    return ref;
}

// Makes the leaves of the triangles from `begin` to `end`, at `first`. Returns their end.
LeafRef* makeBlock(const BvhTriangles& triangles, std::size_t begin, std::size_t end, LeafRef* first)
{
    const std::uint32_t most = triangles.size() < manyTriangles ? 1 : leafSize;
    LeafRef* last = first;
    *first = refOf(triangles, begin);
    float largest = first->box().area();
    for (std::size_t i = begin + 1; i < end; ++i) {
        const LeafRef next = refOf(triangles, i);
        const float area = next.box().area();
        FloatBox both = last->box();
        both.expand(next.lo, next.hi);
        if (last->count < most && both.area() <= leafGrowth * std::max(largest, area)) {
            last->lo = both.lo;
            last->hi = both.hi;
            ++last->count;
            last->leastArea += next.leastArea;
            largest = std::max(largest, area);
        } else {
            *++last = next;
            largest = area;
        }
    }
    return last + 1;
}

} // namespace

Leaves makeLeaves(const BvhTriangles& triangles, Interrupter* interrupter)
{
    Leaves leaves;
    leaves.refs.reset(new LeafRef[triangles.size()]); // not initialized
    const std::size_t blocks = (triangles.size() + blockSize - 1) / blockSize;
    std::vector<std::uint32_t> counts(blocks), needles(blocks);
    parallelFor(std::size_t(0), blocks, [&](std::size_t block) {
        throwIfInterrupted(interrupter);
        const std::size_t begin = block * blockSize, end = std::min(triangles.size(), begin + blockSize);
        LeafRef* const first = leaves.refs.get() + begin;
        LeafRef* const last = makeBlock(triangles, begin, end, first);
        counts[block] = static_cast<std::uint32_t>(last - first);
        const auto isNeedle = [](const LeafRef& ref) { return ref.isNeedle(); };
        needles[block] = static_cast<std::uint32_t>(std::count_if(first, last, isNeedle));
    });
    leaves.needles = std::accumulate(needles.begin(), needles.end(), std::size_t(0));
    for (std::size_t block = 0; block < blocks; ++block) {
        LeafRef* const all = leaves.refs.get();
        const LeafRef* const first = all + block * blockSize;
        if (leaves.count < block * blockSize) std::copy(first, first + counts[block], all + leaves.count);
        leaves.count += counts[block];
    }
    return leaves;
}

} // namespace vdbcage::detail
