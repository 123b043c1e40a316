// Based on: Tutte, "How to Draw a Graph", 1963, and Floater, "Parametrization and Smooth Approximation of Surface
// Triangulations", 1997 (points at weighted means of their neighbours do not fold over in a convex outline).
// Differs: the outline is where a limb leaves the rest, and weights depend on the steps to it.

#include <vdbcage/bounding/detail/fit/untangle.h>

#include <algorithm>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/dynamic_bvh.h>
#include <vdbcage/geometry/triangle_pair.h>
#include <vdbcage/geometry/union_find.h>

namespace vdbcage::detail {

namespace {

/// Returns the points joined to each point by sides of triangles, ascending.
std::vector<std::vector<std::uint32_t>> neighboursOf(std::size_t points, const std::vector<Vec3I>& triangles)
{
    std::vector<std::vector<std::uint32_t>> lists(points);
    for (const Vec3I& t : triangles) {
        for (const int i : {0, 1, 2}) {
            lists[t[i]].push_back(t[(i + 1) % 3]);
            lists[t[i]].push_back(t[(i + 2) % 3]);
        }
    }
    for (auto& list : lists) {
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }
    return lists;
}

/// Returns for each point whether crossing triangles cut it off from the largest part of its surface: a limb beyond the
/// place where it goes through another part, but for the points of the crossing triangles themselves.
std::vector<char> cutOff(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                         const std::vector<std::uint32_t>& crossing)
{
    UnionFind surfaces(points.size()), parts(points.size());
    std::vector<double> areas(points.size(), 0); // by the first point of a part
    const auto isCrossing = [&](std::size_t i) {
        return std::binary_search(crossing.begin(), crossing.end(), static_cast<std::uint32_t>(i));
    };
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Vec3I& t = triangles[i];
        for (const int k : {1, 2}) {
            surfaces.unite(t[0], t[k]);
            if (!isCrossing(i)) parts.unite(t[0], t[k]);
        }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Vec3I& t = triangles[i];
        if (isCrossing(i)) continue;
        areas[parts.find(t[0])] += (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).length();
    }
    std::vector<std::uint32_t> largest(points.size()); // by the first point of a surface: that of a part
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        std::uint32_t& of = largest[surfaces.find(v)];
        if (surfaces.find(v) == v || areas[parts.find(v)] > areas[of]) of = parts.find(v);
    }
    std::vector<char> isCutOff(points.size(), 0);
    for (std::uint32_t v = 0; v < points.size(); ++v) isCutOff[v] = parts.find(v) != largest[surfaces.find(v)];
    return isCutOff;
}

} // namespace

std::vector<std::uint32_t> crossingTriangles(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                                             const GuardModel& guard)
{
    const auto count = static_cast<std::uint32_t>(triangles.size());
    const auto triangle = [&](std::uint32_t i) {
        const Vec3I& t = triangles[i];
        return SurfaceTriangle(t, {points[t[0]], points[t[1]], points[t[2]]});
    };
    std::vector<Box> boxes;
    boxes.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) boxes.push_back(Box::of(triangle(i).corners));
    const DynamicBvh tree(boxes);
    const Spacing& spacing = guard.spacing();
    std::vector<std::vector<std::uint32_t>> meets(count);
    parallelFor(std::uint32_t(0), count, [&](std::uint32_t i) {
        const SurfaceTriangle t = triangle(i);
        if (hasNoArea(t.corners)) meets[i].push_back(i);
        const Vec3d reach(spacing.around(t.longestEdge()));
        tree.forEachOverlap({boxes[i].lo - reach, boxes[i].hi + reach}, [&](std::uint32_t j, const Box& /*box*/) {
            if (i != j && tooNear(t, triangle(j), spacing)) meets[i].push_back(j);
            return true;
        });
    });
    std::vector<std::uint32_t> crossing;
    for (std::uint32_t i = 0; i < count; ++i) {
        crossing.insert(crossing.end(), meets[i].begin(), meets[i].end());
        if (!meets[i].empty()) crossing.push_back(i);
    }
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    return crossing;
}

namespace {

Vec3d within(const std::optional<MoveLimit>& limit, const Vec3d& p)
{
    return limit ? limit->nearest(p) : p;
}

bool mayBeLoose(const std::optional<MoveLimit>& limit)
{
    return !limit || !limit->isRail();
}

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Moves the points of crossing triangles towards the mean of their neighbours, and with rounds in vain more rings
/// around them. Whole limbs that are cut off move along. Returns whether no triangles cross.
bool smoothApart(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const Neighbours& adjacent,
                 const MoveLimits& limits, const GuardModel& guard, int rounds, Interrupter* interrupter)
{
    constexpr int roundsARing = 4, stepsOfLimbs = 20;
    const std::size_t n = points.size();
    std::vector<int> crossed(n, 0); // rounds in which triangles at the point did
    for (int round = 0; round < rounds; ++round) {
        throwIfInterrupted(interrupter);
        const std::vector<std::uint32_t> crossing = crossingTriangles(points, triangles, guard);
        if (crossing.empty()) return true;
        std::vector<char> isCrossing(n, 0);
        for (const std::uint32_t i : crossing) {
            for (const int k : {0, 1, 2}) isCrossing[triangles[i][k]] = 1;
        }
        std::vector<int> rings(n, -1); // around each point that move with it; -1: it does not move
        int most = 0;
        for (std::size_t v = 0; v < n; ++v) {
            if (!isCrossing[v]) continue;
            rings[v] = crossed[v]++ / roundsARing;
            most = std::max(most, rings[v]);
        }
        for (int ring = most; ring > 0; --ring) {
            for (std::size_t v = 0; v < n; ++v) {
                if (rings[v] != ring) continue;
                for (const std::uint32_t w : adjacent[v]) rings[w] = std::max(rings[w], ring - 1);
            }
        }
        const std::vector<char> isLimb = cutOff(points, triangles, crossing);
        for (int step = 0; step < stepsOfLimbs; ++step) {
            const std::vector<Vec3d> before = points;
            for (std::size_t v = 0; v < n; ++v) {
                const bool moves = isLimb[v] || (rings[v] >= 0 && step == 0);
                if (!moves || adjacent[v].empty()) continue;
                Vec3d mean(0.0);
                for (const std::uint32_t w : adjacent[v]) mean += before[w];
                mean /= static_cast<double>(adjacent[v].size());
                points[v] = guard.rounded(within(limits[v], 0.5 * (before[v] + mean)));
            }
        }
    }
    return crossingTriangles(points, triangles, guard).empty();
}

/// Spans a membrane over the points that are loose, from the others. Points of one ring around a hole pull each other
/// little, so that a limb becomes a cone of rings that stay apart.
void spanMembrane(std::vector<Vec3d>& points, const Neighbours& adjacent, const std::vector<char>& isLoose,
                  const MoveLimits& limits, const GuardModel& guard)
{
    constexpr int sweeps = 1000;
    constexpr double ofRing = 0.1, least = 1e-9;
    constexpr int unreached = -1;
    std::vector<int> depth(points.size(), unreached); // steps to the points that are not
    std::vector<std::uint32_t> order;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        if (isLoose[v]) continue;
        depth[v] = 0;
        order.push_back(v);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (const std::uint32_t w : adjacent[order[i]]) {
            if (depth[w] != unreached) continue;
            depth[w] = depth[order[i]] + 1;
            order.push_back(w);
        }
    }
    double farthest = 1;
    for (int i = 0; i < sweeps && farthest > least; ++i) {
        farthest = 0;
        for (const std::uint32_t v : order) {
            if (!isLoose[v] || adjacent[v].empty()) continue;
            Vec3d sum(0.0);
            double weights = 0;
            for (const std::uint32_t w : adjacent[v]) {
                const double weight = depth[w] == depth[v] ? ofRing : 1;
                sum += weight * points[w];
                weights += weight;
            }
            const Vec3d place = sum / weights;
            farthest = std::max(farthest, (place - points[v]).length());
            points[v] = place;
        }
    }
    for (std::size_t v = 0; v < points.size(); ++v) {
        if (isLoose[v]) points[v] = guard.rounded(within(limits[v], points[v]));
    }
}

/// Lets the points next to loose ones be loose as well.
void addRing(std::vector<char>& isLoose, const Neighbours& adjacent, const MoveLimits& limits)
{
    const std::vector<char> inner = isLoose;
    for (std::size_t v = 0; v < inner.size(); ++v) {
        if (!inner[v]) continue;
        for (const std::uint32_t w : adjacent[v]) isLoose[w] = isLoose[w] || mayBeLoose(limits[w]);
    }
}

/// Draws limbs that go through other parts back to where they come from. Returns whether no triangles cross.
bool retract(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const Neighbours& adjacent,
             const MoveLimits& limits, const GuardModel& guard, Interrupter* interrupter)
{
    constexpr int rounds = 20, roundsOfSmoothing = 20;
    std::vector<char> isLoose(points.size(), 0);
    for (int round = 0; round < rounds; ++round) {
        throwIfInterrupted(interrupter);
        const std::vector<std::uint32_t> crossing = crossingTriangles(points, triangles, guard);
        if (crossing.empty()) return true;
        std::vector<char> joins = cutOff(points, triangles, crossing);
        for (const std::uint32_t i : crossing) {
            for (const int k : {0, 1, 2}) joins[triangles[i][k]] = 1;
        }
        if (round > 0) addRing(joins, adjacent, limits);
        const std::vector<char> before = isLoose;
        for (std::size_t v = 0; v < points.size(); ++v) isLoose[v] = isLoose[v] || (joins[v] && mayBeLoose(limits[v]));
        if (isLoose == before) addRing(isLoose, adjacent, limits);
        spanMembrane(points, adjacent, isLoose, limits, guard);
        std::vector<Vec3d> places = points;
        if (smoothApart(places, triangles, adjacent, limits, guard, roundsOfSmoothing, interrupter)) {
            points = std::move(places);
            return true;
        }
    }
    return false;
}

} // namespace

bool untangle(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const MoveLimits& limits,
              const GuardModel& guard, Interrupter* interrupter)
{
    const auto adjacent = neighboursOf(points.size(), triangles);
    constexpr int rounds = 200;
    std::vector<Vec3d> places = points;
    if (!smoothApart(places, triangles, adjacent, limits, guard, rounds, interrupter)) {
        places = points;
        if (!retract(places, triangles, adjacent, limits, guard, interrupter)) return false;
    }
    points = std::move(places);
    return true;
}

} // namespace vdbcage::detail
