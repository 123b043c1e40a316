// Based on: Hoppe, DeRose, Duchamp, McDonald, Stuetzle, "Mesh Optimization", 1993 (splits where they gain most and
//           collapses where they cost least, by turns).
// Differs: whole loops are split and collapsed.

#include <vdbcage/bounding/detail/loops/loop_exchange.h>

#include <algorithm>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/loops/loop_decimation.h>
#include <vdbcage/bounding/detail/loops/loop_split.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

struct Quads {
    GuardedMesh surface;
    QuadTable table;
    double distance; // the integral, plus the weights of quads that are not fit
};

/// Returns the distance of a surface. `areaPerSample` is the same for all that are compared.
double distanceOf(const GuardedMesh& surface, const QuadTable& table, double areaPerSample, Interrupter* interrupter)
{
    const double sum = integratedDistance(surface, areaPerSample, interrupter);
    return sum +
           sum / static_cast<double>(table.count()) * unfitWeight * static_cast<double>(countUnfit(surface, table));
}

/// Returns the loops with the most distance for each of their quads, of those with at most `most` quads.
std::vector<QuadLoop> candidates(const Quads& now, std::size_t most, std::size_t count, double areaPerSample,
                                 Interrupter* interrupter)
{
    std::vector<QuadLoop> loops = straightLoops(now.table);
    const auto isTooLong = [&](const QuadLoop& loop) { return loop.quads.size() > most; };
    loops.erase(std::remove_if(loops.begin(), loops.end(), isTooLong), loops.end());
    const DistanceMeasure measure(now.surface, areaPerSample);
    std::vector<std::pair<double, std::size_t>> ranking(loops.size());
    parallelFor(std::size_t(0), loops.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter);
        double sum = 0;
        std::uint32_t seed = TriangleBvh::none;
        for (const std::uint32_t q : loops[i].quads) {
            const auto p = pointsOf(now.surface, now.table.corners(q));
            sum += measure.integral({p[0], p[1], p[2]}, seed) + measure.integral({p[0], p[2], p[3]}, seed);
        }
        ranking[i] = {-sum / static_cast<double>(loops[i].quads.size()), i};
    });
    std::sort(ranking.begin(), ranking.end());
    std::vector<QuadLoop> best;
    for (std::size_t i = 0; i < std::min(count, ranking.size()); ++i) best.push_back(loops[ranking[i].second]);
    return best;
}

/// Splits loops, best first, until none that brings the surface nearer fits.
void refill(Quads& now, std::size_t quads, double areaPerSample, Interrupter* interrupter)
{
    constexpr std::size_t tries = 4;
    constexpr int sweeps = 3;
    while (now.table.count() < quads) {
        throwIfInterrupted(interrupter);
        const std::vector<QuadLoop> loops =
            candidates(now, quads - now.table.count(), tries, areaPerSample, interrupter);
        std::vector<Quads> made(loops.size(), now);
        std::vector<double> gain(loops.size(), 0); // for each quad
        parallelFor(std::size_t(0), loops.size(), [&](std::size_t i) {
            std::vector<std::uint32_t> moving = splitLoop(made[i].surface, made[i].table, loops[i]);
            if (moving.empty()) return;
            for (const Rung& rung : loops[i].rungs) moving.insert(moving.end(), rung.begin(), rung.end());
            std::sort(moving.begin(), moving.end());
            moving.erase(std::unique(moving.begin(), moving.end()), moving.end());
            relaxQuads(made[i].surface, made[i].table, moving, sweeps, interrupter);
            made[i].distance = distanceOf(made[i].surface, made[i].table, areaPerSample, interrupter);
            gain[i] = (now.distance - made[i].distance) / static_cast<double>(loops[i].quads.size());
        });
        const auto best = std::max_element(gain.begin(), gain.end());
        if (best == gain.end() || !(*best > 0)) return;
        now = std::move(made[static_cast<std::size_t>(best - gain.begin())]);
    }
}

} // namespace

void exchangeLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, int rounds, Interrupter* interrupter)
{
    constexpr double firstShare = 0.1;
    constexpr int sweeps = 4;
    const double perSample = areaPerSample(surface);
    const auto relax = [&](Quads& now) {
        relaxQuads(now.surface, now.table, sweeps, interrupter);
        now.distance = distanceOf(now.surface, now.table, perSample, interrupter);
    };
    Quads best{surface, table, 0};
    relax(best);
    refill(best, quads, perSample, interrupter);
    relax(best);
    double share = firstShare;
    for (int i = 0; i < rounds; ++i) {
        Quads now = best;
        const auto gone = static_cast<std::size_t>(share * static_cast<double>(now.table.count()));
        if (gone == 0) break;
        collapseLoops(now.surface, now.table, now.table.count() - gone, AtJoints::keepRings, 0, interrupter);
        relax(now);
        refill(now, quads, perSample, interrupter);
        relax(now);
        if (now.distance < best.distance) {
            best = std::move(now);
        } else {
            share *= 0.5;
        }
    }
    surface = std::move(best.surface);
    table = std::move(best.table);
}

} // namespace vdbcage::detail
