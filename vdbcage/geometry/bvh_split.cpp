// Based on: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned splits).
// Differs: bins along one axis only (the longest of the centroids).
#include <vdbcage/geometry/bvh_split.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/bvh_copies.h>

namespace vdbcage::detail {

namespace {

constexpr std::size_t binCount = 16;
constexpr std::size_t parallelBinSize = 1U << 17; // leaves in a node that are worth binning in parallel

struct Bins {
    std::array<FloatBox, binCount> boxes;
    std::array<std::size_t, binCount> counts{};

    Bins operator+(const Bins& other) const
    {
        Bins sum = *this;
        for (std::size_t i = 0; i < binCount; ++i) {
            sum.boxes[i].expand(other.boxes[i].lo, other.boxes[i].hi);
            sum.counts[i] += other.counts[i];
        }
        return sum;
    }
};

struct Merge {
    FloatBox operator()(FloatBox a, const FloatBox& b) const
    {
        a.expand(b.lo, b.hi);
        return a;
    }
    Bins operator()(const Bins& a, const Bins& b) const { return a + b; }
};

// Folds add(T, LeafRef) over the range, in parallel if it is long. The order does not matter: results are minima,
// maxima and counts.
template <typename T, typename Add>
T fold(const LeafRef* begin, const LeafRef* end, const Add& add)
{
    const auto foldRange = [&](const tbb::blocked_range<const LeafRef*>& range, T value) {
        for (const LeafRef* ref = range.begin(); ref != range.end(); ++ref) add(value, *ref);
        return value;
    };
    if (static_cast<std::size_t>(end - begin) < parallelBinSize) return foldRange({begin, end}, T());
    return parallelReduce(tbb::blocked_range<const LeafRef*>(begin, end, parallelBinSize / 8), T(), foldRange, Merge());
}

// The assignment of leaves to bins of the longest axis of the centroids.
struct Binning {
    explicit Binning(const FloatBox& centroids)
    {
        for (std::size_t i = 1; i < 3; ++i) {
            if (centroids.hi[i] - centroids.lo[i] > centroids.hi[axis] - centroids.lo[axis]) axis = i;
        }
        origin = centroids.lo[axis];
        const float extent = centroids.hi[axis] - centroids.lo[axis];
        scale = extent > 1e-30F ? binCount / extent : 0.0F;
    }
    std::size_t bin(const LeafRef& ref) const
    {
        return std::min(binCount - 1, static_cast<std::size_t>((ref.twiceCentre()[axis] - origin) * scale));
    }

    std::size_t axis = 0;
    float origin, scale;
};

// Returns the number of bins on the left side of the cheapest split by the surface area heuristic, 0 if no split leaves
// two or more leaves on either side (two, so that there are never more nodes than leaves).
std::size_t cheapestSplit(const Bins& bins)
{
    std::array<float, binCount> rightCost{};
    FloatBox box;
    std::size_t count = 0;
    for (std::size_t i = binCount - 1; i > 0; --i) {
        box.expand(bins.boxes[i].lo, bins.boxes[i].hi);
        count += bins.counts[i];
        rightCost[i] = count < 2 ? -1.0F : box.area() * static_cast<float>(count);
    }
    std::size_t best = 0;
    float bestCost = std::numeric_limits<float>::infinity();
    box = FloatBox();
    count = 0;
    for (std::size_t i = 1; i < binCount; ++i) {
        box.expand(bins.boxes[i - 1].lo, bins.boxes[i - 1].hi);
        count += bins.counts[i - 1];
        if (count < 2 || rightCost[i] < 0) continue;
        const float cost = box.area() * static_cast<float>(count) + rightCost[i];
        if (cost < bestCost) {
            bestCost = cost;
            best = i;
        }
    }
    return best;
}

// Sorts refs into two sides by the cheapest split of bins and returns the beginning of the second, or `first` if there
// is none.
LeafRef* splitByBins(const Binning& binning, LeafRef* first, LeafRef* last, Interrupter* interrupter)
{
    const std::size_t best = cheapestSplit(fold<Bins>(first, last, [&](Bins& bins, const LeafRef& ref) {
        const std::size_t bin = binning.bin(ref);
        bins.boxes[bin].expand(ref.lo, ref.hi);
        ++bins.counts[bin];
    }));
    if (best == 0) return first;
    Asker ask(interrupter);
    return std::partition(first, last, [&](const LeafRef& ref) {
        ask();
        return binning.bin(ref) < best;
    });
}

// Sorts refs into halves along the axis of the bins and returns the beginning of the second.
LeafRef* halve(const Binning& binning, LeafRef* first, LeafRef* last, Interrupter* interrupter)
{
    Asker ask(interrupter);
    LeafRef* const middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](const LeafRef& a, const LeafRef& b) {
        ask();
        return std::make_pair(a.twiceCentre()[binning.axis], a.triangle) <
               std::make_pair(b.twiceCentre()[binning.axis], b.triangle);
    });
    return middle;
}

} // namespace

std::uint32_t LeafSplitter::split(LeafRange& range) const
{
    if (range.isLarge()) throwIfInterrupted(interrupter_);
    LeafRef* const first = leaves_.refs.get() + range.begin;
    LeafRef* last = leaves_.refs.get() + range.end;
    const auto indexOf = [&](const LeafRef* ref) { return range.begin + static_cast<std::uint32_t>(ref - first); };
    const Binning binning(fold<FloatBox>(
        first, last, [](FloatBox& box, const LeafRef& ref) { box.expand(ref.twiceCentre(), ref.twiceCentre()); }));
    if (!range.isDeep() && binning.scale > 0) {
        const LeafRef* const middle = splitByBins(binning, first, last, interrupter_);
        if (middle != first) return indexOf(middle);
    }
    if (copies_ == TriangleBvh::Copies::drop && !(binning.scale > 0)) {
        last = dropCopies(triangles_, first, last, interrupter_);
        range.end = indexOf(last);
        if (range.size() == 1) return range.end;
    }
    return indexOf(halve(binning, first, last, interrupter_));
}

} // namespace vdbcage::detail
