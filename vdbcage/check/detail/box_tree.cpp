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

/// Returns bits 0 to 20 of n, with two zeros between each.
std::uint64_t spread(std::uint64_t n)
{
    n = (n | n << 32U) & 0x001f00000000ffffU;
    n = (n | n << 16U) & 0x001f0000ff0000ffU;
    n = (n | n << 8U) & 0x100f00f00f00f00fU;
    n = (n | n << 4U) & 0x10c30c30c30c30c3U;
    return (n | n << 2U) & 0x1249249249249249U;
}

/// Returns the position of a point on the curve through `all`, in 63 bits.
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

/// Returns the corners in the order of their coordinates: the same for every copy.
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

/// Returns half the area of a box's sides.
double areaOf(const Box& box)
{
    const Vec3d size = box.hi - box.lo;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

struct Coded {
    std::uint64_t code;
    std::uint32_t triangle;

    bool operator<(const Coded& other) const
    {
        return code != other.code ? code < other.code : triangle < other.triangle;
    }
};

/// Returns the end of the run of equal codes that begins at `run`.
std::vector<Coded>::iterator endOfRun(std::vector<Coded>::iterator run, std::vector<Coded>::iterator end)
{
    return std::find_if(run, end, [code = run->code](const Coded& coded) { return coded.code != code; });
}

/// Sorts triangles from `begin` to `end` along the curve through the box of their centres. Those of one cell follow a
/// curve through that cell. Triangles with one centre are in a run of one code.
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

/// Drops all but the first of equal triangles. Copies have one centre, so they are in one run of equal codes.
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
    const auto cornersOfItem = [&](std::size_t i) { return cornersOf(points, items_[i].corners); };
    levels_ = boxes([&](std::size_t i) { return Box::of(cornersOfItem(i)); }, interrupter);
    farthest_ = farthestOf(levels_.back().front());
    if (const auto axes = axesOfNeedles(points, interrupter)) {
        needles_ = *axes;
        alongNeedles_ = boxes([&](std::size_t i) { return boxAlong(needles_, cornersOfItem(i)); }, interrupter);
    }
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

template <typename BoxOf>
BoxTree::Levels BoxTree::boxes(const BoxOf& boxOf, Interrupter* interrupter) const
{
    std::vector<Box> leaves((items_.size() + leafSize - 1) / leafSize);
    parallelFor(Range(0, leaves.size(), 1024), [&](const Range& range) {
        throwIfInterrupted(interrupter);
        for (std::size_t leaf = range.begin(); leaf < range.end(); ++leaf) {
            const std::size_t first = leaf * leafSize, last = std::min(first + leafSize, items_.size());
            leaves[leaf] = boxOf(first);
            for (std::size_t i = first + 1; i < last; ++i) leaves[leaf] = joined(leaves[leaf], boxOf(i));
        }
    });
    Levels levels;
    levels.push_back(std::move(leaves));
    while (levels.back().size() > 1) {
        const std::vector<Box>& below = levels.back();
        std::vector<Box> level((below.size() + 1) / 2);
        for (std::size_t i = 0; i < level.size(); ++i) {
            level[i] = 2 * i + 1 < below.size() ? joined(below[2 * i], below[2 * i + 1]) : below[2 * i];
        }
        levels.push_back(std::move(level));
    }
    return levels;
}

std::optional<BoxTree::Axes> BoxTree::axesOfNeedles(const std::vector<Vec3d>& points, Interrupter* interrupter) const
{
    constexpr double muchLess = 0.25; // of the area of all boxes
    Asker ask(interrupter);
    double sum = 0, least = 0, most = 0;
    Corners longest{};
    for (const Item& item : items_) {
        ask();
        const Corners t = cornersOf(points, item.corners);
        const double area = areaOf(Box::of(t)), own = (t[1] - t[0]).cross(t[2] - t[0]).length();
        sum += area;
        least += own;
        if (!(area - own > most)) continue;
        most = area - own;
        longest = t;
    }
    if (!(least < muchLess * sum) || !(sum < 1e300) || !(farthest_ < 1e300)) return std::nullopt;
    Axes axes{longest[1] - longest[0], longest[2] - longest[1], longest[0] - longest[2]};
    std::sort(axes.begin(), axes.end(), [](const Vec3d& a, const Vec3d& b) { return a.lengthSqr() > b.lengthSqr(); });
    axes[2] = axes[0].cross(axes[1]);
    axes[1] = axes[2].cross(axes[0]);
    for (Vec3d& axis : axes) {
        if (!axis.normalize(0)) return std::nullopt;
    }
    double turned = 0;
    for (const Item& item : items_) {
        ask();
        turned += areaOf(boxAlong(axes, cornersOf(points, item.corners)));
    }
    return turned < muchLess * sum ? std::optional(axes) : std::nullopt;
}

Box BoxTree::boxAlong(const Axes& axes, const Corners& triangle)
{
    // The rounding of such a dot product is at most 3 eps (|a0| + |a1| + |a2|) farthest, below 6 eps farthest, as the
    // axis has length 1 within 4 eps. The same points come near along any axes, so these need not be perpendicular.
    Corners turned;
    for (std::size_t k = 0; k < 3; ++k) {
        turned[k] = {axes[0].dot(triangle[k]), axes[1].dot(triangle[k]), axes[2].dot(triangle[k])};
    }
    const Box box = Box::of(turned);
    const Vec3d rounding(8 * std::numeric_limits<double>::epsilon() * farthestOf(Box::of(triangle)) +
                         std::numeric_limits<double>::min());
    return {box.lo - rounding, box.hi + rounding};
}

BoxTree::Slab BoxTree::slabOf(const Corners& triangle, double maxDistance) const
{
    // Right for any normal; the triangle's own is the best. If there is no normal, nothing is beside the slab. The same
    // holds where lengths lose digits or the heights below overflow.
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
    // normal's length is 1 within 4 eps. The least normal number is more than the loss of subnormal ones.
    if (!(farthest < 1e300)) return everything;
    const double rounding = 16 * std::numeric_limits<double>::epsilon() * farthest + std::numeric_limits<double>::min();
    slab.low -= 1.001 * maxDistance + rounding;
    slab.high += 1.001 * maxDistance + rounding;
    return slab;
}

} // namespace vdbcage::detail
