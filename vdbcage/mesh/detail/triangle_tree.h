#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

using openvdb::Vec3d;
using openvdb::Vec3I;

/// The three corners of a triangle.
using Corners = std::array<Vec3d, 3>;

/// A closed box: a point on its side belongs to it. Not initialized by default.
struct Box {
    Vec3d lo, hi;

    static Box of(const Vec3d& p) { return {p, p}; }
    static Box of(const Corners& t);
    void expand(const Box& other);
    bool meets(const Box& other) const
    {
        return lo[0] <= other.hi[0] && other.lo[0] <= hi[0] && lo[1] <= other.hi[1] && other.lo[1] <= hi[1] &&
               lo[2] <= other.hi[2] && other.lo[2] <= hi[2];
    }
    /// Squared distance from p, 0 inside; rounded.
    double squaredDistance(const Vec3d& p) const
    {
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const double d = std::max(std::max(lo[i] - p[i], p[i] - hi[i]), 0.0);
            sum += d * d;
        }
        return sum;
    }
};

/// The point of the closed triangle nearest to `p`; the triangle may be degenerate. Rounded.
Vec3d closestPointOnTriangle(const Vec3d& p, const Corners& triangle);

/// Answers, never wrongly with no, whether a box may meet a triangle: their boxes meet and the triangle's plane cuts
/// the box, up to a bound of the rounding errors.
class TriangleFilter {
public:
    explicit TriangleFilter(const Corners& triangle);
    bool operator()(const Box& box) const { return box_.meets(box) && planeMayMeet(box); }

private:
    bool planeMayMeet(const Box& box) const;

    Box box_;
    Vec3d corner_, normal_, errorScale_;
    bool usePlane_;
};

/// The same for a segment between two points (may be one point): the boxes meet, and no axis across the segment and an
/// edge of the box separates them.
class SegmentFilter {
public:
    SegmentFilter(const Vec3d& a, const Vec3d& b);
    bool operator()(const Box& box) const { return box_.meets(box) && lineMayMeet(box); }

private:
    bool lineMayMeet(const Box& box) const;

    Box box_;
    Vec3d start_, direction_;
    bool useLine_;
};

/// A bounding volume hierarchy over triangles (indices into points; degenerate ones welcome). Immutable once built: any
/// number of threads may ask at the same time. The tree, and so the order of its answers, is the same for any number of
/// threads that built it.
class TriangleTree {
public:
    static constexpr std::uint32_t none = ~std::uint32_t(0);

    struct Item {
        Vec3I corners;          ///< indices into points()
        std::uint32_t triangle; ///< its number in the list that the tree was built from
    };
    struct Closest {
        Vec3d point;
        double squaredDistance = std::numeric_limits<double>::infinity();
        std::uint32_t item = none; ///< none: nothing nearer than the bound
    };

    TriangleTree() = default;
    /// Points must be finite where triangles use them. O(n log n), in parallel. \throw Cancelled
    TriangleTree(std::vector<Vec3d> points, const std::vector<Vec3I>& triangles, Interrupter* interrupter = nullptr);

    bool empty() const { return items_.empty(); }
    const std::vector<Vec3d>& points() const { return points_; }
    /// The triangles in the tree's order: neighbours in space are mostly neighbours here.
    const std::vector<Item>& items() const { return items_; }
    Corners corners(const Item& item) const
    {
        return {points_[item.corners[0]], points_[item.corners[1]], points_[item.corners[2]]};
    }
    /// The box of everything; the tree must not be empty.
    const Box& box() const { return nodes_[0].box; }

    /// Calls `visit(item)` for each triangle in the leaves that are reached through boxes for which `mayMeet(box)` is
    /// true. `visit` answers whether to go on; returns false if it stopped.
    template <typename MayMeet, typename Visit>
    bool traverse(const MayMeet& mayMeet, const Visit& visit) const;

    /// Calls `visit(item)` for each triangle whose box meets `box`, until it answers false.
    template <typename Visit>
    bool forEachOverlap(const Box& box, const Visit& visit) const;

    /// Calls `visit(item, otherItem)` for each pair whose boxes meet, until it answers false.
    template <typename Visit>
    bool forEachOverlap(const TriangleTree& other, const Visit& visit) const;

    /// The closest point of the triangles to `p`, if its squared distance is below `bound`. `seed`, an item number such
    /// as that of the last answer for a point nearby, makes it faster (and may decide between equals).
    Closest closest(const Vec3d& p, std::uint32_t seed = none,
                    double bound = std::numeric_limits<double>::infinity()) const;

private:
    friend class TreeBuilder;
    struct Node {
        Box box;
        std::uint32_t first; // a leaf's first item, else the first of two children
        std::uint32_t count; // of items; 0: not a leaf
    };
    // The builder switches to halving at a depth that keeps every path shorter than this.
    static constexpr std::size_t maxDepth = 96;
    template <typename T>
    class Stack;

    std::vector<Vec3d> points_;
    std::vector<Item> items_;
    std::unique_ptr<Node[]> nodes_; // the root first
};

template <typename T>
class TriangleTree::Stack {
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
    std::array<T, 3 * maxDepth> entries_; // not initialized
};

template <typename MayMeet, typename Visit>
bool TriangleTree::traverse(const MayMeet& mayMeet, const Visit& visit) const
{
    if (empty()) return true;
    Stack<std::uint32_t> stack;
    stack.push(0);
    while (!stack.empty()) {
        const Node& node = nodes_[stack.pop()];
        if (!mayMeet(node.box)) continue;
        if (node.count == 0) {
            stack.push(node.first + 1);
            stack.push(node.first);
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (!visit(items_[i])) return false;
        }
    }
    return true;
}

template <typename Visit>
bool TriangleTree::forEachOverlap(const Box& box, const Visit& visit) const
{
    return traverse([&](const Box& nodeBox) { return box.meets(nodeBox); },
                    [&](const Item& item) { return !box.meets(Box::of(corners(item))) || visit(item); });
}

template <typename Visit>
bool TriangleTree::forEachOverlap(const TriangleTree& other, const Visit& visit) const
{
    if (empty() || other.empty()) return true;
    Stack<std::array<std::uint32_t, 2>> stack;
    stack.push({0, 0});
    while (!stack.empty()) {
        const auto [here, there] = stack.pop();
        const Node& node = nodes_[here];
        const Node& otherNode = other.nodes_[there];
        if (!node.box.meets(otherNode.box)) continue;
        if (node.count > 0 && otherNode.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const Box box = Box::of(corners(items_[i]));
                for (std::uint32_t k = otherNode.first; k < otherNode.first + otherNode.count; ++k) {
                    if (!box.meets(Box::of(other.corners(other.items_[k])))) continue;
                    if (!visit(items_[i], other.items_[k])) return false;
                }
            }
        } else if (otherNode.count > 0 || (node.count == 0 && (node.box.hi - node.box.lo).length() >=
                                                                  (otherNode.box.hi - otherNode.box.lo).length())) {
            stack.push({node.first + 1, there});
            stack.push({node.first, there});
        } else {
            stack.push({here, otherNode.first + 1});
            stack.push({here, otherNode.first});
        }
    }
    return true;
}

} // namespace vdbcage::detail
