#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// Triangles in the order of a space-filling curve, under a complete binary tree of their boxes, in double.
///
/// Where most of them are long and thin, and side by side at an angle to the axes, each node has a second box, along
/// them.
///
/// It is how the check finds what may meet. The guard has TriangleBvh for that: two ways, so that a triangle which one
/// of them misses does not deceive both.
///
/// Based on: Morton 1966, "A Computer Oriented Geodetic Data Base".
class BoxTree {
public:
    struct Item {
        Vec3I corners;          ///< indices of points
        std::uint32_t triangle; ///< its number in the list that the tree was built from
    };
    /// Whether triangles with the same three points in space as another, in any order, are to be items.
    enum class Copies { keep, drop };

    BoxTree() = default;
    /// Points must be finite where triangles use them.
    /// \throw Cancelled
    /// Cost: O(n log n), in parallel.
    BoxTree(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
            Interrupter* interrupter);

    /// Those left.
    std::size_t size() const { return items_.size(); }

    /// Calls `visit(item)` for each triangle whose box meets `box`, whose sides may be infinite, and for some more
    /// beside it, until it answers false. Returns false if it stopped.
    template <typename Visit>
    bool inBox(const Box& box, const Visit& visit) const;

    /// The same for each triangle that comes within `maxDistance` of `triangle`, which may be degenerate.
    template <typename Visit>
    bool near(const Corners& triangle, double maxDistance, const Visit& visit) const;

private:
    static constexpr std::size_t leafSize = 4;

    /// Selects items between two planes across `normal`.
    struct Slab {
        Vec3d normal{0.0};
        double low = 0, high = 0;

        /// Whether the box lies beside it for certain. What cannot be computed (NaN) does not.
        bool isBeside(const Box& box) const;
    };

    void sort(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Copies copies,
              Interrupter* interrupter);
    using Axes = std::array<Vec3d, 3>;
    using Levels = std::vector<std::vector<Box>>;
    /// Along the triangle that loses most in boxes along x, y and z, if all lose much by these.
    std::optional<Axes> axesOfNeedles(const std::vector<Vec3d>& points, Interrupter* interrupter) const;
    /// Builds the tree of what `boxOf` gives for each item.
    template <typename BoxOf>
    Levels boxes(const BoxOf& boxOf, Interrupter* interrupter) const;
    Slab slabOf(const Corners& triangle, double maxDistance) const;
    /// The largest absolute coordinate.
    static double farthestOf(const Box& box);
    /// Rounded outward: two triangles that meet have boxes that meet, and those of two nearer than some distance are no
    /// farther apart along any axis.
    static Box boxAlong(const Axes& axes, const Corners& triangle);

    /// Calls visit(item) for those in leaves that are `wanted(level, index)`, as all above them are.
    template <typename Wanted, typename Visit>
    bool traverse(const Wanted& wanted, const Visit& visit) const;

    std::vector<Item> items_;
    /// Boxes of leafSize items that follow each other; then of two boxes each that follow each other there; and so on
    /// up to the box of all.
    Levels levels_;
    Levels alongNeedles_; ///< the same along needles_, if there are
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
    std::array<Place, 64> stack; // one more a level, and one
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
    const Vec3d margin(1.001 * maxDistance); // however it is rounded
    const auto around = [&](Box box) { return Box{box.lo - margin, box.hi + margin}; };
    const Box box = around(Box::of(triangle));
    const Slab slab = slabOf(triangle, maxDistance);
    const auto wanted = [&](std::size_t level, std::size_t index) {
        const Box& node = levels_[level][index];
        return box.meets(node) && !slab.isBeside(node);
    };
    // Where what is turned may overflow it tells nothing.
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
