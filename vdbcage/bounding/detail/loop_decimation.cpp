// Based on: Daniels, Silva, Shepherd, Cohen, "Quadrilateral Mesh Simplification", 2008 (polychords collapse, cheapest
//           first, until few enough quads are left).
// Differs: every rung is a collapse under the guard, the loss of distance of a loop is measured and bounded, and
// vertices are moved in between.

#include <vdbcage/bounding/detail/loop_decimation.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include <vdbcage/bounding/detail/loop_collapse.h>
#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

constexpr int samplesPerTriangle = 2; // of the distance

double perSample(const GuardedMesh& surface)
{
    return areaPerSample(surface, surface.liveFaces(), samplesPerTriangle);
}

class LoopDecimator {
public:
    LoopDecimator(GuardedMesh& surface, QuadTable& table) : surface_(surface), table_(table) {}

    void run(std::size_t quads, Interrupter* interrupter)
    {
        constexpr double relaxAfter = 0.75; // of the quads
        constexpr int relaxSweeps = 3;
        constexpr ShapeWeight shape{0.35, 0.15};
        constexpr int mostPushes = 3;
        int pushes = 0;
        double maxLoss = firstLoss;
        while (table_.count() > quads) {
            relaxQuads(surface_, table_, shape, relaxSweeps, interrupter);
            VertexQuadrics quadrics(surface_);
            const auto relaxAt =
                std::max(quads, static_cast<std::size_t>(relaxAfter * static_cast<double>(table_.count())));
            const std::size_t before = table_.count();
            while (table_.count() > relaxAt && collapseRound(quadrics, relaxAt, maxLoss, interrupter)) {
            }
            if (table_.count() < before) continue;
            if (maxLoss < lastLoss) {
                maxLoss *= 3;
            } else if (pushes < mostPushes) {
                inflate(surface_, 0.02 * (1 << pushes++), interrupter); // there is room farther out
            } else {
                return;
            }
        }
    }

private:
    static constexpr double firstLoss = 4, lastLoss = 100; // of distance for a quad less, in parts of a mean quad's

    struct Ranked {
        double cost;
        std::size_t loop;
    };

    /// Collapses loops that do not touch, until `quads` or a tenth are left out. Returns whether any went.
    bool collapseRound(VertexQuadrics& quadrics, std::size_t quads, double maxLoss, Interrupter* interrupter)
    {
        throwIfInterrupted(interrupter);
        const std::vector<QuadLoop> loops = straightLoops(table_);
        std::vector<Ranked> ranking(loops.size());
        parallelFor(std::size_t(0), loops.size(), [&](std::size_t i) {
            ranking[i] = {collapseCost(quadrics, loops[i]) / static_cast<double>(loops[i].quads.size()), i};
        });
        std::sort(ranking.begin(), ranking.end(),
                  [](const Ranked& a, const Ranked& b) { return std::tie(a.cost, a.loop) < std::tie(b.cost, b.loop); });
        const double sample = perSample(surface_);
        const double perQuad = integratedDistance(surface_, sample) / static_cast<double>(table_.count());
        const DistanceMeasure measure(surface_.guard(), sample);
        const std::size_t most = table_.count() / 20;
        std::size_t removed = 0;
        std::vector<char> isTouched(surface_.vertices(), 0);
        for (const Ranked& next : ranking) {
            const QuadLoop& loop = loops[next.loop];
            if (table_.count() <= quads || (removed > 0 && removed + loop.quads.size() > most)) break;
            if (touches(loop, isTouched) || !leavesQuads(surface_, table_, loop)) continue;
            throwIfInterrupted(interrupter);
            const double before = distanceAround(measure, loop);
            const double limit = maxLoss * perQuad * static_cast<double>(loop.quads.size());
            const bool isDone = collapseLoop(surface_, table_, quadrics, loop,
                                             [&] { return distanceAround(measure, loop) - before <= limit; });
            if (!isDone) continue;
            removed += loop.quads.size();
            touch(loop, isTouched);
        }
        return removed > 0;
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

    /// The integral over the faces around the rungs.
    double distanceAround(const DistanceMeasure& measure, const QuadLoop& loop) const
    {
        std::vector<std::uint32_t> faces;
        for (const Rung& rung : loop.rungs) {
            for (const std::uint32_t v : rung) {
                const auto& around = surface_.facesOf(v);
                faces.insert(faces.end(), around.begin(), around.end());
            }
        }
        std::sort(faces.begin(), faces.end());
        faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
        double sum = 0;
        std::uint32_t seed = TriangleBvh::none;
        for (const std::uint32_t f : faces) sum += measure.integral(surface_.corners(f), seed);
        return sum;
    }

    GuardedMesh& surface_;
    QuadTable& table_;
};

} // namespace

void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeight& shape, int sweeps,
                Interrupter* interrupter)
{
    const double sample = perSample(surface);
    const double perQuad = integratedDistance(surface, sample) / static_cast<double>(table.count());
    const CornerShape corners(table, shape.share * perQuad, shape.free);
    tighten(surface, sweeps, sample, interrupter, &corners);
}

void collapseLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, Interrupter* interrupter)
{
    LoopDecimator(surface, table).run(quads, interrupter);
}

} // namespace vdbcage::detail
