#include <vdbcage/geometry/bvh_triangles.h>

#include <cmath>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

BvhTriangles::BvhTriangles(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                           Interrupter* interrupter)
    : points_(points), triangles_(triangles), box_(boxOfAll(interrupter))
{
    const Vec3d half = box_.hi * 0.5 - box_.lo * 0.5; // must not overflow
    const double inverse = 1 / maxAbs(half);
    units_.centre = box_.lo * 0.5 + box_.hi * 0.5;
    units_.scale = std::isfinite(inverse) ? inverse : 1.0;
}

Box BvhTriangles::boxOfAll(Interrupter* interrupter) const
{
    constexpr std::size_t blockSize = 16384;
    return parallelReduce(
        tbb::blocked_range<std::size_t>(0, triangles_.size(), blockSize), Box::of(corners(0)),
        [&](const tbb::blocked_range<std::size_t>& range, Box sum) {
            throwIfInterrupted(interrupter);
            for (std::size_t i = range.begin(); i < range.end(); ++i) sum.expand(Box::of(corners(i)));
            return sum;
        },
        [](Box a, const Box& b) {
            a.expand(b);
            return a;
        });
}

FloatBox BvhTriangles::boxAlong(const BvhFrame& frame, std::uint32_t first, std::uint32_t count) const
{
    // Turning a point within [-1, 1] adds an error of less than 2e-15, in a query and here.
    const Vec3d rounding(4e-15);
    FloatBox sum;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Corners t = cornersInUnits(first + i);
        const Box box = Box::of({frame.of(t[0]), frame.of(t[1]), frame.of(t[2])});
        const FloatBox rounded = roundedOutward({box.lo - rounding, box.hi + rounding});
        sum.expand(rounded.lo, rounded.hi);
    }
    return sum;
}

} // namespace vdbcage::detail
