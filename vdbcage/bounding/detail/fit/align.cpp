// Based on: Besl and McKay, "A Method for Registration of 3-D Shapes", 1992 (nearest points as counterparts).
// Differs: only the parts of the model that are outside pull.

#include <vdbcage/bounding/detail/fit/align.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

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

double meanOf(const std::vector<double>& list)
{
    return std::accumulate(list.begin(), list.end(), 0.0) / static_cast<double>(list.size());
}

double medianOf(std::vector<double> list)
{
    const auto middle = list.begin() + static_cast<std::ptrdiff_t>(list.size() / 2);
    std::nth_element(list.begin(), middle, list.end());
    return *middle;
}

/// Returns how far a surface and a model are from each other, on both ways: the model's samples that are outside, and
/// the surface's points.
template <typename Average>
double misfit(const std::vector<Vec3d>& points, const std::vector<Demand>& demands, const DemandFinder& finder,
              const Average& average)
{
    std::vector<double> outside, away;
    for (const Demand& d : demands) outside.push_back(d.offset - d.normal.dot(d.point(points)));
    outside.resize(finder.samples(), 0);
    for (const Vec3d& p : points) away.push_back(finder.distanceToModel(p));
    return average(outside) + average(away);
}

} // namespace

void align(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, DemandFinder& finder,
           Interrupter* interrupter)
{
    constexpr int rounds = 20;
    constexpr double little = 0.02; // of the samples
    const double stiffness = little * static_cast<double>(finder.samples());
    constexpr double mostMisfit = 2; // over that before: faces have to be farther from the model to have it inside
    std::vector<Vec3d> moving = points;
    std::vector<Demand> demands = finder.ofSamples(moving, triangles);
    const double before = misfit(points, demands, finder, medianOf);
    for (int round = 0; round < rounds; ++round) {
        throwIfInterrupted(interrupter);
        if (static_cast<double>(demands.size()) <= stiffness) break;
        Alignment map = alignmentFor(moving, demands, stiffness);
        // Demands are of one half, which would draw the cage to its side.
        if (finder.symmetry()) map.shift[finder.symmetry()->axis] = 0;
        for (Vec3d& p : moving) p += map.stepOf(p);
        demands = finder.ofSamples(moving, triangles);
    }
    // A cage that fits but for a limb was blown up until that was inside, too. Medians know nothing of the limb.
    if (misfit(moving, demands, finder, medianOf) <= mostMisfit * before) points = std::move(moving);
}

namespace {

/// Returns the rotations by multiples of 90 degrees about the axes; the first turns nothing.
std::vector<openvdb::Mat3d> quarterTurns()
{
    std::vector<openvdb::Mat3d> turns;
    std::array<int, 3> axes{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            openvdb::Mat3d turn = openvdb::Mat3d::zero();
            for (const int i : {0, 1, 2}) turn[i][axes[static_cast<std::size_t>(i)]] = (signs >> i & 1) != 0 ? -1 : 1;
            if (turn.det() > 0) turns.push_back(turn);
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
    return turns;
}

/// Moves points and scales them along the axes, so that their box is `box`; along an axis without extent they are only
/// moved.
void moveIntoBox(std::vector<Vec3d>& points, const Box& box)
{
    Box now = Box::of(points.front());
    for (const Vec3d& p : points) now.expand(Box::of(p));
    for (Vec3d& p : points) {
        for (const int i : {0, 1, 2}) {
            const double size = now.hi[i] - now.lo[i];
            const double scale = size > 0 ? (box.hi[i] - box.lo[i]) / size : 1;
            p[i] = 0.5 * (box.lo[i] + box.hi[i]) + scale * (p[i] - 0.5 * (now.lo[i] + now.hi[i]));
        }
    }
}

} // namespace

void place(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const Box& box, bool mayTurn,
           DemandFinder& finder, Interrupter* interrupter)
{
    if (!mayTurn) return moveIntoBox(points, box);
    const std::vector<Vec3d> before = points;
    double least = std::numeric_limits<double>::infinity();
    for (const openvdb::Mat3d& turn : quarterTurns()) {
        throwIfInterrupted(interrupter);
        std::vector<Vec3d> turned;
        for (const Vec3d& p : before) turned.push_back(turn * p);
        moveIntoBox(turned, box);
        const double now = misfit(turned, finder.ofSamples(turned, triangles), finder, meanOf);
        if (now < least) points = turned;
        least = std::min(least, now);
    }
}

} // namespace vdbcage::detail
