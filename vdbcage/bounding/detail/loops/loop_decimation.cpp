// Based on: Daniels, Silva, Shepherd, Cohen, "Quadrilateral Mesh Simplification", 2008 (polychords collapse, cheapest
//           first, until few enough quads are left).
// Differs: every rung is a collapse under the guard, the loss of distance of a loop is measured and bounded, and
// vertices are moved in between.

#include <vdbcage/bounding/detail/loops/loop_decimation.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/loops/loop_collapse.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

constexpr double irregularWeight = 0.4; // 0 makes slanted limbs more irregular, 0.8 puts off loops that should collapse

struct Ranked {
    double cost; // by quadrics, for each removed quad
    std::size_t loop;
};

/// Returns the growth of the vertices' irregularity |valence - 4| for each removed rung: -2 to 0.
double irregularityGrowth(const GuardedMesh& surface, const QuadTable& table, const QuadLoop& loop)
{
    const auto irregularity = [](std::size_t edges) { return std::abs(static_cast<double>(edges) - 4); };
    double growth = 0;
    for (const auto& [u, v] : loop.rungs) {
        const std::size_t a = valence(surface, table, u), b = valence(surface, table, v);
        growth += irregularity(a + b - 4) - irregularity(a) - irregularity(b);
    }
    return growth / static_cast<double>(loop.rungs.size());
}

/// Ranks loops, best first. At most `tooMany` quads of a loop count.
std::vector<Ranked> ranked(const GuardedMesh& surface, const QuadTable& table, const VertexQuadrics& quadrics,
                           const std::vector<QuadLoop>& loops, std::size_t tooMany, Interrupter* interrupter)
{
    std::vector<Ranked> ranking(loops.size());
    parallelFor(std::size_t(0), loops.size(), [&](std::size_t i) {
        throwIfInterrupted(interrupter);
        const std::size_t gone = std::min(loops[i].quads.size(), tooMany);
        const double ragged = irregularWeight * irregularityGrowth(surface, table, loops[i]);
        ranking[i] = {collapseCost(quadrics, loops[i]) * (1 + ragged) / static_cast<double>(gone), i};
    });
    std::sort(ranking.begin(), ranking.end(),
              [](const Ranked& a, const Ranked& b) { return std::tie(a.cost, a.loop) < std::tie(b.cost, b.loop); });
    return ranking;
}

class LoopDecimator {
public:
    LoopDecimator(GuardedMesh& surface, QuadTable& table, AtJoints atJoints)
        : surface_(surface), table_(table), keepsRings_(atJoints == AtJoints::keepRings)
    {
        if (!keepsRings_) shape_.hold = 0;
    }

    void run(std::size_t quads, int mostPercent, Interrupter* interrupter)
    {
        constexpr double relaxAfter = 0.75; // of the quads
        constexpr int firstSweeps = 4, relaxSweeps = 3;
        constexpr int mostPushes = 3;
        int pushes = 0;
        double maxLoss = firstLoss;
        if (table_.count() <= quads) return;
        const std::size_t start = table_.count() - quads;
        relaxQuads(surface_, table_, shape_, firstSweeps, interrupter);
        while (table_.count() > quads) {
            relaxQuads(surface_, table_, shape_, relaxSweeps, interrupter);
            VertexQuadrics quadrics(surface_);
            const auto relaxAt =
                std::max(quads, static_cast<std::size_t>(relaxAfter * static_cast<double>(table_.count())));
            const std::size_t before = table_.count();
            while (table_.count() > relaxAt &&
                   collapseRound(quadrics, straightLoops(table_), relaxAt, quads, maxLoss, interrupter)) {
                const std::size_t left = std::max(table_.count(), quads) - quads;
                const auto percent = static_cast<int>(static_cast<std::size_t>(mostPercent) * (start - left) / start);
                throwIfInterrupted(interrupter, mostPercent > 0 ? percent : -1);
            }
            if (table_.count() == before) {
                collapseRound(quadrics, turningLoops(surface_, table_), relaxAt, quads, maxLoss, interrupter);
            }
            if (table_.count() < before) continue;
            if (maxLoss < lastLoss) {
                maxLoss *= 2;
            } else if (pushes < mostPushes) {
                inflate(surface_, 0.02 * (1 << pushes++), interrupter); // there is room farther out
            } else {
                return;
            }
        }
    }

private:
    static constexpr double firstLoss = 2, lastLoss = 100; // loss of distance for each removed quad, in a mean quad's
    static constexpr std::size_t mostRefused = 24;         // in one round; later ones cost more still
    static constexpr int settleSweeps = 2;

    /// Collapses loops that do not touch each other, until `quads` are left or a twentieth are gone, but at least one.
    /// Returns whether any collapsed.
    bool collapseRound(VertexQuadrics& quadrics, const std::vector<QuadLoop>& loops, std::size_t quads,
                       std::size_t target, double maxLoss, Interrupter* interrupter)
    {
        throwIfInterrupted(interrupter);
        const double sample = areaPerSample(surface_);
        const double perQuad = distancePerPolygon(surface_, table_, sample, interrupter);
        const DistanceMeasure measure(surface_, sample);
        const QuadShapeTerm term = shapeTerm(surface_, table_, shape_, sample, interrupter);
        const std::size_t most = table_.count() / 20, tooMany = table_.count() - target;
        std::size_t removed = 0, refused = 0;
        std::vector<char> isTouched(surface_.vertices(), 0);
        std::vector<std::size_t> rings = ringsToKeep();
        for (const Ranked& next : ranked(surface_, table_, quadrics, loops, tooMany, interrupter)) {
            const QuadLoop& loop = loops[next.loop];
            if (table_.count() <= quads || (removed > 0 && removed + loop.quads.size() > most)) break;
            throwIfInterrupted(interrupter);
            if (touches(loop, isTouched) || !leavesQuads(surface_, table_, loop)) continue;
            const double limit =
                lossAround(measure, loop, perQuad) + maxLoss * perQuad * static_cast<double>(loop.quads.size());
            const bool isDone = collapseLoop(surface_, table_, quadrics, loop, [&](const auto& kept) {
                tighten(surface_, kept, settleSweeps, sample, interrupter, &term);
                return lossAround(measure, loop, perQuad) <= limit && keep(rings);
            });
            if (!isDone && ++refused == mostRefused) break;
            if (!isDone) continue;
            removed += loop.quads.size();
            touch(loop, isTouched);
        }
        return removed > 0;
    }

    std::vector<std::size_t> ringsToKeep() const
    {
        return keepsRings_ ? JointRings(surface_, table_).count() : std::vector<std::size_t>();
    }

    /// Returns whether the rings are kept; if so, counts them again.
    bool keep(std::vector<std::size_t>& before) const
    {
        std::vector<std::size_t> now = ringsToKeep();
        if (!JointRings::areKept(before, now)) return false;
        before = std::move(now);
        return true;
    }

    static bool touches(const QuadLoop& loop, const std::vector<char>& isTouched)
    {
        return std::any_of(loop.rungs.begin(), loop.rungs.end(),
                           [&](const Rung& rung) { return isTouched[rung[0]] || isTouched[rung[1]]; });
    }

    void touch(const QuadLoop& loop, std::vector<char>& isTouched) const
    {
        for (const Rung& rung : loop.rungs) {
            for (const std::uint32_t v : rung) {
                isTouched[v] = 1;
                for (const std::uint32_t q : table_.quadsOf(v)) {
                    for (int i = 0; i < 4; ++i) isTouched[table_.corners(q)[i]] = 1;
                }
            }
        }
    }

    /// Returns the faces or quads that `around` has for the ends of the rungs, each once.
    template <typename Around>
    static std::vector<std::uint32_t> gathered(const QuadLoop& loop, const Around& around)
    {
        std::vector<std::uint32_t> list;
        for (const Rung& rung : loop.rungs) {
            for (const std::uint32_t v : rung) list.insert(list.end(), around(v).begin(), around(v).end());
        }
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
        return list;
    }

    /// Returns the integral of the distance over the faces around the rungs, plus the weights of quads that are not
    /// fit.
    double lossAround(const DistanceMeasure& measure, const QuadLoop& loop, double perQuad) const
    {
        double sum = 0;
        std::uint32_t seed = TriangleBvh::none;
        for (const std::uint32_t f : gathered(
                 loop, [&](std::uint32_t v) -> auto& { return surface_.facesOf(v); }))
            sum += measure.integral(surface_.corners(f), seed);
        for (const std::uint32_t q : gathered(
                 loop, [&](std::uint32_t v) -> auto& { return table_.quadsOf(v); })) {
            if (!isFit(surface_, pointsOf(surface_, table_.corners(q)))) sum += unfitWeight * perQuad;
        }
        return sum;
    }

    GuardedMesh& surface_;
    QuadTable& table_;
    bool keepsRings_;
    ShapeWeights shape_ = usualShape;
};

} // namespace

bool collapseLoopThrough(GuardedMesh& surface, QuadTable& table, const std::vector<std::uint32_t>& quads,
                         Interrupter* interrupter)
{
    VertexQuadrics quadrics(surface);
    const auto isAmong = [&](std::uint32_t q) { return std::find(quads.begin(), quads.end(), q) != quads.end(); };
    const std::vector<QuadLoop> loops = straightLoops(table);
    const std::vector<std::size_t> before = JointRings(surface, table).count();
    const auto keepsRings = [&](const auto&) {
        return JointRings::areKept(before, JointRings(surface, table).count());
    };
    for (const Ranked& next : ranked(surface, table, quadrics, loops, table.count(), interrupter)) {
        const QuadLoop& loop = loops[next.loop];
        throwIfInterrupted(interrupter);
        if (std::none_of(loop.quads.begin(), loop.quads.end(), isAmong) || !leavesQuads(surface, table, loop)) continue;
        if (collapseLoop(surface, table, quadrics, loop, keepsRings)) return true;
    }
    return false;
}

void collapseLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, AtJoints atJoints, int mostPercent,
                   Interrupter* interrupter)
{
    LoopDecimator(surface, table, atJoints).run(quads, mostPercent, interrupter);
}

} // namespace vdbcage::detail
