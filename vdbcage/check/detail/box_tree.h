#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

/// Triangles in the order of a space-filling curve, under a complete binary tree of their boxes, in double.
///
/// Where most triangles are long and thin, and side by side at an angle to the axes, each node has a second box, along
/// the triangles.
///
/// The check uses it to find candidates that may meet. The guard uses TriangleBvh instead, so that a triangle missed by
/// one of them cannot deceive both.
///
/// Based on: Morton 1966, "A Computer Oriented Geodetic Data Base".
class BoxTree {
public:
    struct Item {
        Vec3I corners;          ///< indices of points
        std::uint32_t triangle; ///< its number in the list that the tree was built from
    };
    /// The treatment of triangles with the same three points in space as another, in any order.
    enum class Copies { keep, drop };

    BoxTree() = default;
    /// Points must be finite where triangles use them.
    /// \throw Cancelled
    /// Cost: O(n log n), in parallel.
    BoxTree(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
            Interrupter* interrupter);

    /// Returns the number of items left.
    std::size_t size() const { return items_.size(); }

    /// Calls visit(item) for each triangle whose box meets `box`, and for some others near it, until it returns false.
    /// Returns false if it stopped. The sides of `box` may be infinite.
    template <typename Visit>
    bool inBox(const Box& box, const Visit& visit) const;

    /// Does the same for each triangle that comes within `maxDistance` of `triangle`, which may be degenerate.
    template <typename Visit>
    bool near(const Corners& triangle, double maxDistance, const Visit& visit) const;

private:
    static constexpr std::size_t leafSize = 4;

    /// The space between two planes across `normal`.
    struct Slab {
        Vec3d normal{0.0};
        double low = 0, high = 0;

        /// Returns whether the box certainly lies outside. A result that cannot be computed (NaN) counts as inside.
        bool isBeside(const Box& box) const;
    };

    void sort(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
              Interrupter* interrupter);
    using Axes = std::array<Vec3d, 3>;
    using Levels = std::vector<std::vector<Box>>;
    /// Returns axes along the triangle that fills least of its box along x, y and z, if boxes along these axes are much
    /// smaller for all triangles together.
    std::optional<Axes> axesOfNeedles(const std::vector<Vec3d>& points, Interrupter* interrupter) const;
    /// Builds the tree of the boxes that boxOf(i) returns for each item.
    template <typename BoxOf>
    Levels boxes(const BoxOf& boxOf, Interrupter* interrupter) const;
    Slab slabOf(const Corners& triangle, double maxDistance) const;
    /// Returns the largest absolute coordinate.
    static double farthestOf(const Box& box);
    /// Returns the box of a triangle along `axes`, rounded outward: two triangles that meet have boxes that meet, and
    /// the boxes of two triangles are no farther apart along any axis than the triangles.
    static Box boxAlong(const Axes& axes, const Corners& triangle);

    /// Calls visit(item) for the items of each leaf for which wanted(level, index) is true, as well as for all nodes
    /// above it.
    template <typename Wanted, typename Visit>
    bool traverse(const Wanted& wanted, const Visit& visit) const;

    std::vector<Item> items_;
    /// Boxes of leafSize consecutive items, then of two consecutive boxes of the level before each, and so on up to the
    /// box of all.
    Levels levels_;
    Levels alongNeedles_; ///< the same along needles_; empty if there are no such axes
    Axes needles_;
    double farthest_ = 0; ///< the largest absolute coordinate
};

template <typename Wanted, typename Visit>
bool BoxTree::traverse(const Wanted& wanted, const Visit& visit) const
{
    if (items_.empty()) return true;
    struct Place {
        std::size_t level, index;
    };
    std::array<Place, 64> stack; // at most the number of levels and one
    std::size_t size = 0;
    stack[size++] = {levels_.size() - 1, 0};
    while (size > 0) {
        const Place place = stack[--size];
        if (!wanted(place.level, place.index)) continue;
        if (place.level > 0) {
            const std::size_t first = 2 * place.index, count = levels_[place.level - 1].size();
            if (first + 1 < count) stack[size++] = {place.level - 1, first + 1};
            stack[size++] = {place.level - 1, first};
            continue;
        }
        const std::size_t first = place.index * leafSize, last = std::min(first + leafSize, items_.size());
        for (std::size_t i = first; i < last; ++i) {
            if (!visit(items_[i])) return false;
        }
    }
    return true;
}

template <typename Visit>
bool BoxTree::inBox(const Box& box, const Visit& visit) const
{
    return traverse([&](std::size_t level, std::size_t index) { return box.meets(levels_[level][index]); }, visit);
}

template <typename Visit>
bool BoxTree::near(const Corners& triangle, double maxDistance, const Visit& visit) const
{
    const Vec3d margin(1.001 * maxDistance); // enough under any rounding
    const auto around = [&](Box box) { return Box{box.lo - margin, box.hi + margin}; };
    const Box box = around(Box::of(triangle));
    const Slab slab = slabOf(triangle, maxDistance);
    const auto wanted = [&](std::size_t level, std::size_t index) {
        const Box& node = levels_[level][index];
        return box.meets(node) && !slab.isBeside(node);
    };
    // Turned coordinates that may overflow tell nothing.
    if (alongNeedles_.empty() || !(farthestOf(box) < 1e300)) return traverse(wanted, visit);
    const Box turned = around(boxAlong(needles_, triangle));
    return traverse(
        [&](std::size_t level, std::size_t index) {
            return turned.meets(alongNeedles_[level][index]) && wanted(level, index);
        },
        visit);
}

inline double BoxTree::farthestOf(const Box& box)
{
    double farthest = 0;
    for (int i = 0; i < 3; ++i) farthest = std::max({farthest, std::abs(box.lo[i]), std::abs(box.hi[i])});
    return farthest;
}

inline bool BoxTree::Slab::isBeside(const Box& box) const
{
    double bottom = 0, top = 0; // of the box along the normal
    for (int i = 0; i < 3; ++i) {
        bottom += normal[i] * (normal[i] > 0 ? box.lo[i] : box.hi[i]);
        top += normal[i] * (normal[i] > 0 ? box.hi[i] : box.lo[i]);
    }
    return bottom > high || top < low;
}

} // namespace vdbcage::detail
