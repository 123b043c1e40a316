#include <vdbcage/bounding/detail/fit/untangle.h>

#include <algorithm>

#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/geometry/dynamic_bvh.h>
#include <vdbcage/geometry/triangle_pair.h>

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

bool untangle(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const std::vector<char>& isKept,
              const GuardModel& guard, Interrupter* interrupter)
{
    constexpr int rounds = 200, roundsARing = 4;
    const std::size_t n = points.size();
    const auto adjacent = neighboursOf(n, triangles);
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
        const std::vector<Vec3d> before = points;
        for (std::size_t v = 0; v < n; ++v) {
            if (rings[v] < 0 || isKept[v] || adjacent[v].empty()) continue;
            Vec3d mean(0.0);
            for (const std::uint32_t w : adjacent[v]) mean += before[w];
            mean /= static_cast<double>(adjacent[v].size());
            points[v] = guard.rounded(0.5 * (before[v] + mean));
        }
    }
    return crossingTriangles(points, triangles, guard).empty();
}

} // namespace vdbcage::detail
