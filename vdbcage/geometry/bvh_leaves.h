#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_triangles.h>
#include <vdbcage/geometry/floats.h>

/// The leaves of a TriangleBvh while it is built.
namespace vdbcage::detail {

/// A leaf's box, in the tree's units. The fourth components of lo and hi mean nothing. Not initialized by default.
struct LeafRef {
    Floats lo, hi;
    std::uint32_t triangle; ///< the first of its triangles
    std::uint32_t count;
    float leastArea; ///< of a box along its triangles, about

    Floats twiceCentre() const { return lo + hi; }
    FloatBox box() const
    {
        FloatBox own;
        own.expand(lo, hi);
        return own;
    }

    /// A needle has at least this many times as large an area in a box along x, y and z as in one along itself.
    static constexpr float needle = 4;
    bool isNeedle() const { return box().area() > needle * leastArea; }
};

/// Refs that follow each other and become a subtree.
struct LeafRange {
    std::uint32_t begin, end;
    std::size_t depth;   ///< of binary splits
    std::uint32_t frame; ///< the axes of the boxes of its refs

    std::uint32_t size() const { return end - begin; }
    /// Returns whether it is worth a task.
    bool isLarge() const { return size() > 4096; }
    /// Returns whether it must be halved from here on: 2^32 leaves end within 32 more levels.
    bool isDeep() const { return depth >= 60; }
};

/// The leaves of a tree. Building it changes their order, and their boxes where it turns axes.
struct Leaves {
    std::unique_ptr<LeafRef[]> refs;
    std::uint32_t count = 0;
    std::size_t needles = 0; ///< how many of them are needles
};

/// Makes the leaves. In large trees, triangles that follow each other in about the same box, as those of a quad do,
/// are one leaf. The leaves are the same for any number of threads.
/// \throw Cancelled
Leaves makeLeaves(const BvhTriangles& triangles, Interrupter* interrupter);

} // namespace vdbcage::detail
