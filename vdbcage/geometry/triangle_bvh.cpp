// Based on: I. Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", 2007 (binned splits);
//           C. Ericson, "Real-Time Collision Detection", 2005, 5.1.5 (closest point on a triangle).
//           I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008 (trees of four children for SIMD).
//           S. Woop et al., "Exploiting Local Orientation Similarity for Efficient Ray Traversal of Hair and Fur",
//           2014 (boxes along their content, triangles sorted by direction).
// Differs: bins along one axis only (the longest of the centroids); all boxes below a node are along the same axes.
#include <vdbcage/geometry/triangle_bvh.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <functional>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

namespace {

constexpr std::size_t binCount = 16;
constexpr std::size_t binnedDepth = 60;           // deeper nodes are halved: 2^32 leaves end within 32 more levels
constexpr std::size_t taskSize = 4096;            // leaves in a subtree that are worth a task
constexpr std::size_t parallelBinSize = 1U << 17; // leaves in a node that are worth binning in parallel
// Trees of many triangles have leaves of several, which makes far fewer nodes, since memory limits their speed. Smaller
// trees fit into caches and gain nothing.
constexpr std::size_t manyTriangles = 1U << 19;
constexpr std::uint32_t leafSize = 4;
constexpr float leafGrowth = 1.6F; // the largest ratio of a leaf's box to the largest of its triangles', in area
// A needle has at least this many times as large an area in a box along x, y and z as in one along itself. At least
// `crowd` boxes of needles side by side must meet in a place, or other axes gain too little.
constexpr float needle = 4;
constexpr std::uint32_t crowd = 32;

// A leaf's box while the tree is built, in the tree's units. The fourth components of lo and hi mean nothing. Not
// initialized by default.
struct Ref {
    Floats lo, hi;
    std::uint32_t triangle; // the first of its triangles
    std::uint32_t count;
    float leastArea; // of a box along its triangles, about

    Floats twiceCentre() const { return lo + hi; }
};

// A child of a node and the square of its distance, in one word: a load of both halves that were just stored would have
// to wait, since they cannot be forwarded.
class Near {
public:
    Near() = default; // not initialized
    Near(std::uint32_t child, float squaredDistance)
    {
        std::uint32_t bits;
        std::memcpy(&bits, &squaredDistance, sizeof bits);
        word_ = std::uint64_t(bits) << 32 | child;
    }
    std::uint32_t child() const { return static_cast<std::uint32_t>(word_); }
    float squaredDistance() const
    {
        const auto bits = static_cast<std::uint32_t>(word_ >> 32);
        float squaredDistance;
        std::memcpy(&squaredDistance, &bits, sizeof bits);
        return squaredDistance;
    }

private:
    std::uint64_t word_;
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

// Folds add(T, Ref) over the range, in parallel if it is long. The order does not matter: results are minima, maxima
// and counts.
template <typename T, typename Add>
T fold(const Ref* begin, const Ref* end, const Add& add)
{
    const auto foldRange = [&](const tbb::blocked_range<const Ref*>& range, T value) {
        for (const Ref* ref = range.begin(); ref != range.end(); ++ref) add(value, *ref);
        return value;
    };
    if (static_cast<std::size_t>(end - begin) < parallelBinSize) return foldRange({begin, end}, T());
    return parallelReduce(tbb::blocked_range<const Ref*>(begin, end, parallelBinSize / 8), T(), foldRange, Merge());
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
    std::size_t bin(const Ref& ref) const
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

Vec3d closestPointOnSegment(const Vec3d& p, const Vec3d& a, const Vec3d& b)
{
    const Vec3d ab = b - a;
    const double length2 = ab.dot(ab);
    const double t = length2 > 0 ? std::clamp(ab.dot(p - a) / length2, 0.0, 1.0) : 0.0;
    return a + t * ab;
}

constexpr double infinity = std::numeric_limits<double>::infinity();
// Narrower slivers have no usable plane: one computed from them may point astray by more than 1e-7.
constexpr double leastSine = 1e-8, smallest = 1e-100;

// Return floats not above and not below, off by up to 2e-7 of the value.
float roundedDown(double value)
{
    return static_cast<float>(value - 1.2e-7 * std::abs(value) - 1e-40);
}
float roundedUp(double value)
{
    return static_cast<float>(value + 1.2e-7 * std::abs(value) + 1e-40);
}

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
    // The region of seven above which p lies: a corner's, an edge's or the inside's.
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
    // Only for degenerate or nearly degenerate triangles: the nearest point of the three edges.
    Vec3d best = closestPointOnSegment(p, a, b);
    for (const Vec3d& other : {closestPointOnSegment(p, b, c), closestPointOnSegment(p, c, a)}) {
        if ((other - p).lengthSqr() < (best - p).lengthSqr()) best = other;
    }
    return best;
}

TriangleBvh::Query::Query(const Box& box)
{
    // All nodes lie within [-1.1, 1.1]. NaN, of a box too far away for the arithmetic, stays and is met nowhere.
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        lo_[i] = Floats{} + roundedDown(std::clamp(box.lo[axis], -4.0, 4.0));
        hi_[i] = Floats{} + roundedUp(std::clamp(box.hi[axis], -4.0, 4.0));
    }
}

/// Adds a slab. `farthest` is the largest coordinate from which it was computed.
void TriangleBvh::Query::addSlab(const Vec3d& normal, double low, double high, double farthest)
{
    // Projections of nodes, in float, are off by less than 3e-6; a normal may point astray by 1e-7.
    const double slack = 4e-6 + 2e-7 * farthest;
    Slab& slab = slab_[slabs_++];
    for (std::size_t i = 0; i < 3; ++i) {
        const auto component = static_cast<float>(normal[static_cast<int>(i)]);
        slab.normal[i] = Floats{} + component;
        slab.absolute[i] = Floats{} + std::abs(component);
    }
    slab.twiceLow = Floats{} + static_cast<float>(std::clamp(2 * (low - slack), -1e30, 1e30));
    slab.twiceHigh = Floats{} + static_cast<float>(std::clamp(2 * (high + slack), -1e30, 1e30));
}

TriangleBvh::Query TriangleBvh::Query::along(const Frame& frame) const
{
    std::array<std::array<Floats, 3>, 3> axes;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            axes[i][j] = Floats{} + static_cast<float>(frame.axes[i][static_cast<int>(j)]);
        }
    }
    const auto turned = [&](std::size_t i, const std::array<Floats, 3>& v) {
        return axes[i][0] * v[0] + axes[i][1] * v[1] + axes[i][2] * v[2];
    };
    const auto absolute = [](Floats v) { return greatest(v, -v); };
    Query query = aroundPoints(frame);
    if (query.count_ == 0) {
        // Places are within 4 in each direction, turned ones within 7: off by less than 4e-6 in float.
        std::array<Floats, 3> middle, half;
        for (std::size_t i = 0; i < 3; ++i) {
            middle[i] = (lo_[i] + hi_[i]) * 0.5F;
            half[i] = (hi_[i] - lo_[i]) * 0.5F;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const Floats centre = turned(i, middle);
            const Floats reach = absolute(axes[i][0]) * half[0] + absolute(axes[i][1]) * half[1] +
                                 absolute(axes[i][2]) * half[2] + 4e-6F;
            query.lo_[i] = centre - reach;
            query.hi_[i] = centre + reach;
        }
    }
    for (std::size_t k = 0; k < slabs_; ++k) {
        const Slab& from = slab_[k];
        Slab& to = query.slab_[query.slabs_++];
        for (std::size_t i = 0; i < 3; ++i) {
            to.normal[i] = turned(i, from.normal);
            to.absolute[i] = absolute(to.normal[i]);
        }
        // Projections of nodes, twice, are off by less than 5e-6 by the boxes, and by 4e-6 by the normal.
        to.twiceLow = from.twiceLow - 1e-5F;
        to.twiceHigh = from.twiceHigh + 1e-5F;
    }
    return query;
}

/// Returns a query with slabs along the first axis alone; without points if there are none, or if they are too far
/// away.
TriangleBvh::Query TriangleBvh::Query::aroundPoints(const Frame& frame) const
{
    if (count_ == 0) return {};
    std::array<Vec3d, 4> turned;
    double farthest = 1;
    for (std::size_t i = 0; i < count_; ++i) {
        turned[i] = frame.of(points_[i]);
        farthest = std::max(farthest, maxAbs(points_[i]));
    }
    Box box = Box::of(turned[0]);
    for (std::size_t i = 1; i < count_; ++i) box.expand(Box::of(turned[i]));
    // Turning a point adds an error of less than 2e-15 of its size.
    const Vec3d reach(margin_ + 4e-15 * farthest);
    if (!(farthest < 1e150) || !reach.isFinite()) return {};
    Query query({box.lo - reach, box.hi + reach});
    query.points_ = points_;
    query.count_ = count_;
    query.margin_ = margin_;
    // A needle is long: along it, it shows whether it passes by.
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3d edge = turned[i] - turned[j];
            const double length = std::hypot(edge[1], edge[2]);
            if (!(length > leastSine * edge.length()) || !(length > smallest)) continue;
            const Vec3d normal = Vec3d(0, edge[2], -edge[1]) / length;
            double low = infinity, high = -infinity;
            for (std::size_t k = 0; k < count_; ++k) {
                low = std::min(low, normal.dot(turned[k]));
                high = std::max(high, normal.dot(turned[k]));
            }
            // Nodes are within 2 here, so their projections are off by twice as much as in addSlab().
            constexpr double rounding = 4e-6;
            query.addSlab(normal, low - reach[0] - rounding, high + reach[0] + rounding, farthest);
        }
    }
    return query;
}

TriangleBvh::Query TriangleBvh::inBox(const Box& box) const
{
    return Query({inUnits(box.lo), inUnits(box.hi)});
}

TriangleBvh::Query TriangleBvh::near(const Corners& triangle, double maxDistance) const
{
    Box box = Box::of(triangle);
    box.lo -= Vec3d(maxDistance);
    box.hi += Vec3d(maxDistance);
    Query query = inBox(box);
    const Corners t{inUnits(triangle[0]), inUnits(triangle[1]), inUnits(triangle[2])};
    for (const Vec3d& p : t) query.addPoint(p);
    query.margin_ = maxDistance * scale_;
    const Vec3d u = t[1] - t[0], v = t[2] - t[0];
    Vec3d normal = u.cross(v);
    const double length = normal.length();
    if (!(length > leastSine * u.length() * v.length()) || !(length > smallest)) return query;
    normal /= length;
    const double margin = query.margin_, farthest = std::max({maxAbs(t[0]), maxAbs(t[1]), maxAbs(t[2])});
    const double height = normal.dot(t[0]);
    query.addSlab(normal, height - margin, height + margin, farthest);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d edge = t[(i + 1) % 3] - t[i];
        const Vec3d outward = edge.cross(normal) / edge.length();
        query.addSlab(outward, -infinity, outward.dot(t[i]) + margin, farthest);
    }
    return query;
}

TriangleBvh::Query TriangleBvh::inTetrahedron(const std::array<Vec3d, 4>& corners) const
{
    Box box = Box::of(corners[0]);
    for (const Vec3d& p : corners) box.expand(Box::of(p));
    Query query = inBox(box);
    std::array<Vec3d, 4> p;
    double farthest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        p[i] = inUnits(corners[i]);
        query.addPoint(p[i]);
        farthest = std::max(farthest, maxAbs(p[i]));
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d& a = p[(i + 1) & 3];
        const Vec3d u = p[(i + 2) & 3] - a, v = p[(i + 3) & 3] - a;
        const Vec3d normal = u.cross(v);
        const double length = normal.length();
        if (!(length > leastSine * u.length() * v.length()) || !(length > smallest)) continue;
        const double here = normal.dot(a) / length, opposite = normal.dot(p[i]) / length;
        query.addSlab(normal / length, std::min(here, opposite), std::max(here, opposite), farthest);
    }
    return query;
}

class TreeBuilder {
public:
    TreeBuilder(TriangleBvh& tree, const std::vector<Vec3I>& triangles, Interrupter* interrupter,
                TriangleBvh::Copies copies)
        : tree_(tree), triangles_(triangles), interrupter_(interrupter), copies_(copies),
          refs_(new Ref[triangles.size()])
    {
    }

    void build()
    {
        setUnits();
        tree_.frames_.emplace_back();
        makeRefs();
        tree_.nodes_.reset(new TriangleBvh::Node[refCount_]); // not initialized: few pages are touched
        nodeCount_ = 1;
        buildNode(0, {0, refCount_, 0, 0});
        placeItems();
    }

private:
    static constexpr std::size_t blockSize = 16384;

    void setUnits()
    {
        const Box box = parallelReduce(
            tbb::blocked_range<std::size_t>(0, triangles_.size(), blockSize), itemBox(0),
            [&](const tbb::blocked_range<std::size_t>& range, Box sum) {
                throwIfInterrupted(interrupter_);
                for (std::size_t i = range.begin(); i < range.end(); ++i) sum.expand(itemBox(i));
                return sum;
            },
            [](Box a, const Box& b) {
                a.expand(b);
                return a;
            });
        const Vec3d half = box.hi * 0.5 - box.lo * 0.5; // must not overflow
        const double inverse = 1 / maxAbs(half);
        tree_.box_ = box;
        tree_.centre_ = box.lo * 0.5 + box.hi * 0.5;
        tree_.scale_ = std::isfinite(inverse) ? inverse : 1.0;
    }

    // Puts triangles that follow each other in about the same box, as those of a quad do, into one leaf. Blocks have a
    // fixed size, so that the leaves are the same for any number of threads.
    void makeRefs()
    {
        const std::size_t blocks = (triangles_.size() + blockSize - 1) / blockSize;
        const std::uint32_t most = triangles_.size() < manyTriangles ? 1 : leafSize;
        std::vector<std::uint32_t> counts(blocks), needles(blocks);
        parallelFor(std::size_t(0), blocks, [&](std::size_t block) {
            throwIfInterrupted(interrupter_);
            Ref* const first = refs_.get() + block * blockSize;
            Ref* last = first;
            *first = refOf(block * blockSize);
            float largest = boxOf(*first).area();
            const std::size_t end = std::min(triangles_.size(), (block + 1) * blockSize);
            for (std::size_t i = block * blockSize + 1; i < end; ++i) {
                const Ref next = refOf(i);
                const float area = boxOf(next).area();
                FloatBox both = boxOf(*last);
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
            counts[block] = static_cast<std::uint32_t>(last + 1 - first);
            needles[block] = static_cast<std::uint32_t>(std::count_if(first, last + 1, isNeedle));
        });
        hasNeedles_ = std::accumulate(needles.begin(), needles.end(), std::size_t(0)) >= crowd;
        for (std::size_t block = 0; block < blocks; ++block) {
            const Ref* const first = refs_.get() + block * blockSize;
            if (refCount_ < block * blockSize) std::copy(first, first + counts[block], refs_.get() + refCount_);
            refCount_ += counts[block];
        }
    }

    Ref refOf(std::size_t triangle) const
    {
        const Corners t = cornersInUnits(triangle);
        Ref ref = boxed(Box::of(t));
        ref.triangle = static_cast<std::uint32_t>(triangle);
        ref.count = 1;
        // Boxes of any thinness are rounded outward, by less than 3e-7.
        const Vec3d u = t[1] - t[0], v = t[2] - t[0];
        const double length = std::max(maxAbs(u), maxAbs(v));
        ref.leastArea = static_cast<float>(u.cross(v).length() + 1e-6 * length + 1e-12);
        return ref;
    }

    static Ref boxed(const Box& box)
    {
        Ref ref;
        ref.lo = Floats{roundedDown(box.lo[0]), roundedDown(box.lo[1]), roundedDown(box.lo[2]), 0};
        ref.hi = Floats{roundedUp(box.hi[0]), roundedUp(box.hi[1]), roundedUp(box.hi[2]), 0};
        return ref;
    }

    // Returns the box of the same triangles along other axes.
    FloatBox boxAlong(const TriangleBvh::Frame& frame, const Ref& ref) const
    {
        // Turning a point within [-1, 1] adds an error of less than 2e-15, in a query and here.
        const Vec3d rounding(4e-15);
        FloatBox sum;
        for (std::uint32_t i = 0; i < ref.count; ++i) {
            const Corners t = cornersInUnits(ref.triangle + i);
            const Box box = Box::of({frame.of(t[0]), frame.of(t[1]), frame.of(t[2])});
            const Ref rounded = boxed({box.lo - rounding, box.hi + rounding});
            sum.expand(rounded.lo, rounded.hi);
        }
        return sum;
    }

    // Returns axes along the longest edge of the ref's first triangle, and along its plane.
    TriangleBvh::Frame frameOf(const Ref& ref) const
    {
        const Corners t = cornersInUnits(ref.triangle);
        std::array<Vec3d, 3> edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
        std::sort(edges.begin(), edges.end(),
                  [](const Vec3d& a, const Vec3d& b) { return a.lengthSqr() > b.lengthSqr(); });
        TriangleBvh::Frame frame;
        frame.axes[0] = edges[0].unit();
        const Vec3d across = frame.axes[0].cross(edges[1]);
        // A sliver without a plane may lie in any plane.
        const bool hasPlane = across.length() > leastSine * edges[0].length();
        frame.axes[2] = hasPlane ? across.unit() : anyAcross(frame.axes[0]);
        frame.axes[1] = frame.axes[2].cross(frame.axes[0]).unit();
        frame.axes[2] = frame.axes[0].cross(frame.axes[1]).unit();
        return frame;
    }

    static Vec3d anyAcross(const Vec3d& direction)
    {
        Vec3d axis(0.0);
        axis[openvdb::math::MinIndex(openvdb::math::Abs(direction))] = 1;
        return direction.cross(axis).unit();
    }

    static FloatBox boxOf(const Ref& ref)
    {
        FloatBox box;
        box.expand(ref.lo, ref.hi);
        return box;
    }

    // Places the items of the leaves in the present order of the refs.
    void placeItems()
    {
        std::vector<std::uint32_t> firstItem(refCount_);
        std::uint32_t items = 0;
        for (std::uint32_t leaf = 0; leaf < refCount_; ++leaf) {
            firstItem[leaf] = items;
            items += refs_[leaf].count;
        }
        throwIfInterrupted(interrupter_);
        tree_.items_.resize(items);
        parallelFor(tbb::blocked_range<std::uint32_t>(0, refCount_, blockSize), [&](const auto& range) {
            throwIfInterrupted(interrupter_);
            for (std::uint32_t leaf = range.begin(); leaf < range.end(); ++leaf) {
                for (std::uint32_t i = 0; i < refs_[leaf].count; ++i) {
                    const std::uint32_t triangle = refs_[leaf].triangle + i;
                    tree_.items_[firstItem[leaf] + i] = {triangles_[triangle], triangle};
                }
            }
        });
        parallelFor(tbb::blocked_range<std::uint32_t>(0, nodeCount_, blockSize), [&](const auto& range) {
            throwIfInterrupted(interrupter_);
            for (std::uint32_t node = range.begin(); node < range.end(); ++node) {
                for (std::uint32_t& child : tree_.nodes_[node].child) {
                    if (!(child & TriangleBvh::isLeaf)) continue;
                    const std::uint32_t leaf = child & ~TriangleBvh::isLeaf;
                    child = TriangleBvh::leafChild(firstItem[leaf], refs_[leaf].count);
                }
            }
        });
    }

    Corners cornersInUnits(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return {tree_.inUnits(tree_.points_[t[0]]), tree_.inUnits(tree_.points_[t[1]]),
                tree_.inUnits(tree_.points_[t[2]])};
    }

    Box itemBox(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return Box::of({tree_.points_[t[0]], tree_.points_[t[1]], tree_.points_[t[2]]});
    }

    struct Range {
        std::uint32_t begin, end;
        std::size_t depth;   // of binary splits
        std::uint32_t frame; // the axes of the boxes of its refs

        std::uint32_t size() const { return end - begin; }
    };

    // Builds a node. Returns its box along the axes of its range.
    FloatBox buildNode(std::uint32_t nodeIndex, Range whole)
    {
        const bool large = whole.size() > taskSize;
        std::array<Range, 4> ranges;
        std::size_t count = 0;
        FloatBox before; // the box before turning, if it is turned
        const bool isTurned = [&] {
            if (!hasNeedles_ || whole.size() < crowd || whole.depth >= binnedDepth) return false;
            const auto needles = crowdedNeedles(whole);
            if (!needles) return false;
            if (needles->end == whole.end) {
                before = boxOf(whole);
                turn(whole, needles->frame);
                return true;
            }
            // They are turned when they become a node.
            ranges[count++] = {whole.begin, needles->end, whole.depth + 1, whole.frame};
            return false;
        }();
        const std::size_t fixed = count;
        ranges[count++] = {fixed == 0 ? whole.begin : ranges[0].end, whole.end, whole.depth + fixed, whole.frame};
        while (count < 4) {
            Range* const largest = std::max_element(ranges.begin() + fixed, ranges.begin() + count,
                                                    [](const Range& a, const Range& b) { return a.size() < b.size(); });
            if (largest->size() == 1) break;
            const std::size_t depth = largest->depth + 1;
            const std::uint32_t middle = whole.size() <= 4 ? largest->begin + 1 : split(*largest);
            if (middle == largest->end) continue; // all others were copies: one is left
            ranges[count++] = {middle, largest->end, depth, whole.frame};
            *largest = {largest->begin, middle, depth, whole.frame};
        }
        std::array<FloatBox, 4> boxes;
        std::array<std::uint32_t, 4> child{};
        const auto buildChild = [&](std::size_t i) {
            const Range& range = ranges[i];
            if (range.size() == 1) {
                child[i] = range.begin | TriangleBvh::isLeaf;
                boxes[i] = boxOf(refs_[range.begin]);
                return;
            }
            child[i] = nodeCount_.fetch_add(1, std::memory_order_relaxed);
            boxes[i] = buildNode(child[i], range);
        };
        if (large) {
            parallelFor(std::size_t(0), count, buildChild);
        } else {
            for (std::size_t i = 0; i < count; ++i) buildChild(i);
        }
        TriangleBvh::Node& node = tree_.nodes_[nodeIndex];
        node.child = child;
        node.frame = whole.frame;
        FloatBox sum;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.lo[axis][i] = i < count ? boxes[i].lo[axis] : std::numeric_limits<float>::quiet_NaN();
                node.hi[axis][i] = i < count ? boxes[i].hi[axis] : std::numeric_limits<float>::quiet_NaN();
            }
            if (i < count) sum.expand(boxes[i].lo, boxes[i].hi);
        }
        return isTurned ? before : sum;
    }

    FloatBox boxOf(const Range& range) const
    {
        FloatBox sum;
        for (std::uint32_t i = range.begin; i < range.end; ++i) sum.expand(refs_[i].lo, refs_[i].hi);
        return sum;
    }

    static bool isNeedle(const Ref& ref) { return boxOf(ref).area() > needle * ref.leastArea; }

    struct Group {
        FloatBox around;
        double area = 0;
        std::uint32_t count = 0;

        void add(const Ref& ref)
        {
            around.expand(ref.lo, ref.hi);
            area += boxOf(ref).area();
            ++count;
        }
        bool isCrowded() const { return count >= crowd && area > crowd * around.area(); }
    };

    // The first refs of a range, up to `end`, for which other axes are better.
    struct Needles {
        std::uint32_t end;
        TriangleBvh::Frame frame;
    };

    // Moves needles side by side in the range to its beginning, if there are any.
    std::optional<Needles> crowdedNeedles(const Range& range)
    {
        constexpr std::uint32_t tries = 8; // directions
        Asker ask(interrupter_);
        Ref* const first = refs_.get() + range.begin;
        Ref* const last = refs_.get() + range.end;
        // A place is in as many boxes on average as the sum of their areas over that of the box around them.
        Group all;
        for (const Ref* ref = first; ref != last; ++ref) {
            ask();
            all.around.expand(ref->lo, ref->hi);
            if (isNeedle(*ref)) all.add(*ref);
        }
        if (!all.isCrowded()) return std::nullopt;
        const auto gains = [&](const Ref& ref, const TriangleBvh::Frame& frame) {
            return isNeedle(ref) && boxOf(ref).area() > needle * boxAlong(frame, ref).area();
        };
        TriangleBvh::Frame bestFrame;
        Group best;
        std::uint32_t needles = 0;
        for (const Ref* along = first; along != last; ++along) {
            if (!isNeedle(*along) || needles++ % (all.count / tries) != 0) continue;
            const TriangleBvh::Frame frame = frameOf(*along);
            Group group;
            for (const Ref* ref = first; ref != last; ++ref) {
                ask();
                if (gains(*ref, frame)) group.add(*ref);
            }
            if (!group.isCrowded() || !(group.area > best.area)) continue;
            best = group;
            bestFrame = frame;
        }
        if (best.count == 0) return std::nullopt;
        const Ref* const end = std::partition(first, last, [&](const Ref& ref) {
            ask();
            return gains(ref, bestFrame);
        });
        return Needles{range.begin + static_cast<std::uint32_t>(end - first),
                       rolled(alongLongest(bestFrame, first, end), first, end)};
    }

    // Returns the same axes, first the one along which most of the refs are long: it may be perpendicular to the one
    // from which they came.
    TriangleBvh::Frame alongLongest(const TriangleBvh::Frame& frame, const Ref* first, const Ref* last) const
    {
        Asker ask(interrupter_);
        std::array<double, 3> lengths{};
        for (const Ref* ref = first; ref != last; ++ref) {
            ask();
            const FloatBox box = boxAlong(frame, *ref);
            for (std::size_t i = 0; i < 3; ++i) lengths[i] += double{box.hi[i]} - double{box.lo[i]};
        }
        const auto longest = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
        TriangleBvh::Frame ordered = frame;
        std::rotate(ordered.axes.begin(), ordered.axes.begin() + longest, ordered.axes.end());
        return ordered;
    }

    // Returns the axes turned about the first, so that the box of the refs is small.
    TriangleBvh::Frame rolled(const TriangleBvh::Frame& frame, const Ref* first, const Ref* last) const
    {
        constexpr int tries = 8;
        constexpr double right = pi / 2;
        Asker ask(interrupter_);
        TriangleBvh::Frame best;
        float least = std::numeric_limits<float>::infinity();
        for (int i = 0; i < tries; ++i) {
            const double cosine = std::cos(i * right / tries), sine = std::sin(i * right / tries);
            const TriangleBvh::Frame turned{{frame.axes[0], cosine * frame.axes[1] + sine * frame.axes[2],
                                             cosine * frame.axes[2] - sine * frame.axes[1]}};
            FloatBox sum;
            for (const Ref* ref = first; ref != last; ++ref) {
                ask();
                const FloatBox box = boxAlong(turned, *ref);
                sum.expand(box.lo, box.hi);
            }
            if (!(sum.area() < least)) continue;
            least = sum.area();
            best = turned;
        }
        return best;
    }

    void turn(Range& range, const TriangleBvh::Frame& frame)
    {
        Asker ask(interrupter_);
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            ask();
            const FloatBox box = boxAlong(frame, refs_[i]);
            refs_[i].lo = box.lo;
            refs_[i].hi = box.hi;
        }
        const std::lock_guard lock(framesMutex_);
        range.frame = static_cast<std::uint32_t>(tree_.frames_.size());
        tree_.frames_.push_back(frame);
    }

    // Sorts the range of refs into two sides and returns the beginning of the second. Copies meet at last in a range
    // where all have the same centre. If copies are dropped, they are dropped there, which makes the range shorter.
    std::uint32_t split(Range& range)
    {
        if (range.size() > taskSize) throwIfInterrupted(interrupter_);
        Asker ask(interrupter_);
        Ref* const first = refs_.get() + range.begin;
        Ref* last = refs_.get() + range.end;
        const Binning binning(fold<FloatBox>(
            first, last, [](FloatBox& box, const Ref& ref) { box.expand(ref.twiceCentre(), ref.twiceCentre()); }));
        if (range.depth < binnedDepth && binning.scale > 0) {
            const std::size_t best = cheapestSplit(fold<Bins>(first, last, [&](Bins& bins, const Ref& ref) {
                const std::size_t bin = binning.bin(ref);
                bins.boxes[bin].expand(ref.lo, ref.hi);
                ++bins.counts[bin];
            }));
            if (best > 0) {
                const Ref* const middle = std::partition(first, last, [&](const Ref& ref) {
                    ask();
                    return binning.bin(ref) < best;
                });
                return range.begin + static_cast<std::uint32_t>(middle - first);
            }
        }
        if (copies_ == TriangleBvh::Copies::drop && !(binning.scale > 0)) {
            last = dropCopies(first, last);
            range.end = range.begin + static_cast<std::uint32_t>(last - first);
            if (range.size() == 1) return range.end;
        }
        const std::uint32_t middle = range.begin + range.size() / 2;
        std::nth_element(first, refs_.get() + middle, last, [&](const Ref& a, const Ref& b) {
            ask();
            return std::make_pair(a.twiceCentre()[binning.axis], a.triangle) <
                   std::make_pair(b.twiceCentre()[binning.axis], b.triangle);
        });
        return middle;
    }

    // Keeps the first of refs with the same triangles; returns the end of those left. O(n).
    Ref* dropCopies(Ref* first, Ref* last) const
    {
        const auto hash = [&](const Ref* ref) {
            std::size_t sum = 0;
            for (std::uint32_t i = 0; i < ref->count; ++i) sum = 31 * sum + hashOf(corners(ref->triangle + i));
            return sum;
        };
        const auto same = [&](const Ref* a, const Ref* b) {
            if (a->count != b->count) return false;
            for (std::uint32_t i = 0; i < a->count; ++i) {
                if (sorted(corners(a->triangle + i)) != sorted(corners(b->triangle + i))) return false;
            }
            return true;
        };
        std::unordered_set<const Ref*, decltype(hash), decltype(same)> kept(16, hash, same);
        Ref* end = first;
        Asker ask(interrupter_);
        for (Ref* ref = first; ref != last; ++ref) {
            ask();
            std::swap(*end, *ref);
            if (kept.insert(end).second) ++end;
        }
        for (Ref* ref = end; ref != last; ++ref) ref->count = 0; // a leaf of no items, in no node
        return end;
    }

    Corners corners(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return {tree_.points_[t[0]], tree_.points_[t[1]], tree_.points_[t[2]]};
    }

    static Corners sorted(Corners t)
    {
        std::sort(t.begin(), t.end(), [](const Vec3d& a, const Vec3d& b) { return a < b; });
        return t;
    }

    // Returns the same value for any order of the corners, and for zeros of either sign.
    static std::size_t hashOf(const Corners& t)
    {
        std::size_t sum = 0;
        for (const Vec3d& p : t) {
            std::size_t hash = 0;
            for (int axis = 0; axis < 3; ++axis) hash = (hash ^ std::hash<double>()(p[axis])) * 0x9e3779b97f4a7c15U;
            sum += hash ^ hash >> 29U;
        }
        return sum;
    }

    TriangleBvh& tree_;
    const std::vector<Vec3I>& triangles_;
    Interrupter* interrupter_;
    TriangleBvh::Copies copies_;
    std::unique_ptr<Ref[]> refs_;
    std::uint32_t refCount_ = 0;
    std::atomic<std::uint32_t> nodeCount_{0};
    bool hasNeedles_ = false;
    std::mutex framesMutex_;
};

TriangleBvh::TriangleBvh(std::vector<Vec3d> points, const std::vector<Vec3I>& triangles, Interrupter* interrupter,
                         Copies copies)
    : points_(std::move(points))
{
    if (triangles.size() > maxItems) {
        throw InputError(std::to_string(triangles.size()) + " triangles are too many; at most " +
                         std::to_string(maxItems) + " are allowed");
    }
    if (!triangles.empty()) TreeBuilder(*this, triangles, interrupter, copies).build();
}

TriangleBvh::Closest TriangleBvh::closest(const Vec3d& p, std::uint32_t seed, double slack) const
{
    Closest best;
    if (empty()) return best;
    const auto tryItem = [&](std::uint32_t item) {
        const Vec3d point = closestPointOnTriangle(p, corners(items_[item]));
        const double squaredDistance = (point - p).lengthSqr();
        if (!(squaredDistance < best.squaredDistance)) return false;
        best = {point, squaredDistance, item};
        return true;
    };
    if (seed != none) tryItem(seed);

    // In the tree's units, in float: nodes within `maxSquaredDistance`, which is rounded up, may be nearer. Points far
    // away are moved nearer.
    const Vec3d place = openvdb::math::minComponent(Vec3d(1e15), openvdb::math::maxComponent(Vec3d(-1e15), inUnits(p)));
    std::array<float, 3> lo, hi;
    const auto round = [&](const Vec3d& inFrame) {
        for (std::size_t i = 0; i < 3; ++i) {
            lo[i] = roundedDown(inFrame[static_cast<int>(i)]);
            hi[i] = roundedUp(inFrame[static_cast<int>(i)]);
        }
    };
    round(place);
    std::uint32_t frame = 0; // of these
    const auto limitOf = [&](double squaredDistance) {
        const double distance = std::sqrt(squaredDistance) * scale_ / (1 + slack);
        return static_cast<float>(std::min(1.00001 * distance * distance + 1e-30, 1e38));
    };
    float maxSquaredDistance = limitOf(best.squaredDistance);
    Stack<Near> stack;
    stack.push({0, 0});
    while (!stack.empty()) {
        const Near nearest = stack.pop();
        if (nearest.squaredDistance() > maxSquaredDistance) continue;
        const std::uint32_t child = nearest.child();
        if (child & isLeaf) {
            const Leaf leaf = leafOf(child);
            for (std::uint32_t item = leaf.first; item <= leaf.last; ++item) {
                if (item != seed && tryItem(item)) maxSquaredDistance = limitOf(best.squaredDistance);
            }
            continue;
        }
        const Node& node = nodes_[child];
        if (node.frame != frame) {
            frame = node.frame;
            round(frames_[frame].of(place));
        }
        Floats squaredDistance{};
        for (std::size_t i = 0; i < 3; ++i) {
            const Floats below = node.lo[i] - hi[i], above = lo[i] - node.hi[i];
            Floats away = below > above ? below : above;
            away = away < 0 ? Floats{} : away; // keeps NaN
            squaredDistance += away * away;
        }
        const unsigned met = bits(squaredDistance <= maxSquaredDistance);
        // The nearest must be popped first.
        std::array<Near, 4> near;
        std::size_t count = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(met >> i & 1U)) continue;
            prefetch(node.child[i]);
            std::size_t at = count++;
            for (; at > 0 && near[at - 1].squaredDistance() < squaredDistance[i]; --at) near[at] = near[at - 1];
            near[at] = {node.child[i], squaredDistance[i]};
        }
        for (std::size_t i = 0; i < count; ++i) stack.push(near[i]);
    }
    return best;
}

} // namespace vdbcage::detail
