#pragma once

#include <cstdint>
#include <optional>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_leaves.h>
#include <vdbcage/geometry/bvh_space.h>

namespace vdbcage::detail {

/// Finds long thin triangles that lie side by side at an angle to x, y and z, and axes along them.
class NeedleFinder {
public:
    /// At least this many boxes of needles side by side must meet in a place, or other axes gain too little.
    static constexpr std::uint32_t crowd = 32;

    /// The first refs of a range, up to `end`, for which other axes are better.
    struct Needles {
        std::uint32_t end;
        BvhFrame frame;
    };

    /// Refers to triangles and leaves, which must outlive it.
    NeedleFinder(const BvhTriangles& triangles, Leaves& leaves, Interrupter* interrupter)
        : triangles_(triangles), leaves_(leaves), interrupter_(interrupter)
    {
    }

    /// Moves needles side by side in the range to its beginning, if there are any.
    /// \throw Cancelled
    std::optional<Needles> gather(const LeafRange& range) const;

private:
    FloatBox boxAlong(const BvhFrame& frame, const LeafRef& ref) const
    {
        return triangles_.boxAlong(frame, ref.triangle, ref.count);
    }
    /// Returns the same axes, first the one along which most of the refs are long: it may be perpendicular to the one
    /// from which they came.
    BvhFrame alongLongest(const BvhFrame& frame, const LeafRef* first, const LeafRef* last) const;
    /// Returns the axes turned about the first, so that the box of the refs is small.
    BvhFrame rolled(const BvhFrame& frame, const LeafRef* first, const LeafRef* last) const;

    const BvhTriangles& triangles_;
    Leaves& leaves_;
    Interrupter* interrupter_;
};

} // namespace vdbcage::detail
