#include <vdbcage/check/detail/box_tree.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

using Range = tbb::blocked_range<std::size_t>;

/// Bits 0 to 20 of n, with two zeros between each.
std::uint64_t spread(std::uint64_t n)
{
    n = (n | n << 32U) & 0x001f00000000ffffU;
    n = (n | n << 16U) & 0x001f0000ff0000ffU;
    n = (n | n << 8U) & 0x100f00f00f00f00fU;
    n = (n | n << 4U) & 0x10c30c30c30c30c3U;
    return (n | n << 2U) & 0x1249249249249249U;
}

/// Where a point is on the curve through `all`, 63 bits.
std::uint64_t mortonCode(const Vec3d& p, const Box& all)
{
    std::uint64_t code = 0;
    for (int i = 0; i < 3; ++i) {
        constexpr double cells = 1 << 21;
        // Halves do not overflow.
        const double extent = 0.5 * all.hi[i] - 0.5 * all.lo[i];
        const double place = extent > 0 ? (0.5 * p[i] - 0.5 * all.lo[i]) / extent : 0;
        const double cell = std::min(std::max(place * cells, 0.0), cells - 1);
        code |= spread(static_cast<std::uint64_t>(cell)) << static_cast<unsigned>(i);
    }
    return code;
}

Corners cornersOf(const std::vector<Vec3d>& points, const Vec3I& triangle)
{
    return {points[triangle[0]], points[triangle[1]], points[triangle[2]]};
}

/// Its corners in the order of their coordinates: the same for every copy.
Corners sorted(Corners corners)
{
    std::sort(corners.begin(), corners.end());
    return corners;
}

Box joined(Box a, const Box& b)
{
    a.expand(b);
    return a;
}

struct Coded {
    std::uint64_t code;
    std::uint32_t triangle;

    bool operator<(const Coded& other) const
    {
        return code != other.code ? code < other.code : triangle < other.triangle;
    }
};

/// Where runs of equal codes end that begin at `run`.
std::vector<Coded>::iterator endOfRun(std::vector<Coded>::iterator run, std::vector<Coded>::iterator end)
{
    return std::find_if(run, end, [code = run->code](const Coded& coded) { return coded.code != code; });
}

/// Puts those from `begin` to `end` in the order of the curve through the box of their centres. Those of one cell
/// follow a curve through that cell. What has one centre is in a run of one code.
/// Cost: O(n log n); the cells of a curve are 2^21 times smaller than its box.
void sortAlongCurve(const std::vector<Vec3d>& centres, std::vector<Coded>::iterator begin,
                    std::vector<Coded>::iterator end, std::size_t leafSize, Interrupter* interrupter)
{
    throwIfInterrupted(interrupter);
    const auto count = static_cast<std::size_t>(end - begin);
    const auto at = [&](std::size_t i) -> Coded& { return begin[static_cast<std::ptrdiff_t>(i)]; };
    const Box all = parallelReduce(
        Range(0, count, 4096), Box::of(centres[at(0).triangle]),
        [&](const Range& range, Box box) {
            for (std::size_t i = range.begin(); i < range.end(); ++i) box.expand(Box::of(centres[at(i).triangle]));
            return box;
        },
        joined);
    if (all.lo == all.hi) return;
    parallelFor(Range(0, count, 4096), [&](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) at(i).code = mortonCode(centres[at(i).triangle], all);
    });
    parallelSort(begin, end);
    for (auto run = begin; run != end;) {
        const auto next = endOfRun(run, end);
        if (static_cast<std::size_t>(next - run) > leafSize) sortAlongCurve(centres, run, next, leafSize, interrupter);
        run = next;
    }
}

/// Of each triangle with copies the first is left. Copies have one centre, and so are in one run of equal codes.
void dropCopies(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, std::vector<Coded>& order,
                Interrupter* interrupter)
{
    Asker ask(interrupter);
    const auto place = [&](const Coded& coded) {
        ask();
        return sorted(cornersOf(points, triangles[coded.triangle]));
    };
    auto kept = order.begin();
    for (auto run = order.begin(); run != order.end();) {
        const auto next = endOfRun(run, order.end());
        auto last = next;
        if (next - run > 1) {
            std::stable_sort(run, next, [&](const Coded& a, const Coded& b) { return place(a) < place(b); });
            last = std::unique(run, next, [&](const Coded& a, const Coded& b) { return place(a) == place(b); });
        }
        kept = kept == run ? last : std::move(run, last, kept);
        run = next;
    }
    order.erase(kept, order.end());
}

} // namespace

BoxTree::BoxTree(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
                 Interrupter* interrupter)
{
    if (triangles.empty()) return;
    sort(points, triangles, copies, interrupter);
    buildBoxes(points, interrupter);
}

void BoxTree::sort(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
                   Interrupter* interrupter)
{
    std::vector<Vec3d> centres(triangles.size());
    std::vector<Coded> order(triangles.size());
    parallelFor(Range(0, triangles.size(), 4096), [&](const Range& range) {
        throwIfInterrupted(interrupter);
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            const Box box = Box::of(cornersOf(points, triangles[t]));
            centres[t] = 0.5 * box.lo + 0.5 * box.hi;
            order[t] = {0, static_cast<std::uint32_t>(t)};
        }
    });
    sortAlongCurve(centres, order.begin(), order.end(), leafSize, interrupter);
    if (copies == Copies::drop) dropCopies(points, triangles, order, interrupter);
    items_.reserve(order.size());
    for (const Coded& coded : order) items_.push_back({triangles[coded.triangle], coded.triangle});
}

void BoxTree::buildBoxes(const std::vector<Vec3d>& points, Interrupter* interrupter)
{
    std::vector<Box> leaves((items_.size() + leafSize - 1) / leafSize);
    parallelFor(Range(0, leaves.size(), 1024), [&](const Range& range) {
        throwIfInterrupted(interrupter);
        for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) {
            const std::size_t first = leaf * leafSize, last = std::min(first + leafSize, items_.size());
            leaves[leaf] = Box::of(cornersOf(points, items_[first].corners));
            for (std::size_t i = first + 1; i < last; ++i) {
                leaves[leaf] = joined(leaves[leaf], Box::of(cornersOf(points, items_[i].corners)));
            }
        }
    });
    levels_.push_back(std::move(leaves));
    while (levels_.back().size() > 1) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> level((below.size() + 1) / 2);
        for (std::size_t i = 0; i < level.size(); ++i) {
            level[i] = 2 * i + 1 < below.size() ? joined(below[2 * i], below[2 * i + 1]) : below[2 * i];
        }
        levels_.push_back(std::move(level));
    }
    const Box& all = levels_.back().front();
    for (int i = 0; i < 3; ++i) farthest_ = std::max({farthest_, std::abs(all.lo[i]), std::abs(all.hi[i])});
}

BoxTree::Slab BoxTree::slabOf(const Corners& triangle, double maxDistance) const
{
    // Right for any normal, the triangle's own is the best. Without one nothing is beside the slab. Nor is it where
    // lengths lose digits or the heights below overflow.
    const double infinity = std::numeric_limits<double>::infinity();
    const Slab everything{Vec3d(0.0), -infinity, infinity};
    Vec3d normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
    const double length = normal.length();
    if (!(length > 1e-150) || !(length < 1e150)) return everything;
    normal /= length;
    Slab slab{normal, infinity, -infinity};
    double farthest = farthest_;
    for (const Vec3d& p : triangle) {
        const double height = normal.dot(p);
        slab.low = std::min(slab.low, height);
        slab.high = std::max(slab.high, height);
        for (int i = 0; i < 3; ++i) farthest = std::max(farthest, std::abs(p[i]));
    }
    // The rounding of such a dot product is at most 3 eps (|n0| + |n1| + |n2|) farthest, and there are two of them. The
    // normal's length is 1 within 4 eps. The least normal number is more than what subnormal ones lose.
    if (!(farthest < 1e300)) return everything;
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * farthest + std::numeric_limits<double>::min();
    slab.low -= 1.001 * maxDistance + rounding;
    slab.high += 1.001 * maxDistance + rounding;
    return slab;
}

} // namespace vdbcage::detail
