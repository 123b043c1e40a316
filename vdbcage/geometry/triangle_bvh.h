#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_space.h>
#include <vdbcage/geometry/floats.h>
#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

/// A bounding volume hierarchy over triangles, which are indices into points and may be degenerate.
///
/// It is immutable once built, so any number of threads may query it at the same time. The tree, and with it the order
/// of results, is the same for any number of threads that built it.
///
/// Nodes have up to four children, whose boxes are compared at once, in float. The boxes are rounded outward, so that
/// no triangle is missed; the remaining candidates are tested in double. Leaves hold one triangle; in large trees, up
/// to four that follow each other in the list and have about the same box.
///
/// Boxes are along x, y and z, except where long thin triangles lie side by side at an angle to these: below such a
/// node they are along the triangles. Otherwise each box would contain all the others.
class TriangleBvh {
public:
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    struct Item {
        Vec3I corners;          ///< indices into points()
        std::uint32_t triangle; ///< its number in the list that the tree was built from
    };
    /// The treatment of triangles with the same three points in space as another, in any order. A query that meets one
    /// of a million copies meets all of them. `drop` removes the copies that make queries slow; where there are few,
    /// some may stay.
    enum class Copies { keep, drop };
    struct Closest {
        Vec3d point;
        double squaredDistance = std::numeric_limits<double>::infinity();
        std::uint32_t item = none; ///< none if the tree is empty
    };
    class Query;

    TriangleBvh() = default;
    /// Points must be finite where triangles use them.
    /// \throw InputError more than 2^29 triangles
    /// \throw Cancelled
    /// Cost: O(n log n), in parallel; less time and memory where triangles of a face follow each other.
    TriangleBvh(std::vector<Vec3d> points, const std::vector<Vec3I>& triangles, Interrupter* interrupter = nullptr,
                Copies copies = Copies::keep);

    bool empty() const { return items_.empty(); }
    const std::vector<Vec3d>& points() const { return points_; }
    /// Returns the triangles in the tree's order: neighbours in space are mostly neighbours here.
    const std::vector<Item>& items() const { return items_; }
    Corners corners(const Item& item) const
    {
        return {points_[item.corners[0]], points_[item.corners[1]], points_[item.corners[2]]};
    }
    /// Returns the box of everything.
    /// \pre the tree is not empty
    const Box& box() const { return box_; }

    /// Selects items in a box, whose sides may be infinite.
    Query inBox(const Box& box) const;
    /// Selects items within `maxDistance` of a triangle, which may be degenerate.
    Query near(const Corners& triangle, double maxDistance = 0) const;
    /// Selects items that meet a tetrahedron, which may be flat.
    Query inTetrahedron(const std::array<Vec3d, 4>& corners) const;

    /// Calls visit(item) for each triangle that meets `query`, and for some others near it, always in the same order,
    /// until it returns false. Returns false if it stopped. `visit` may make `query` narrower; the traversal then skips
    /// items outside the new query.
    template <typename Visit>
    bool traverse(const Query& query, const Visit& visit) const;

    /// Calls visit(item) for each triangle that meets `box`, and for some others whose boxes do, until it returns
    /// false.
    template <typename Visit>
    bool forEachOverlap(const Box& box, const Visit& visit) const;

    /// Returns the point of the triangles closest to `p`. `seed` is an item number, such as that of the last result for
    /// a point nearby: it saves time, and may decide between equals. With `slack` the point may be up to 1 + slack
    /// times as far, which saves time too.
    Closest closest(const Vec3d& p, std::uint32_t seed = none, double slack = 0) const;

private:
    friend class BvhBuilder;
    struct alignas(64) Node : FourBoxes {   // two cache lines
        std::array<std::uint32_t, 4> child; // a node, or a leaf
        std::uint32_t frame;                // the axes of the boxes: of frames_
    };
    static constexpr std::uint32_t isLeaf = std::uint32_t(1) << 31;
    static constexpr std::uint32_t maxItems = std::uint32_t(1) << 29;

    // One to four items that follow each other, from the first to the last.
    struct Leaf {
        std::uint32_t first, last;
    };
    static std::uint32_t leafChild(std::uint32_t first, std::uint32_t count)
    {
        return isLeaf | (count - 1) << 29 | first;
    }
    static Leaf leafOf(std::uint32_t child)
    {
        const std::uint32_t first = child & (maxItems - 1);
        return {first, first + (child >> 29 & 3U)};
    }
    // The builder switches to halving at a depth that keeps every path shorter than this.
    static constexpr std::size_t maxDepth = 96;
    template <typename T>
    class Stack;

    /// Prefetches a child that will be visited soon: most nodes of a large tree are in no cache.
    void prefetch(std::uint32_t child) const
    {
        if (child & isLeaf) {
            __builtin_prefetch(&items_[leafOf(child).first]);
        } else {
            const Node& node = nodes_[child];
            __builtin_prefetch(&node.lo);
            __builtin_prefetch(&node.child); // its other cache line
        }
    }

    std::vector<Vec3d> points_;
    std::vector<Item> items_;
    std::unique_ptr<Node[]> nodes_; // the root first
    std::vector<BvhFrame> frames_;  // the first is the tree's own
    Box box_;
    BvhUnits units_;
};

/// The region of a query: a box, cut by slabs, in the units of the tree that made it. If it came from up to four points
/// with a margin, its box along other axes is computed from these. Other slabs are along needles and edges between
/// points.
class TriangleBvh::Query {
public:
    /// Returns which of the node's children it meets, a bit each. No child that it meets is left out.
    unsigned meets(const Node& node) const
    {
        Lanes met = node.meet(lo_, hi_);
        const std::array<Floats, 3> sum{node.lo[0] + node.hi[0], node.lo[1] + node.hi[1], node.lo[2] + node.hi[2]};
        const std::array<Floats, 3> size{node.hi[0] - node.lo[0], node.hi[1] - node.lo[1], node.hi[2] - node.lo[2]};
        for (std::size_t i = 0; i < slabs_; ++i) {
            const Slab& s = slab_[i];
            if (bits(met) == 0) return 0;
            const Floats middle = s.normal[0] * sum[0] + s.normal[1] * sum[1] + s.normal[2] * sum[2];
            const Floats radius = s.absolute[0] * size[0] + s.absolute[1] * size[1] + s.absolute[2] * size[2];
            // A result that cannot be computed (NaN) counts as met.
            met &= ~((middle - radius > s.twiceHigh) | (middle + radius < s.twiceLow));
        }
        return bits(met);
    }
    /// Returns the same query for nodes whose boxes are along other axes; it may be a little wider.
    Query along(const BvhFrame& frame) const;
    /// Returns whether both certainly came from the same points, perhaps along other axes.
    bool isFromSamePoints(const Query& other) const
    {
        return count_ > 0 && count_ == other.count_ && margin_ == other.margin_ &&
               std::equal(points_.begin(), points_.begin() + count_, other.points_.begin());
    }

private:
    friend class TriangleBvh;
    Query() = default; // not initialized
    struct Slab {
        std::array<Floats, 3> normal, absolute; // absolute: each component's size
        Floats twiceLow, twiceHigh;
    };
    explicit Query(const Box& box);
    void addSlab(const Vec3d& normal, double low, double high, double farthest);
    void addPoint(const Vec3d& p) { points_[count_++] = p; }
    Query aroundPoints(const BvhFrame& frame) const;

    std::array<Floats, 3> lo_, hi_;
    std::array<Slab, 10> slab_; // not initialized
    std::size_t slabs_ = 0;
    std::array<Vec3d, 4> points_; // not initialized
    std::size_t count_ = 0;
    double margin_ = 0;
};

template <typename T>
class TriangleBvh::Stack {
public:
    void push(const T& entry)
    {
        assert(size_ < entries_.size());
        entries_[size_++] = entry;
    }
    T pop() { return entries_[--size_]; }
    bool empty() const { return size_ == 0; }

private:
    std::size_t size_ = 0;
    std::array<T, 3 * maxDepth + 1> entries_; // not initialized
};

template <typename Visit>
bool TriangleBvh::traverse(const Query& query, const Visit& visit) const
{
    if (empty()) return true;
    Query turned; // along the axes of the last node that has its own
    std::uint32_t frame = 0;
    Stack<std::uint32_t> stack;
    stack.push(0);
    while (!stack.empty()) {
        const Node& node = nodes_[stack.pop()];
        if (node.frame != 0 && (node.frame != frame || !turned.isFromSamePoints(query))) {
            frame = node.frame;
            turned = query.along(frames_[frame]);
        }
        const unsigned met = (node.frame == 0 ? query : turned).meets(node);
        for (std::size_t i = 0; i < 4; ++i) {
            if (!(met >> i & 1U)) continue;
            const std::uint32_t child = node.child[i];
            if (!(child & isLeaf)) {
                prefetch(child);
                stack.push(child);
                continue;
            }
            const Leaf leaf = leafOf(child);
            for (std::uint32_t item = leaf.first; item <= leaf.last; ++item) {
                if (!visit(items_[item])) return false;
            }
        }
    }
    return true;
}

template <typename Visit>
bool TriangleBvh::forEachOverlap(const Box& box, const Visit& visit) const
{
    return traverse(inBox(box), [&](const Item& item) { return !box.meets(Box::of(corners(item))) || visit(item); });
}

} // namespace vdbcage::detail
