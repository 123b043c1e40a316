// Based on: I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008 (trees of four children for SIMD).
#include <vdbcage/geometry/bvh_builder.h>

#include <algorithm>
#include <limits>
#include <optional>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

BvhBuilder::BvhBuilder(TriangleBvh& tree, const std::vector<Vec3I>& triangles, TriangleBvh::Copies copies,
                       Interrupter* interrupter)
    : tree_(tree), interrupter_(interrupter), triangles_(tree.points_, triangles, interrupter),
      leaves_(makeLeaves(triangles_, interrupter)), needles_(triangles_, leaves_, interrupter),
      splitter_(triangles_, leaves_, copies, interrupter)
{
}

void BvhBuilder::build()
{
    tree_.box_ = triangles_.box();
    tree_.units_ = triangles_.units();
    tree_.frames_.emplace_back();
    tree_.nodes_.reset(new TriangleBvh::Node[leaves_.count]); // not initialized: few pages are touched
    nodeCount_ = 1;
    buildNode(0, {0, leaves_.count, 0, 0});
    placeItems();
}

FloatBox BvhBuilder::buildNode(std::uint32_t nodeIndex, LeafRange whole)
{
    const bool large = whole.isLarge();
    const std::optional<NeedleFinder::Needles> needles = needles_.gather(whole);
    const bool isTurned = needles && needles->end == whole.end;
    FloatBox before; // the box before turning, if it is turned
    if (isTurned) {
        before = boxOf(whole);
        turn(whole, needles->frame);
    }
    // Some needles are turned when they become a node.
    const Parts parts = divide(whole, needles && !isTurned ? needles->end : whole.begin);
    std::array<FloatBox, 4> boxes;
    std::array<std::uint32_t, 4> child{};
    const auto buildChild = [&](std::size_t i) {
        const LeafRange& range = parts.ranges[i];
        if (range.size() == 1) {
            child[i] = range.begin | TriangleBvh::isLeaf;
            boxes[i] = leaves_.refs[range.begin].box();
            return;
        }
        child[i] = nodeCount_.fetch_add(1, std::memory_order_relaxed);
        boxes[i] = buildNode(child[i], range);
    };
    if (large) {
        parallelFor(std::size_t(0), parts.count, buildChild);
    } else {
        for (std::size_t i = 0; i < parts.count; ++i) buildChild(i);
    }
    TriangleBvh::Node& node = tree_.nodes_[nodeIndex];
    node.child = child;
    node.frame = whole.frame;
    const FloatBox sum = setBoxes(node, boxes, parts.count);
    return isTurned ? before : sum;
}

BvhBuilder::Parts BvhBuilder::divide(const LeafRange& whole, std::uint32_t fixedEnd) const
{
    Parts parts;
    auto& [ranges, count] = parts;
    if (fixedEnd > whole.begin) ranges[count++] = {whole.begin, fixedEnd, whole.depth + 1, whole.frame};
    const std::size_t fixed = count;
    ranges[count++] = {fixedEnd, whole.end, whole.depth + fixed, whole.frame};
    while (count < 4) {
        LeafRange* const largest =
            std::max_element(ranges.begin() + fixed, ranges.begin() + count,
                             [](const LeafRange& a, const LeafRange& b) { return a.size() < b.size(); });
        if (largest->size() == 1) break;
        const std::size_t depth = largest->depth + 1;
        const std::uint32_t middle = whole.size() <= 4 ? largest->begin + 1 : splitter_.split(*largest);
        if (middle == largest->end) continue; // all others were copies: one is left
        ranges[count++] = {middle, largest->end, depth, whole.frame};
        *largest = {largest->begin, middle, depth, whole.frame};
    }
    return parts;
}

FloatBox BvhBuilder::setBoxes(TriangleBvh::Node& node, const std::array<FloatBox, 4>& boxes, std::size_t count)
{
    FloatBox sum;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.lo[axis][i] = i < count ? boxes[i].lo[axis] : std::numeric_limits<float>::quiet_NaN();
            node.hi[axis][i] = i < count ? boxes[i].hi[axis] : std::numeric_limits<float>::quiet_NaN();
        }
        if (i < count) sum.expand(boxes[i].lo, boxes[i].hi);
    }
    return sum;
}

void BvhBuilder::turn(LeafRange& range, const BvhFrame& frame)
{
    Asker ask(interrupter_);
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        ask();
        LeafRef& ref = leaves_.refs[i];
        const FloatBox box = triangles_.boxAlong(frame, ref.triangle, ref.count);
        ref.lo = box.lo;
        ref.hi = box.hi;
    }
    const std::lock_guard lock(framesMutex_);
    range.frame = static_cast<std::uint32_t>(tree_.frames_.size());
    tree_.frames_.push_back(frame);
}

FloatBox BvhBuilder::boxOf(const LeafRange& range) const
{
    FloatBox sum;
    for (std::uint32_t i = range.begin; i < range.end; ++i) sum.expand(leaves_.refs[i].lo, leaves_.refs[i].hi);
    return sum;
}

void BvhBuilder::placeItems()
{
    constexpr std::size_t blockSize = 16384;
    std::vector<std::uint32_t> firstItem(leaves_.count);
    std::uint32_t items = 0;
    for (std::uint32_t leaf = 0; leaf < leaves_.count; ++leaf) {
        firstItem[leaf] = items;
        items += leaves_.refs[leaf].count;
    }
    throwIfInterrupted(interrupter_);
    tree_.items_.resize(items);
    parallelFor(tbb::blocked_range<std::uint32_t>(0, leaves_.count, blockSize), [&](const auto& range) {
        throwIfInterrupted(interrupter_);
        for (std::uint32_t leaf = range.begin(); leaf < range.end(); ++leaf) {
            for (std::uint32_t i = 0; i < leaves_.refs[leaf].count; ++i) {
                const std::uint32_t triangle = leaves_.refs[leaf].triangle + i;
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
                child = TriangleBvh::leafChild(firstItem[leaf], leaves_.refs[leaf].count);
            }
        }
    });
}

} // namespace vdbcage::detail
