#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_leaves.h>
#include <vdbcage/geometry/bvh_needles.h>
#include <vdbcage/geometry/bvh_split.h>
#include <vdbcage/geometry/bvh_triangles.h>
#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::detail {

/// Builds a tree from the root down. Each node's range of leaves is split in two until there are four ranges.
class BvhBuilder {
public:
    /// Refers to tree and triangles, which must outlive it.
    /// \pre the tree has points and nothing else; there are triangles
    /// \throw Cancelled
    BvhBuilder(TriangleBvh& tree, const std::vector<Vec3I>& triangles, TriangleBvh::Copies copies,
               Interrupter* interrupter);

    /// \throw Cancelled
    void build();

private:
    /// The ranges of a node's children.
    struct Parts {
        std::array<LeafRange, 4> ranges{};
        std::size_t count = 0;
    };

    /// Builds a node. Returns its box along the axes of its range.
    FloatBox buildNode(std::uint32_t nodeIndex, LeafRange whole);
    /// Divides a range. The first refs, up to `fixedEnd`, become a part if there are any.
    Parts divide(const LeafRange& whole, std::uint32_t fixedEnd) const;
    /// Sets the boxes of a node's children. Returns the box around them.
    static FloatBox setBoxes(TriangleBvh::Node& node, const std::array<FloatBox, 4>& boxes, std::size_t count);
    /// Turns the boxes of a range to other axes, which become the tree's.
    void turn(LeafRange& range, const BvhFrame& frame);
    FloatBox boxOf(const LeafRange& range) const;
    /// Places the items of the leaves in the present order of the refs.
    void placeItems();

    TriangleBvh& tree_;
    Interrupter* interrupter_;
    BvhTriangles triangles_;
    Leaves leaves_;
    NeedleFinder needles_;
    LeafSplitter splitter_;
    std::atomic<std::uint32_t> nodeCount_{0};
    std::mutex framesMutex_;
};

} // namespace vdbcage::detail
