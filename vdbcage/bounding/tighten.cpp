#include <vdbcage/bounding/tighten.h>

#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/tightening.h>
#include <vdbcage/core/detail/stage_parts.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace detail {

void requireFaces(std::size_t faces)
{
    if (faces >= 4) return;
    throw InputError("faces", std::to_string(faces) + " is not allowed; a closed surface has at least 4");
}

void requireValid(const TightenOptions& options)
{
    requireWithin(TightenOptions::sweepCounts, options.sweeps, "sweeps");
    requireWithin(TightenOptions::perturbationCounts, options.perturbations, "perturbations");
    requireWithin(TightenOptions::sampleCounts, options.samples, "samples");
}

double meanDistance(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter)
{
    constexpr int samples = 8;
    const GuardedMesh surface(cage, modelOf(guard), GuardedMesh::Quads::split, wishes);
    const double perSample = areaPerSample(surface, surface.liveFaces(), samples);
    return integratedDistance(surface, perSample, interrupter) / area(surface);
}

void tightenAndPerturb(GuardedMesh& surface, const TightenOptions& options, Interrupter* interrupter,
                       const ShapeTerm* shape)
{
    const auto perSample = [&] { return areaPerSample(surface, surface.liveFaces(), options.samples); };
    const int tightened = 100 / (1 + 2 * options.perturbations); // percent: a perturbation is tightened twice
    tighten(surface, options.sweeps, perSample(), interrupter, shape);
    StagePart perturbing(interrupter, tightened, 100);
    perturb(surface, options.perturbations, options.sweeps, perSample(), perturbing.passedOn(), shape);
    if (options.perturbations > 0) relaxFinally(surface, perSample(), interrupter, shape);
}

} // namespace detail

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

Mesh tighten(const Mesh& cage, const BoundingGuard& guard, const TightenOptions& options, const FaceWishes& wishes,
             Interrupter* interrupter)
{
    detail::requireValid(options);
    detail::GuardedMesh guarded(cage, detail::modelOf(guard), detail::GuardedMesh::Quads::keep, wishes);
    if (guarded.liveFaces() == 0) return guarded.mesh();
    detail::tightenAndPerturb(guarded, options, interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
