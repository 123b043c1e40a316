// Based on: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned splits);
//           C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5 (closest point on a triangle).
// Differs: bins along one axis only (the longest of the centroids); node boxes are exact, in double.
#include <vdbcage/mesh/detail/triangle_tree.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_reduce.h>

namespace vdbcage::detail {

namespace {

constexpr std::uint32_t leafSize = 3;
constexpr std::size_t binCount = 16;
constexpr std::size_t binnedDepth = 60;           // deeper nodes are halved: 2^32 triangles end within 32 more
constexpr std::size_t taskSize = 4096;            // triangles in a subtree that are worth a task
constexpr std::size_t parallelBinSize = 1U << 17; // triangles in a node that are worth binning in parallel

// A triangle while the tree is built. The coordinates only guide the splits, so they are floats, moved and scaled to
// the unit cube: any size and place of the model is the same to them.
struct Ref {
    std::array<float, 3> lo, hi;
    std::uint32_t triangle;

    float centre(std::size_t axis) const { return 0.5F * (lo[axis] + hi[axis]); }
};

struct FloatBox {
    std::array<float, 3> lo{2, 2, 2}, hi{-2, -2, -2};

    void expand(const std::array<float, 3>& otherLo, const std::array<float, 3>& otherHi)
    {
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = std::min(lo[i], otherLo[i]);
            hi[i] = std::max(hi[i], otherHi[i]);
        }
    }
    float area() const
    {
        const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
        return x * y + y * z + z * x;
    }
};

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

// Folds add(T, Ref) over the range, in parallel if it is long. Minima, maxima and counts: the order does not matter.
template <typename T, typename Add>
T fold(const Ref* begin, const Ref* end, const Add& add)
{
    const auto foldRange = [&](const tbb::blocked_range<const Ref*>& range, T value) {
        for (const Ref* ref = range.begin(); ref != range.end(); ++ref) add(value, *ref);
        return value;
    };
    if (static_cast<std::size_t>(end - begin) < parallelBinSize) return foldRange({begin, end}, T());
    return tbb::parallel_reduce(tbb::blocked_range<const Ref*>(begin, end, parallelBinSize / 8), T(), foldRange,
                                Merge());
}

// Which bin of the longest axis of the centroids a triangle belongs to.
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
    std::size_t bin(const Ref& ref) const
    {
        return std::min(binCount - 1, static_cast<std::size_t>((ref.centre(axis) - origin) * scale));
    }

    std::size_t axis = 0;
    float origin, scale;
};

// The number of bins on the left side of the cheapest split by the surface area heuristic, 0 if no split leaves two or
// more triangles on either side (two, so that there are never more nodes than triangles).
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

Vec3d closestPointOnSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b)
{
    const Vec3d ab = b - a;
    const double length2 = ab.dot(ab);
    const double t = length2 > 0 ? std::clamp(ab.dot(p - a) / length2, 0.0, 1.0) : 0.0;
    return a + t * ab;
}

// The filters' error bounds hold while nothing overflows, and while what underflows is below `underflow`.
constexpr double largest = 1e100, smallest = 1e-100, underflow = 1e-200;
constexpr double roundingErrors = 16 * std::numeric_limits<double>::epsilon(); // twice and more what is needed

double maxAbs(const Vec3d& v)
{
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

} // namespace

Box Box::of(const Corners& t)
{
    return {openvdb::math::minComponent(t[0], openvdb::math::minComponent(t[1], t[2])),
            openvdb::math::maxComponent(t[0], openvdb::math::maxComponent(t[1], t[2]))};
}

void Box::expand(const Box& other)
{
    lo = openvdb::math::minComponent(lo, other.lo);
    hi = openvdb::math::maxComponent(hi, other.hi);
}

Vec3d closestPointOnTriangle(const Vec3d& p, const Corners& triangle)
{
    // Which of the seven regions p lies above: a corner's, an edge's or the inside's.
    const auto& [a, b, c] = triangle;
    const Vec3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return a;
    if (d3 >= 0 && d4 <= d3) return b;
    if (d6 >= 0 && d5 <= d6) return c;
    const double wa = d3 * d6 - d5 * d4, wb = d5 * d2 - d1 * d6, wc = d1 * d4 - d3 * d2;
    if (wa > 0 && wb > 0 && wc > 0) return a + (wb / (wa + wb + wc)) * ab + (wc / (wa + wb + wc)) * ac;
    if (wc <= 0 && d1 > 0 && d3 < 0) return a + (d1 / (d1 - d3)) * ab;
    if (wb <= 0 && d2 > 0 && d6 < 0) return a + (d2 / (d2 - d6)) * ac;
    if (wa <= 0 && d4 > d3 && d5 > d6) return b + ((d4 - d3) / (d4 - d3 + d5 - d6)) * (c - b);
    // Only for degenerate triangles, or nearly so: the nearest point of the three edges.
    Vec3d best = closestPointOnSegment(p, a, b);
    for (const Vec3d& other : {closestPointOnSegment(p, b, c), closestPointOnSegment(p, c, a)}) {
        if ((other - p).lengthSqr() < (best - p).lengthSqr()) best = other;
    }
    return best;
}

TriangleFilter::TriangleFilter(const Corners& triangle) : box_(Box::of(triangle)), corner_(triangle[0])
{
    const Vec3d u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
    normal_ = u.cross(v);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        errorScale_[i] = roundingErrors * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
    }
    const double edge = std::max(maxAbs(u), maxAbs(v));
    usePlane_ = edge > smallest && edge < largest && maxAbs(corner_) < largest;
}

bool TriangleFilter::planeMayMeet(const Box& box) const
{
    if (!usePlane_) return true;
    double least = 0, most = 0, error = underflow;
    for (int i = 0; i < 3; ++i) {
        const double lo = box.lo[i] - corner_[i], hi = box.hi[i] - corner_[i];
        const double atLo = normal_[i] * lo, atHi = normal_[i] * hi;
        least += std::min(atLo, atHi);
        most += std::max(atLo, atHi);
        error += errorScale_[i] * std::max(std::abs(lo), std::abs(hi));
    }
    // Written so that a box too far away to compute with (NaN, infinite) counts as met.
    return !(least > error || most < -error);
}

SegmentFilter::SegmentFilter(const Vec3d& a, const Vec3d& b) : start_(a), direction_(b - a)
{
    box_ = Box::of(a);
    box_.expand(Box::of(b));
    useLine_ = maxAbs(a) < largest && maxAbs(direction_) < largest && maxAbs(direction_) > smallest;
}

bool SegmentFilter::lineMayMeet(const Box& box) const
{
    if (!useLine_) return true;
    const Vec3d lo = box.lo - start_, hi = box.hi - start_;
    for (int i = 0; i < 3; ++i) {
        // In the plane of the axes j and k: the range, over the box, of which side of the line a point lies.
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double j0 = direction_[k] * lo[j], j1 = direction_[k] * hi[j];
        const double k0 = direction_[j] * lo[k], k1 = direction_[j] * hi[k];
        const double least = std::min(k0, k1) - std::max(j0, j1), most = std::max(k0, k1) - std::min(j0, j1);
        const double error =
            underflow + roundingErrors * (std::max(std::abs(j0), std::abs(j1)) + std::max(std::abs(k0), std::abs(k1)));
        if (least > error || most < -error) return false;
    }
    return true;
}

class TreeBuilder {
public:
    TreeBuilder(TriangleTree& tree, const std::vector<Vec3I>& triangles, Interrupter* interrupter)
        : tree_(tree), triangles_(triangles), interrupter_(interrupter), refs_(triangles.size())
    {
    }

    void build()
    {
        makeRefs();
        tree_.items_.resize(triangles_.size());
        tree_.nodes_.reset(new TriangleTree::Node[triangles_.size() + 1]); // not initialized: few pages are touched
        nodeCount_ = 1;
        buildNode(0, 0, static_cast<std::uint32_t>(refs_.size()), 0);
    }

private:
    void makeRefs()
    {
        const Box box = tbb::parallel_reduce(
            tbb::blocked_range<std::size_t>(0, refs_.size(), 16384), itemBox(0),
            [&](const tbb::blocked_range<std::size_t>& range, Box sum) {
                throwIfInterrupted(interrupter_);
                for (std::size_t i = range.begin(); i < range.end(); ++i) sum.expand(itemBox(i));
                return sum;
            },
            [](Box a, const Box& b) {
                a.expand(b);
                return a;
            });
        const Vec3d centre = box.lo * 0.5 + box.hi * 0.5, half = box.hi * 0.5 - box.lo * 0.5; // must not overflow
        const double inverse = 1 / maxAbs(half), scale = std::isfinite(inverse) ? inverse : 1.0;
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, refs_.size(), 16384),
                          [&](const tbb::blocked_range<std::size_t>& range) {
                              throwIfInterrupted(interrupter_);
                              for (std::size_t i = range.begin(); i < range.end(); ++i) {
                                  const Box item = itemBox(i);
                                  refs_[i].triangle = static_cast<std::uint32_t>(i);
                                  for (std::size_t k = 0; k < 3; ++k) {
                                      const int axis = static_cast<int>(k);
                                      refs_[i].lo[k] = static_cast<float>((item.lo[axis] - centre[axis]) * scale);
                                      refs_[i].hi[k] = static_cast<float>((item.hi[axis] - centre[axis]) * scale);
                                  }
                              }
                          });
    }

    Box itemBox(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return Box::of({tree_.points_[t[0]], tree_.points_[t[1]], tree_.points_[t[2]]});
    }

    void buildNode(std::uint32_t nodeIndex, std::uint32_t begin, std::uint32_t end, std::size_t depth)
    {
        TriangleTree::Node& node = tree_.nodes_[nodeIndex];
        if (end - begin <= leafSize) {
            node.first = begin;
            node.count = end - begin;
            node.box = itemBox(refs_[begin].triangle);
            for (std::uint32_t i = begin; i < end; ++i) {
                const std::uint32_t triangle = refs_[i].triangle;
                tree_.items_[i] = {triangles_[triangle], triangle};
                node.box.expand(itemBox(triangle));
            }
            return;
        }
        const bool large = end - begin > taskSize;
        if (large) throwIfInterrupted(interrupter_);
        const std::uint32_t middle = split(begin, end, depth);
        const std::uint32_t children = nodeCount_.fetch_add(2, std::memory_order_relaxed);
        const auto left = [&] { buildNode(children, begin, middle, depth + 1); };
        const auto right = [&] { buildNode(children + 1, middle, end, depth + 1); };
        if (large) {
            tbb::parallel_invoke(left, right);
        } else {
            left();
            right();
        }
        node.first = children;
        node.count = 0;
        node.box = tree_.nodes_[children].box;
        node.box.expand(tree_.nodes_[children + 1].box);
    }

    // Sorts the range of refs into two sides and returns where the second begins.
    std::uint32_t split(std::uint32_t begin, std::uint32_t end, std::size_t depth)
    {
        Ref* const first = refs_.data() + begin;
        Ref* const last = refs_.data() + end;
        const Binning binning(fold<FloatBox>(first, last, [](FloatBox& box, const Ref& ref) {
            const std::array<float, 3> centre{ref.centre(0), ref.centre(1), ref.centre(2)};
            box.expand(centre, centre);
        }));
        if (depth < binnedDepth && binning.scale > 0) {
            const std::size_t best = cheapestSplit(fold<Bins>(first, last, [&](Bins& bins, const Ref& ref) {
                const std::size_t bin = binning.bin(ref);
                bins.boxes[bin].expand(ref.lo, ref.hi);
                ++bins.counts[bin];
            }));
            if (best > 0) {
                const Ref* const middle =
                    std::partition(first, last, [&](const Ref& ref) { return binning.bin(ref) < best; });
                return begin + static_cast<std::uint32_t>(middle - first);
            }
        }
        const std::uint32_t middle = begin + (end - begin) / 2;
        std::nth_element(first, refs_.data() + middle, last, [&](const Ref& a, const Ref& b) {
            return std::make_pair(a.centre(binning.axis), a.triangle) <
                   std::make_pair(b.centre(binning.axis), b.triangle);
        });
        return middle;
    }

    TriangleTree& tree_;
    const std::vector<Vec3I>& triangles_;
    Interrupter* interrupter_;
    std::vector<Ref> refs_;
    std::atomic<std::uint32_t> nodeCount_{0};
};

TriangleTree::TriangleTree(std::vector<Vec3d> points, const std::vector<Vec3I>& triangles, Interrupter* interrupter)
    : points_(std::move(points))
{
    if (!triangles.empty()) TreeBuilder(*this, triangles, interrupter).build();
}

TriangleTree::Closest TriangleTree::closest(const Vec3d& p, std::uint32_t seed, double bound) const
{
    Closest best;
    best.squaredDistance = bound;
    if (empty()) return best;
    const auto tryItem = [&](std::uint32_t item) {
        const Vec3d point = closestPointOnTriangle(p, corners(items_[item]));
        const double squaredDistance = (point - p).lengthSqr();
        if (squaredDistance < best.squaredDistance) best = {point, squaredDistance, item};
    };
    if (seed != none) tryItem(seed);

    struct Entry {
        std::uint32_t node;
        double squaredDistance;
    };
    Stack<Entry> stack;
    stack.push({0, box().squaredDistance(p)});
    while (!stack.empty()) {
        const Entry entry = stack.pop();
        if (!(entry.squaredDistance < best.squaredDistance)) continue;
        const Node& node = nodes_[entry.node];
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) tryItem(i);
            continue;
        }
        Entry near{node.first, nodes_[node.first].box.squaredDistance(p)};
        Entry far{node.first + 1, nodes_[node.first + 1].box.squaredDistance(p)};
        if (far.squaredDistance < near.squaredDistance) std::swap(near, far);
        stack.push(far);
        stack.push(near);
    }
    return best;
}

} // namespace vdbcage::detail
