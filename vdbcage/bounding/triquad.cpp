#include <vdbcage/bounding/triquad.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <vdbcage/bounding/detail/quads/pairing/quad_pairing.h>
#include <vdbcage/bounding/detail/quads/quad_cleanup.h>
#include <vdbcage/bounding/detail/quads/quad_making.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/bounding/detail/triangles/collapse.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/detail/stage_parts.h>

namespace vdbcage {

namespace {

/// Pairs the triangles of a surface in rounds, until enough are quads.
void makeQuads(detail::GuardedMesh& surface, const BoundingTriquadOptions& options, Interrupter* interrupter)
{
    constexpr int rounds = 6;
    constexpr int sweepsBefore = 4;
    double room = 0;
    double loss = 1; // allowed for a change: costly ones are made only where the others are not enough
    for (int round = 0; round < rounds; ++round) {
        detail::tighten(surface, sweepsBefore,
                        detail::areaPerSample(surface, surface.liveFaces(), options.tightening.samples), interrupter);
        // The other diagonals need about as much room as the first ones have. It is made before pairing, since quads
        // hold their vertices. Then only the remaining triangles get more.
        if (round == 0) room = detail::medianDistance(surface);
        detail::inflateTriangles(surface, room, interrupter);
        detail::PairingOptions pairing{};
        pairing.mergeAngleDegrees = options.mergeAngleDegrees;
        pairing.share = options.quads;
        pairing.maxPathPairs = static_cast<std::size_t>(round) + 2;
        pairing.maxLoss = loss;
        pairing.collapses = round > 0;
        pairing.splits = round > 0;
        detail::pairUp(surface, pairing, interrupter);
        if (detail::quadShare(surface) >= options.quads) return;
        room *= 2;
        loss *= 2;
    }
}

/// Cleans up the quads of a paired surface. Returns whether as large a share of its faces as before, or `share`, are
/// quads again, and there are at most `faces` faces.
bool cleanUpPairs(detail::GuardedMesh& surface, std::size_t faces, double share, Interrupter* interrupter)
{
    constexpr int sweepsBefore = 6, attempts = 3;
    share = std::min(share, detail::quadShare(surface));
    detail::QuadTable table = detail::QuadTable::ofPairs(surface);
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (surface.isFace(f) && surface.isInQuad(f)) surface.splitQuad(f);
    }
    detail::relaxQuads(surface, table, sweepsBefore, interrupter);
    std::size_t room = faces;
    for (int i = 0; i < attempts; ++i) {
        detail::cleanUp(surface, table, room, interrupter);
        std::size_t count = 0;
        for (const auto pair : {detail::makeQuadsInPlace, detail::makeQuads}) {
            detail::GuardedMesh paired = surface;
            pair(paired, table, interrupter);
            count = paired.liveFaces() - paired.quads();
            if (count <= faces && detail::quadShare(paired) >= share) {
                surface = std::move(paired);
                return true;
            }
        }
        // Quads that could not be paired are two faces each.
        const std::size_t less = count > faces ? count - faces : 1;
        if (room <= less) return false;
        room -= less;
    }
    return false;
}

/// The tightening of a paired surface so that corners of quads become square, more so for a `shape` nearer to 1.
class SquareTightening {
public:
    SquareTightening(double shape, const TightenOptions& options, Interrupter* interrupter)
        : shape_(shape), options_(options), interrupter_(interrupter)
    {
    }

    /// Makes the first sweeps, in the room that pairing took. Returns the integral of the distance that is left.
    double begin(detail::GuardedMesh& surface) const
    {
        constexpr int sweeps = 6;
        constexpr double share = 0.5; // weights are parts of the distance, which room for pairing has about doubled
        const double sample = samplesOf(surface);
        const detail::QuadTable table = detail::QuadTable::ofPairs(surface);
        const detail::QuadShapeTerm term = termOf(surface, table, share);
        detail::tighten(surface, sweeps, sample, interrupter_, &term);
        return detail::integratedDistance(surface, sample, interrupter_);
    }

    /// Tightens. `interrupter` is of this part of the stage.
    void finish(detail::GuardedMesh& surface, Interrupter* interrupter) const
    {
        const detail::QuadTable table = detail::QuadTable::ofPairs(surface);
        const detail::QuadShapeTerm term = termOf(surface, table, 1);
        detail::tightenAndPerturb(surface, options_, interrupter, &term);
    }

private:
    double samplesOf(const detail::GuardedMesh& surface) const
    {
        return detail::areaPerSample(surface, surface.liveFaces(), options_.samples);
    }
    detail::QuadShapeTerm termOf(const detail::GuardedMesh& surface, const detail::QuadTable& table, double share) const
    {
        constexpr double usualCorners = 0.35, usualBad = 4, free = 0.15, range = 8;
        const double weight = share * std::pow(range, 2 * shape_ - 1);
        return detail::shapeTerm(surface, table, {weight * usualCorners, free, weight * usualBad, 0, 0},
                                 samplesOf(surface), interrupter_);
    }

    double shape_;
    const TightenOptions& options_;
    Interrupter* interrupter_;
};

} // namespace

Mesh triquad(const Mesh& surface, const BoundingGuard& guard, const BoundingTriquadOptions& options,
             const FaceWishes& wishes, Interrupter* interrupter)
{
    constexpr int attempts = 8;
    constexpr double aim = 0.99, goodEnough = 0.97;        // of the faces
    constexpr int attempt = 8, cleanedUp = 70, begun = 75; // percent of the time, about; few attempts are usual
    detail::requireFaces(options.faces);
    requireWithin(BoundingTriquadOptions::mergeAngles, options.mergeAngleDegrees, "merge angle");
    requireWithin(BoundingTriquadOptions::quadShares, options.quads, "quads");
    requireWithin(BoundingTriquadOptions::quadShapes, options.quadShape, "quad shape");
    detail::requireValid(options.tightening);
    const detail::GuardedMesh fine(surface, detail::modelOf(guard), detail::GuardedMesh::Quads::split, wishes);
    if (fine.liveFaces() == 0) return fine.mesh();

    // The number of triangles that become the wanted faces is known only after pairing; `low` of them do not become too
    // many.
    const std::size_t most = options.faces / fine.copies();
    const auto wanted = static_cast<double>(most);
    double low = wanted, high = std::max(wanted, static_cast<double>(fine.liveFaces()));
    double target = std::min((1 + options.quads) * wanted, high);
    std::optional<detail::GuardedMesh> best;
    double bestCount = 0; // faces, counted as fewer where they have too few quads
    for (int i = 0; i < attempts; ++i) {
        throwIfInterrupted(interrupter, i * attempt);
        detail::GuardedMesh paired = fine;
        const auto triangles = static_cast<std::size_t>(target);
        detail::collapseByQuadrics(paired, triangles, interrupter);
        makeQuads(paired, options, interrupter);
        const auto faces = static_cast<double>(paired.liveFaces() - paired.quads());
        const double share = detail::quadShare(paired);
        const double part = share < options.quads ? share / options.quads : 1; // of the share asked
        const double counted = faces * part * part;
        (faces <= wanted ? low : high) = target;
        const bool isEnough = faces <= wanted && faces >= goodEnough * wanted && share >= options.quads;
        if (isEnough || (faces <= wanted && counted > bestCount)) {
            best = std::move(paired);
            bestCount = counted;
        }
        if (isEnough || high - low < 2) break;
        // Where polychords are split for lack of pairs, few triangles become many faces, too: steps get longer until
        // some number fits.
        target *= std::pow(aim * wanted / faces, best ? 1 : i + 1);
        if (!(target > low && target < high)) target = 0.5 * (low + high);
    }
    if (!best) {
        best = fine;
        detail::collapseByQuadrics(*best, most, interrupter);
    }
    if (options.quadShape == 0 || best->quads() == 0) {
        detail::StagePart tightening(interrupter, cleanedUp, 100);
        detail::tightenAndPerturb(*best, options.tightening, tightening.passedOn());
        return best->mesh();
    }
    constexpr double mostLoss = 1.2; // allowed for a clean-up: the distance over that without it, before tightening
    const SquareTightening square(options.quadShape, options.tightening, interrupter);
    detail::GuardedMesh cleaned = *best;
    const bool isClean = cleanUpPairs(cleaned, most, options.quads, interrupter);
    throwIfInterrupted(interrupter, cleanedUp);
    const double before = square.begin(*best);
    if (isClean && square.begin(cleaned) <= mostLoss * before) best = std::move(cleaned);
    detail::StagePart tightening(interrupter, begun, 100);
    square.finish(*best, tightening.passedOn());
    return best->mesh();
}

} // namespace vdbcage
