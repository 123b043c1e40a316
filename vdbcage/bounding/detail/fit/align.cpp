// Based on: Besl and McKay, "A Method for Registration of 3-D Shapes", 1992 (nearest points as counterparts).
// Differs: only the parts of the model that are outside pull.

#include <vdbcage/bounding/detail/fit/align.h>

#include <algorithm>

#include <openvdb/math/Mat3.h>

namespace vdbcage::detail {

namespace {

/// The map of p to p + shift + scale * (p - centre), component by component.
struct Alignment {
    Vec3d centre, shift{0.0}, scale{0.0};

    Vec3d stepOf(const Vec3d& p) const { return shift + scale * (p - centre); }
};

/// Returns the map that meets the demands best. `stiffness` holds it back, in demands that each point of the surface
/// stays where it is.
Alignment alignmentFor(const std::vector<Vec3d>& points, const std::vector<Demand>& demands, double stiffness)
{
    constexpr int turns = 2; // shift, then scale
    constexpr double leastScale = -0.2, mostScale = 0.25;
    Alignment map;
    map.centre = Vec3d(0.0);
    for (const Vec3d& p : points) map.centre += p / static_cast<double>(points.size());
    Vec3d variance(0.0);
    for (const Vec3d& p : points) variance += (p - map.centre) * (p - map.centre) / static_cast<double>(points.size());
    for (int turn = 0; turn < 2 * turns; ++turn) {
        const bool isShift = turn % 2 == 0;
        openvdb::Mat3d a = openvdb::Mat3d::zero();
        Vec3d b(0.0);
        for (const Demand& d : demands) {
            const Vec3d p = d.point(points);
            const Vec3d n = isShift ? d.normal : d.normal * (p - map.centre);
            const double lack = d.offset - d.normal.dot(p + map.stepOf(p));
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) a[i][j] += n[i] * n[j];
                b[i] += n[i] * lack;
            }
        }
        for (int i = 0; i < 3; ++i) a[i][i] += stiffness * (isShift ? 1 : variance[i]);
        (isShift ? map.shift : map.scale) += a.inverse(0.0) * b;
    }
    for (int i = 0; i < 3; ++i) map.scale[i] = std::clamp(map.scale[i], leastScale, mostScale);
    return map;
}

} // namespace

void align(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, DemandFinder& finder,
           Interrupter* interrupter)
{
    constexpr int rounds = 20;
    constexpr double little = 0.02; // of the samples
    const double stiffness = little * static_cast<double>(finder.samples());
    for (int round = 0; round < rounds; ++round) {
        throwIfInterrupted(interrupter);
        const std::vector<Demand> demands = finder.ofSamples(points, triangles);
        if (static_cast<double>(demands.size()) <= stiffness) return;
        const Alignment map = alignmentFor(points, demands, stiffness);
        for (Vec3d& p : points) p += map.stepOf(p);
    }
}

} // namespace vdbcage::detail
