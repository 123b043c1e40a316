#include <vdbcage/bounding/decimate.h>

#include <vdbcage/bounding/detail/recorded_decimation.h>
#include <vdbcage/bounding/detail/redistribute.h>
#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/bounding/detail/tightening.h>

namespace vdbcage {

namespace detail {

namespace {

GuardedMesh shrunk(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter)
{
    GuardedMesh guarded(surface, detail::modelOf(guard), GuardedMesh::Quads::split);
    shrink(guarded, interrupter);
    return guarded;
}

/// Redistributions end where none is better on the whole; a surface that was perturbed has others that are.
void redistributeAndPerturb(GuardedMesh& surface, Interrupter* interrupter)
{
    constexpr int turns = 2, firstRounds = 3, rounds = 2, perturbations = 2, redistributeSweeps = 6;
    const TightenOptions tightening = tightenOptions(Effort::best);
    const double perSample = areaPerSample(surface, surface.liveFaces(), tightening.samples);
    tighten(surface, tightening.sweeps, perSample, interrupter);
    redistribute(surface, firstRounds, redistributeSweeps, interrupter);
    flipEdges(surface, redistributeSweeps, interrupter);
    for (int i = 0; i < turns; ++i) {
        perturb(surface, perturbations, tightening.sweeps, perSample, interrupter);
        redistribute(surface, rounds, redistributeSweeps, interrupter);
        flipEdges(surface, redistributeSweeps, interrupter);
    }
}

} // namespace

RecordedDecimation::RecordedDecimation(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter)
    : copies_(guard.symmetry() ? 2 : 1), sequence_(shrunk(surface, guard, interrupter))
{
}

Mesh RecordedDecimation::to(const BoundingDecimateOptions& options, Interrupter* interrupter)
{
    const Effort effort = options.effort;
    const double stop = effort == Effort::fast ? 2.5 : 3; // times the faces
    constexpr int sweepsAtStop = 2;
    requireFaces(options.faces);
    const std::size_t faces = options.faces / copies_;
    const int samples = tightenOptions(effort).samples;
    // Quadrics know the surface that they were made from: one that was pulled onto the model on the way is better.
    const auto facesAtStop = static_cast<std::size_t>(stop * static_cast<double>(faces));
    GuardedMesh guarded = sequence_.at(facesAtStop, interrupter);
    tighten(guarded, sweepsAtStop, areaPerSample(guarded, 2 * faces, samples), interrupter);
    collapseByQuadrics(guarded, faces, interrupter);
    // Where the model is in the way of every collapse, there is room farther out (the model's
    // longest side is 1 to 2).
    for (double push = 0.02; guarded.liveFaces() > faces && push < 1; push *= 2) {
        inflate(guarded, push, interrupter);
        collapseByQuadrics(guarded, faces, interrupter);
    }
    if (effort == Effort::fair) {
        tighten(guarded, 2, areaPerSample(guarded, faces, samples), interrupter);
        redistribute(guarded, 2, 3, interrupter);
    } else if (effort == Effort::best) {
        redistributeAndPerturb(guarded, interrupter);
    }
    return guarded.mesh();
}

} // namespace detail

Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const BoundingDecimateOptions& options,
              Interrupter* interrupter)
{
    detail::requireFaces(options.faces);
    return detail::RecordedDecimation(surface, guard, interrupter).to(options, interrupter);
}

} // namespace vdbcage
