// The regions of queries, and slabs that make them narrower than boxes.
#include <vdbcage/geometry/triangle_bvh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vdbcage::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest = 1e-100;

} // namespace

TriangleBvh::Query::Query(const Box& box)
{
    // All nodes lie within [-1.1, 1.1]. NaN, of a box too far away for the arithmetic, stays and is met nowhere.
    for (std::size_t i = 0; i < 3; ++i) {
        const int axis = static_cast<int>(i);
        lo_[i] = Floats{} + roundedDown(std::clamp(box.lo[axis], -4.0, 4.0));
        hi_[i] = Floats{} + roundedUp(std::clamp(box.hi[axis], -4.0, 4.0));
    }
}

/// Adds a slab. `farthest` is the largest coordinate from which it was computed.
void TriangleBvh::Query::addSlab(const Vec3d& normal, double low, double high, double farthest)
{
    // Projections of nodes, in float, are off by less than 3e-6; a normal may point astray by 1e-7.
    const double slack = 4e-6 + 2e-7 * farthest;
    Slab& slab = slab_[slabs_++];
    for (std::size_t i = 0; i < 3; ++i) {
        const auto component = static_cast<float>(normal[static_cast<int>(i)]);
        slab.normal[i] = Floats{} + component;
        slab.absolute[i] = Floats{} + std::abs(component);
    }
    slab.twiceLow = Floats{} + static_cast<float>(std::clamp(2 * (low - slack), -1e30, 1e30));
    slab.twiceHigh = Floats{} + static_cast<float>(std::clamp(2 * (high + slack), -1e30, 1e30));
}

TriangleBvh::Query TriangleBvh::Query::along(const BvhFrame& frame) const
{
    std::array<std::array<Floats, 3>, 3> axes;
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            axes[i][j] = Floats{} + static_cast<float>(frame.axes[i][static_cast<int>(j)]);
        }
    }
    const auto turned = [&](std::size_t i, const std::array<Floats, 3>& v) {
        return axes[i][0] * v[0] + axes[i][1] * v[1] + axes[i][2] * v[2];
    };
    const auto absolute = [](Floats v) { return greatest(v, -v); };
    Query query = aroundPoints(frame);
    if (query.count_ == 0) {
        // Places are within 4 in each direction, turned ones within 7: off by less than 4e-6 in float.
        std::array<Floats, 3> middle, half;
        for (std::size_t i = 0; i < 3; ++i) {
            middle[i] = (lo_[i] + hi_[i]) * 0.5F;
            half[i] = (hi_[i] - lo_[i]) * 0.5F;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const Floats centre = turned(i, middle);
            const Floats reach = absolute(axes[i][0]) * half[0] + absolute(axes[i][1]) * half[1] +
                                 absolute(axes[i][2]) * half[2] + 4e-6F;
            query.lo_[i] = centre - reach;
            query.hi_[i] = centre + reach;
        }
    }
    for (std::size_t k = 0; k < slabs_; ++k) {
        const Slab& from = slab_[k];
        Slab& to = query.slab_[query.slabs_++];
        for (std::size_t i = 0; i < 3; ++i) {
            to.normal[i] = turned(i, from.normal);
            to.absolute[i] = absolute(to.normal[i]);
        }
        // Projections of nodes, twice, are off by less than 5e-6 by the boxes, and by 4e-6 by the normal.
        to.twiceLow = from.twiceLow - 1e-5F;
        to.twiceHigh = from.twiceHigh + 1e-5F;
    }
    return query;
}

/// Returns a query with slabs along the first axis alone; without points if there are none, or if they are too far
/// away.
TriangleBvh::Query TriangleBvh::Query::aroundPoints(const BvhFrame& frame) const
{
    if (count_ == 0) return {};
    std::array<Vec3d, 4> turned;
    double farthest = 1;
    for (std::size_t i = 0; i < count_; ++i) {
        turned[i] = frame.of(points_[i]);
        farthest = std::max(farthest, maxAbs(points_[i]));
    }
    Box box = Box::of(turned[0]);
    for (std::size_t i = 1; i < count_; ++i) box.expand(Box::of(turned[i]));
    // Turning a point adds an error of less than 2e-15 of its size.
    const Vec3d reach(margin_ + 4e-15 * farthest);
    if (!(farthest < 1e150) || !reach.isFinite()) return {};
    Query query({box.lo - reach, box.hi + reach});
    query.points_ = points_;
    query.count_ = count_;
    query.margin_ = margin_;
    // A needle is long: along it, it shows whether it passes by.
    for (std::size_t i = 0; i < count_; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3d edge = turned[i] - turned[j];
            const double length = std::hypot(edge[1], edge[2]);
            if (!(length > leastSineOfPlane * edge.length()) || !(length > smallest)) continue;
            const Vec3d normal = Vec3d(0, edge[2], -edge[1]) / length;
            double low = infinity, high = -infinity;
            for (std::size_t k = 0; k < count_; ++k) {
                low = std::min(low, normal.dot(turned[k]));
                high = std::max(high, normal.dot(turned[k]));
            }
            // Nodes are within 2 here, so their projections are off by twice as much as in addSlab().
            constexpr double rounding = 4e-6;
            query.addSlab(normal, low - reach[0] - rounding, high + reach[0] + rounding, farthest);
        }
    }
    return query;
}

TriangleBvh::Query TriangleBvh::inBox(const Box& box) const
{
    return Query({units_.of(box.lo), units_.of(box.hi)});
}

TriangleBvh::Query TriangleBvh::near(const Corners& triangle, double maxDistance) const
{
    Box box = Box::of(triangle);
    box.lo -= Vec3d(maxDistance);
    box.hi += Vec3d(maxDistance);
    Query query = inBox(box);
    const Corners t{units_.of(triangle[0]), units_.of(triangle[1]), units_.of(triangle[2])};
    for (const Vec3d& p : t) query.addPoint(p);
    query.margin_ = maxDistance * units_.scale;
    const Vec3d u = t[1] - t[0], v = t[2] - t[0];
    Vec3d normal = u.cross(v);
    const double length = normal.length();
    if (!(length > leastSineOfPlane * u.length() * v.length()) || !(length > smallest)) return query;
    normal /= length;
    const double margin = query.margin_, farthest = std::max({maxAbs(t[0]), maxAbs(t[1]), maxAbs(t[2])});
    const double height = normal.dot(t[0]);
    query.addSlab(normal, height - margin, height + margin, farthest);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d edge = t[(i + 1) % 3] - t[i];
        const Vec3d outward = edge.cross(normal) / edge.length();
        query.addSlab(outward, -infinity, outward.dot(t[i]) + margin, farthest);
    }
    return query;
}

TriangleBvh::Query TriangleBvh::inTetrahedron(const std::array<Vec3d, 4>& corners) const
{
    Box box = Box::of(corners[0]);
    for (const Vec3d& p : corners) box.expand(Box::of(p));
    Query query = inBox(box);
    std::array<Vec3d, 4> p;
    double farthest = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        p[i] = units_.of(corners[i]);
        query.addPoint(p[i]);
        farthest = std::max(farthest, maxAbs(p[i]));
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d& a = p[(i + 1) & 3];
        const Vec3d u = p[(i + 2) & 3] - a, v = p[(i + 3) & 3] - a;
        const Vec3d normal = u.cross(v);
        const double length = normal.length();
        if (!(length > leastSineOfPlane * u.length() * v.length()) || !(length > smallest)) continue;
        const double here = normal.dot(a) / length, opposite = normal.dot(p[i]) / length;
        query.addSlab(normal / length, std::min(here, opposite), std::max(here, opposite), farthest);
    }
    return query;
}

} // namespace vdbcage::detail
