#include <vdbcage/bounding/decimate.h>

#include <vdbcage/bounding/detail/triangles/recorded_decimation.h>
#include <vdbcage/bounding/detail/triangles/redistribute.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/detail/stage_parts.h>

namespace vdbcage {

namespace detail {

namespace {

GuardedMesh shrunk(const Mesh& surface, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter)
{
    GuardedMesh guarded(surface, detail::modelOf(guard), GuardedMesh::Quads::split, wishes);
    shrink(guarded, interrupter);
    return guarded;
}

/// Redistributes and perturbs by turns. Redistributions end where none is better on the whole; after a perturbation
/// others are.
void redistributeAndPerturb(GuardedMesh& surface, Interrupter* interrupter)
{
    constexpr int turns = 2, firstRounds = 3, rounds = 2, perturbations = 2, redistributeSweeps = 6;
    constexpr int first = 40, turn = 30; // percent
    const TightenOptions tightening = tightenOptions(Effort::best);
    const double perSample = areaPerSample(surface, surface.liveFaces(), tightening.samples);
    tighten(surface, tightening.sweeps, perSample, interrupter);
    StagePart beginning(interrupter, 10, first);
    redistribute(surface, firstRounds, redistributeSweeps, beginning.passedOn());
    flipEdges(surface, redistributeSweeps, interrupter);
    for (int i = 0; i < turns; ++i) {
        const int from = first + i * turn;
        StagePart perturbing(interrupter, from, from + turn / 2);
        perturb(surface, perturbations, tightening.sweeps, perSample, perturbing.passedOn());
        StagePart redistributing(interrupter, from + turn / 2, from + turn);
        redistribute(surface, rounds, redistributeSweeps, redistributing.passedOn());
        flipEdges(surface, redistributeSweeps, interrupter);
    }
}

/// Decimates a shrunk surface. collapsed(faces, interrupter) is that surface after collapseInBatches().
template <typename Collapsed>
Mesh decimated(const Collapsed& collapsed, std::size_t copies, const BoundingDecimateOptions& options,
               Interrupter* interrupter)
{
    const Effort effort = options.effort;
    const double stop = effort == Effort::fast ? 2.5 : 3; // times the faces
    constexpr int sweepsAtStop = 2;
    const std::size_t faces = options.faces / copies;
    const int samples = tightenOptions(effort).samples;
    // Quadrics are those of the surface from which they were made: one already pulled onto the model is better.
    const auto facesAtStop = static_cast<std::size_t>(stop * static_cast<double>(faces));
    const int share = effort == Effort::fast ? 80 : effort == Effort::fair ? 40 : 20; // percent
    StagePart collapsing(interrupter, 0, share);
    GuardedMesh guarded = collapsed(facesAtStop, collapsing.passedOn());
    tighten(guarded, sweepsAtStop, areaPerSample(guarded, 2 * faces, samples), interrupter);
    collapseByQuadrics(guarded, faces, interrupter);
    throwIfInterrupted(interrupter, share);
    // Where the model is in the way of every collapse, there is room farther out (the model's longest side is 1 to 2).
    for (double push = 0.02; guarded.liveFaces() > faces && push < 1; push *= 2) {
        inflate(guarded, push, interrupter);
        collapseByQuadrics(guarded, faces, interrupter);
    }
    if (effort == Effort::fair) {
        tighten(guarded, 2, areaPerSample(guarded, faces, samples), interrupter);
        StagePart redistributing(interrupter, 50, 100);
        redistribute(guarded, 2, 3, redistributing.passedOn());
    } else if (effort == Effort::best) {
        StagePart redistributing(interrupter, share, 100);
        redistributeAndPerturb(guarded, redistributing.passedOn());
    }
    return guarded.mesh();
}

} // namespace

RecordedDecimation::RecordedDecimation(const Mesh& surface, const BoundingGuard& guard, const FaceWishes& wishes,
                                       Interrupter* interrupter)
    : copies_(guard.symmetry() ? 2 : 1), sequence_(shrunk(surface, guard, wishes, interrupter))
{
}

Mesh RecordedDecimation::to(const BoundingDecimateOptions& options, Interrupter* interrupter)
{
    requireFaces(options.faces);
    return decimated([&](std::size_t faces, Interrupter* passedOn) { return sequence_.at(faces, passedOn); }, copies_,
                     options, interrupter);
}

} // namespace detail

Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const BoundingDecimateOptions& options,
              const FaceWishes& wishes, Interrupter* interrupter)
{
    detail::requireFaces(options.faces);
    detail::GuardedMesh start = detail::shrunk(surface, guard, wishes, interrupter);
    const std::size_t copies = start.copies();
    return detail::decimated(
        [&](std::size_t faces, Interrupter* passedOn) {
            collapseInBatches(start, faces, passedOn);
            return std::move(start);
        },
        copies, options, interrupter);
}

} // namespace vdbcage
