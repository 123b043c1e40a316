// Based on: I. Wald, C. Benthin, S. Boulos, "Getting Rid of Packets", 2008 (trees of four children for SIMD).
#include <vdbcage/geometry/triangle_bvh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/geometry/bvh_builder.h>

namespace vdbcage::detail {

namespace {

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

} // namespace

TriangleBvh::TriangleBvh(std::vector<Vec3d> points, const std::vector<Vec3I>& triangles, Interrupter* interrupter,
                         Copies copies)
    : points_(std::move(points))
{
    if (triangles.size() > maxItems) {
        throw InputError(std::to_string(triangles.size()) + " triangles are too many; at most " +
                         std::to_string(maxItems) + " are allowed");
    }
    if (!triangles.empty()) BvhBuilder(*this, triangles, copies, interrupter).build();
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
    const Vec3d place =
        openvdb::math::minComponent(Vec3d(1e15), openvdb::math::maxComponent(Vec3d(-1e15), units_.of(p)));
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
        const double distance = std::sqrt(squaredDistance) * units_.scale / (1 + slack);
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
