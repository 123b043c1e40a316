#include <vdbcage/bounding/quad_loops.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/loops/add_rings.h>
#include <vdbcage/bounding/detail/loops/loop_decimation.h>
#include <vdbcage/bounding/detail/loops/loop_exchange.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/detail/quads/quad_making.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/detail/stage_parts.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

using namespace detail;

namespace {

/// Adds the rings that joints lack, and removes as many other quads, in rounds: the round with most rings is kept.
void completeRings(GuardedMesh& surface, QuadTable& table, std::size_t quads, Interrupter* interrupter)
{
    constexpr int rounds = 4;
    const auto lacking = [](const GuardedMesh& of, const QuadTable& quadsOf) {
        std::size_t sum = 0;
        for (const std::size_t count : JointRings(of, quadsOf).count()) {
            sum += JointRings::wanted - std::min(count, JointRings::wanted);
        }
        return sum;
    };
    std::size_t least = lacking(surface, table);
    if (least == 0) return;
    GuardedMesh now = surface;
    QuadTable nowTable = table;
    for (int i = 0; i < rounds && least > 0; ++i) {
        addRings(now, nowTable, interrupter);
        collapseLoops(now, nowTable, quads, AtJoints::keepRings, 0, interrupter);
        const std::size_t left = lacking(now, nowTable);
        if (left >= least || nowTable.count() > std::max(quads, table.count())) continue;
        least = left;
        surface = now;
        table = nowTable;
    }
}

/// Tightens with the least weights of the shape for which the corners are as square as the options ask.
void tightenSquarely(GuardedMesh& surface, const QuadTable& table, const QuadLoopsOptions& options,
                     Interrupter* interrupter)
{
    constexpr double first = 0.05, firstBad = 0.2, growth = 1.7, free = 0.15;
    constexpr int rounds = 8, begun = 80; // percent of the time, about
    const TightenOptions& tightening = options.tightening;
    const double sample = areaPerSample(surface, surface.liveFaces(), tightening.samples);
    double corners = first, bad = firstBad;
    for (int round = 0; round < rounds; ++round) {
        const QuadShapeTerm shape = shapeTerm(surface, table, {corners, free, bad, 0, 0}, sample, interrupter);
        tighten(surface, tightening.sweeps, sample, interrupter, &shape);
        if (round == 0) {
            StagePart perturbing(interrupter, begun, 100);
            perturb(surface, tightening.perturbations, tightening.sweeps, sample, perturbing.passedOn(), &shape);
        }
        const CornerAngles angles = cornerAngles(surface, table);
        const bool isMean = angles.mean <= options.meanAngleDegrees,
                   isMost = angles.mostOf95 <= options.mostAngleDegrees;
        if (isMean && isMost) return;
        if (!isMean) corners *= growth;
        if (!isMost) bad *= growth * growth;
    }
}

} // namespace

Mesh quadLoops(const Mesh& surface, const BoundingGuard& guard, const QuadLoopsOptions& options,
               const FaceWishes& wishes, Interrupter* interrupter)
{
    if (options.faces < 6) {
        throw InputError("faces",
                         std::to_string(options.faces) + " is not allowed; a closed surface of quads has at least 6");
    }
    requireWithin(QuadLoopsOptions::angles, options.meanAngleDegrees, "mean angle");
    requireWithin(QuadLoopsOptions::angles, options.mostAngleDegrees, "most angle");
    requireWithin(QuadLoopsOptions::exchangeCounts, options.exchanges, "exchanges");
    requireValid(options.tightening);
    if (!surface.triangles.empty()) throw InputError("surface", "it has triangles; it must be of quads only");
    GuardedMesh guarded(surface, modelOf(guard), GuardedMesh::Quads::split, wishes);
    QuadTable table(guarded);
    if (table.count() == 0) return guarded.mesh();
    constexpr int mostPercent = 70; // the rest comes after
    const std::size_t faces = options.faces / guarded.copies();
    collapseLoops(guarded, table, faces, AtJoints::anything, mostPercent, interrupter);
    completeRings(guarded, table, faces, interrupter);
    exchangeLoops(guarded, table, faces, options.exchanges, interrupter);
    completeRings(guarded, table, faces, interrupter);
    // Loops through quads that cannot be made are collapsed.
    constexpr int attempts = 10;
    GuardedMesh paired = guarded;
    std::vector<std::uint32_t> left = makeQuads(paired, table, interrupter);
    for (int i = 0; i < attempts && !left.empty() && collapseLoopThrough(guarded, table, left, interrupter); ++i) {
        paired = guarded;
        left = makeQuads(paired, table, interrupter);
    }
    guarded = std::move(paired);
    tightenSquarely(guarded, table, options, interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
