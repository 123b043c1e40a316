#pragma once

#include <cstdint>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_leaves.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// Splits ranges of leaves in two, where queries then cost least.
class LeafSplitter {
public:
    /// Refers to triangles and leaves, which must outlive it.
    LeafSplitter(const BvhTriangles& triangles, Leaves& leaves, TriangleBvh::Copies copies, Interrupter* interrupter)
        : triangles_(triangles), leaves_(leaves), copies_(copies), interrupter_(interrupter)
    {
    }

    /// Sorts the range of refs into two sides and returns the beginning of the second. Copies meet at last in a range
    /// where all have the same centre. If copies are dropped, they are dropped there, which makes the range shorter.
    /// \throw Cancelled
    std::uint32_t split(LeafRange& range) const;

private:
    const BvhTriangles& triangles_;
    Leaves& leaves_;
    TriangleBvh::Copies copies_;
    Interrupter* interrupter_;
};

} // namespace vdbcage::detail
