// Based on: S. Woop et al., "Exploiting Local Orientation Similarity for Efficient Ray Traversal of Hair and Fur",
// 2014 (boxes along their content, triangles sorted by direction).
// Differs: all boxes below a node are along the same axes.
#include <vdbcage/geometry/bvh_needles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <openvdb/math/Math.h>
#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

// Needles side by side. A place is in as many boxes on average as the sum of their areas over that of the box around
// them.
struct Group {
    FloatBox around;
    double area = 0;
    std::uint32_t count = 0;

    void add(const LeafRef& ref)
    {
        around.expand(ref.lo, ref.hi);
        area += ref.box().area();
        ++count;
    }
    bool isCrowded() const { return count >= NeedleFinder::crowd && area > NeedleFinder::crowd * around.area(); }
};

Vec3d anyAcross(const Vec3d& direction)
{
    Vec3d axis(0.0);
    axis[openvdb::math::MinIndex(openvdb::math::Abs(direction))] = 1;
    return direction.cross(axis).unit();
}

// Returns axes along the longest edge of a triangle, and along its plane.
BvhFrame frameOf(const Corners& t)
{
    std::array<Vec3d, 3> edges{t[1] - t[0], t[2] - t[1], t[0] - t[2]};
    std::sort(edges.begin(), edges.end(), [](const Vec3d& a, const Vec3d& b) { return a.lengthSqr() > b.lengthSqr(); });
    BvhFrame frame;
    frame.axes[0] = edges[0].unit();
    const Vec3d across = frame.axes[0].cross(edges[1]);
    // A sliver without a plane may lie in any plane.
    const bool hasPlane = across.length() > leastSineOfPlane * edges[0].length();
    frame.axes[2] = hasPlane ? across.unit() : anyAcross(frame.axes[0]);
    frame.axes[1] = frame.axes[2].cross(frame.axes[0]).unit();
    frame.axes[2] = frame.axes[0].cross(frame.axes[1]).unit();
    return frame;
}

} // namespace

std::optional<NeedleFinder::Needles> NeedleFinder::gather(const LeafRange& range) const
{
    constexpr std::uint32_t tries = 8; // directions
    if (leaves_.needles < crowd || range.size() < crowd || range.isDeep()) return std::nullopt;
    Asker ask(interrupter_);
    LeafRef* const first = leaves_.refs.get() + range.begin;
    LeafRef* const last = leaves_.refs.get() + range.end;
    Group all;
    for (const LeafRef* ref = first; ref != last; ++ref) {
        ask();
        all.around.expand(ref->lo, ref->hi);
        if (ref->isNeedle()) all.add(*ref);
    }
    if (!all.isCrowded()) return std::nullopt;
    const auto gains = [&](const LeafRef& ref, const BvhFrame& frame) {
        return ref.isNeedle() && ref.box().area() > LeafRef::needle * boxAlong(frame, ref).area();
    };
    BvhFrame bestFrame;
    Group best;
    std::uint32_t needles = 0;
    for (const LeafRef* along = first; along != last; ++along) {
        if (!along->isNeedle() || needles++ % (all.count / tries) != 0) continue;
        const BvhFrame frame = frameOf(triangles_.cornersInUnits(along->triangle));
        Group group;
        for (const LeafRef* ref = first; ref != last; ++ref) {
            ask();
            if (gains(*ref, frame)) group.add(*ref);
        }
        if (!group.isCrowded() || !(group.area > best.area)) continue;
        best = group;
        bestFrame = frame;
    }
    if (best.count == 0) return std::nullopt;
    const LeafRef* const end = std::partition(first, last, [&](const LeafRef& ref) {
        ask();
        return gains(ref, bestFrame);
    });
    return Needles{range.begin + static_cast<std::uint32_t>(end - first),
                   rolled(alongLongest(bestFrame, first, end), first, end)};
}

BvhFrame NeedleFinder::alongLongest(const BvhFrame& frame, const LeafRef* first, const LeafRef* last) const
{
    Asker ask(interrupter_);
    std::array<double, 3> lengths{};
    for (const LeafRef* ref = first; ref != last; ++ref) {
        ask();
        const FloatBox box = boxAlong(frame, *ref);
        for (std::size_t i = 0; i < 3; ++i) lengths[i] += double{box.hi[i]} - double{box.lo[i]};
    }
    const auto longest = std::max_element(lengths.begin(), lengths.end()) - lengths.begin();
    BvhFrame ordered = frame;
    std::rotate(ordered.axes.begin(), ordered.axes.begin() + longest, ordered.axes.end());
    return ordered;
}

BvhFrame NeedleFinder::rolled(const BvhFrame& frame, const LeafRef* first, const LeafRef* last) const
{
    constexpr int tries = 8;
    constexpr double right = pi / 2;
    Asker ask(interrupter_);
    BvhFrame best;
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i < tries; ++i) {
        const double cosine = std::cos(i * right / tries), sine = std::sin(i * right / tries);
        const BvhFrame turned{{frame.axes[0], cosine * frame.axes[1] + sine * frame.axes[2],
                               cosine * frame.axes[2] - sine * frame.axes[1]}};
        FloatBox sum;
        for (const LeafRef* ref = first; ref != last; ++ref) {
            ask();
            const FloatBox box = boxAlong(turned, *ref);
            sum.expand(box.lo, box.hi);
        }
        if (!(sum.area() < least)) continue;
        least = sum.area();
        best = turned;
    }
    return best;
}

} // namespace vdbcage::detail
