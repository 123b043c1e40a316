// The operators of smooth.h, decimate.h and tighten.h that work under a guard, put together from sweeps and collapses.

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/bounding/detail/collapse.h>
#include <vdbcage/bounding/detail/redistribute.h>
#include <vdbcage/bounding/detail/quad_pairing.h>
#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/geometry/quad_shape.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/surface/triquad.h>

namespace vdbcage {

namespace {

using Quads = detail::GuardedMesh::Quads;

void requireCount(const std::string& name, int value, int least = 0)
{
    if (value >= least && value <= 100) return;
    throw InputError(name + ": " + std::to_string(value) + " is not allowed; it must be " + std::to_string(least) +
                     " to 100");
}

void requireValid(const TightenOptions& options)
{
    requireCount("sweeps", options.sweeps);
    requireCount("perturbations", options.perturbations);
    requireCount("samples", options.samples, 1);
}

void requireFaces(std::size_t faces)
{
    if (faces >= 4) return;
    throw InputError("faces: " + std::to_string(faces) + " is not allowed; a closed surface has at least 4");
}

void tightenAndPerturb(detail::GuardedMesh& surface, const TightenOptions& options, Interrupter* interrupter)
{
    const auto perSample = [&] { return detail::areaPerSample(surface, surface.liveFaces(), options.samples); };
    detail::tighten(surface, options.sweeps, perSample(), interrupter);
    detail::perturb(surface, options.perturbations, options.sweeps, perSample(), interrupter);
    if (options.perturbations > 0) detail::relaxFinally(surface, perSample(), interrupter);
}

/// Pairs up the triangles of a surface in rounds, until enough are quads.
void makeQuads(detail::GuardedMesh& surface, const BoundingTriquadOptions& options, Interrupter* interrupter)
{
    constexpr int rounds = 6;
    constexpr int sweepsBefore = 4;
    double room = 0;
    double loss = 1; // what a change may cost: the costly ones only where the others do not suffice
    for (int round = 0; round < rounds; ++round) {
        detail::tighten(surface, sweepsBefore,
                        detail::areaPerSample(surface, surface.liveFaces(), options.tightening.samples), interrupter);
        // The other diagonals need about as much room as the first ones have; it is made before pairing, since quads
        // hold their vertices. Then only what is still triangles gets more.
        if (round == 0) room = detail::medianDistance(surface);
        detail::inflateTriangles(surface, room, interrupter);
        detail::PairingOptions pairing{};
        pairing.mergeAngleDegrees = options.mergeAngleDegrees;
        pairing.share = options.quads;
        pairing.reach = static_cast<std::size_t>(round) + 2;
        pairing.mostLoss = loss;
        pairing.collapses = round > 0;
        pairing.splits = round > 0;
        detail::pairUp(surface, pairing, interrupter);
        if (detail::quadShare(surface) >= options.quads) return;
        room *= 2;
        loss *= 2;
    }
}

} // namespace

Mesh smooth(const Mesh& surface, const BoundingGuard& guard, int sweeps, Interrupter* interrupter)
{
    requireCount("sweeps", sweeps);
    detail::GuardedMesh guarded(surface, guard.model(), Quads::keep);
    detail::roundOff(guarded, sweeps, interrupter);
    return guarded.mesh();
}

class GuardedDecimation::Impl {
public:
    explicit Impl(detail::GuardedMesh start) : copies_(start.copies()), sequence_(std::move(start)) {}

    Mesh to(std::size_t allFaces, Effort effort, Interrupter* interrupter)
    {
        const double stop = effort == Effort::fast ? 2.5 : 3; // times the faces
        constexpr int sweepsAtStop = 2;
        requireFaces(allFaces);
        const std::size_t faces = allFaces / copies_;
        const int samples = tightenOptions(effort).samples;
        // Quadrics know the surface that they were made from: one that was pulled onto the model on the way is better.
        const auto facesAtStop = static_cast<std::size_t>(stop * static_cast<double>(faces));
        detail::GuardedMesh guarded = sequence_.at(facesAtStop, interrupter);
        detail::tighten(guarded, sweepsAtStop, detail::areaPerSample(guarded, 2 * faces, samples), interrupter);
        detail::collapseByQuadrics(guarded, faces, interrupter);
        // Where the model is in the way of every collapse, there is room farther out (the model's longest side is 1 to
        // 2).
        for (double push = 0.02; guarded.liveFaces() > faces && push < 1; push *= 2) {
            detail::inflate(guarded, push, interrupter);
            detail::collapseByQuadrics(guarded, faces, interrupter);
        }
        if (effort == Effort::fair) {
            detail::tighten(guarded, 2, detail::areaPerSample(guarded, faces, samples), interrupter);
            detail::redistribute(guarded, 2, 3, interrupter);
        } else if (effort == Effort::best) {
            redistributeAndPerturb(guarded, interrupter);
        }
        return guarded.mesh();
    }

private:
    /// Redistributions end where none is better on the whole; a surface that was perturbed has others that are.
    static void redistributeAndPerturb(detail::GuardedMesh& surface, Interrupter* interrupter)
    {
        constexpr int turns = 2, firstRounds = 3, rounds = 2, perturbations = 2, redistributeSweeps = 6;
        const TightenOptions tightening = tightenOptions(Effort::best);
        const double perSample = detail::areaPerSample(surface, surface.liveFaces(), tightening.samples);
        detail::tighten(surface, tightening.sweeps, perSample, interrupter);
        detail::redistribute(surface, firstRounds, redistributeSweeps, interrupter);
        detail::flipEdges(surface, redistributeSweeps, interrupter);
        for (int i = 0; i < turns; ++i) {
            detail::perturb(surface, perturbations, tightening.sweeps, perSample, interrupter);
            detail::redistribute(surface, rounds, redistributeSweeps, interrupter);
            detail::flipEdges(surface, redistributeSweeps, interrupter);
        }
    }

    const std::size_t copies_;
    detail::CollapseSequence sequence_;
};

GuardedDecimation::GuardedDecimation(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter)
{
    detail::GuardedMesh guarded(surface, guard.model(), Quads::split);
    detail::shrink(guarded, interrupter);
    impl_ = std::make_unique<Impl>(std::move(guarded));
}
GuardedDecimation::~GuardedDecimation() = default;
GuardedDecimation::GuardedDecimation(GuardedDecimation&&) noexcept = default;
GuardedDecimation& GuardedDecimation::operator=(GuardedDecimation&&) noexcept = default;

Mesh GuardedDecimation::to(const DecimateOptions& options, Effort effort, Interrupter* interrupter)
{
    return impl_->to(options.faces, effort, interrupter);
}

Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const DecimateOptions& options, Effort effort,
              Interrupter* interrupter)
{
    requireFaces(options.faces);
    return GuardedDecimation(surface, guard, interrupter).to(options, effort, interrupter);
}

TightenOptions tightenOptions(Effort effort)
{
    TightenOptions options;
    if (effort == Effort::fast) options.samples = 3;
    if (effort == Effort::fair) options.perturbations = 1;
    if (effort == Effort::best) {
        options.perturbations = 2;
        options.samples = 12;
    }
    return options;
}

Mesh tighten(const Mesh& cage, const BoundingGuard& guard, const TightenOptions& options, Interrupter* interrupter)
{
    requireValid(options);
    detail::GuardedMesh guarded(cage, guard.model(), Quads::keep);
    if (guarded.liveFaces() == 0) return guarded.mesh();
    tightenAndPerturb(guarded, options, interrupter);
    return guarded.mesh();
}

Mesh triquad(const Mesh& surface, const BoundingGuard& guard, const BoundingTriquadOptions& options,
             Interrupter* interrupter)
{
    constexpr int attempts = 8;
    constexpr double aim = 0.99, goodEnough = 0.97; // of the faces
    requireFaces(options.faces);
    detail::requireMergeAngle(options.mergeAngleDegrees);
    if (!(options.quads >= 0 && options.quads <= 1)) {
        throw InputError("quads: " + std::to_string(options.quads) + " is not allowed; it must be 0 to 1");
    }
    requireValid(options.tightening);
    const detail::GuardedMesh fine(surface, guard.model(), Quads::split);
    if (fine.liveFaces() == 0) return fine.mesh();

    // How many triangles become the faces wanted shows when they are paired; `low` of them do not become too many.
    const std::size_t most = options.faces / fine.copies();
    const auto wanted = static_cast<double>(most);
    double low = wanted, high = std::max(wanted, static_cast<double>(fine.liveFaces()));
    double target = std::min((1 + options.quads) * wanted, high);
    std::optional<detail::GuardedMesh> best;
    double reached = 0; // faces, counted as fewer where they have too few quads
    for (int i = 0; i < attempts; ++i) {
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
        if (isEnough || (faces <= wanted && counted > reached)) {
            best = std::move(paired);
            reached = counted;
        }
        if (isEnough || high - low < 2) break;
        // Where strips are split for want of pairs, faces are many of few triangles, too: longer steps until some fit.
        target *= std::pow(aim * wanted / faces, best ? 1 : i + 1);
        if (!(target > low && target < high)) target = 0.5 * (low + high);
    }
    if (!best) {
        best = fine;
        detail::collapseByQuadrics(*best, most, interrupter);
    }
    tightenAndPerturb(*best, options.tightening, interrupter);
    return best->mesh();
}

} // namespace vdbcage
