// The operators of smooth.h, decimate.h and tighten.h that work under a guard, put together from sweeps and collapses.

#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/detail/guarded_decimate.h>
#include <vdbcage/surface/detail/guarded_sweeps.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/tighten.h>

namespace vdbcage {

namespace {

constexpr double samplesPerFace = 16; // of the distance to the model, where vertices are tightened

void requireSweeps(int sweeps)
{
    if (sweeps >= 0 && sweeps <= 100) return;
    throw InputError("sweeps: " + std::to_string(sweeps) + " is not allowed; it must be 0 to 100");
}

double areaPerSample(const detail::GuardedSurface& surface, std::size_t faces)
{
    return detail::area(surface) / (samplesPerFace * static_cast<double>(faces));
}

} // namespace

Mesh smooth(const Mesh& surface, const BoundingGuard& guard, int sweeps, Interrupter* interrupter)
{
    requireSweeps(sweeps);
    detail::GuardedSurface guarded(surface, guard.model());
    detail::roundOff(guarded, sweeps, interrupter);
    return guarded.mesh();
}

Mesh decimate(const Mesh& surface, const BoundingGuard& guard, const DecimateOptions& options, Effort effort,
              Interrupter* interrupter)
{
    constexpr std::size_t measuredFrom = 4; // times the faces asked for: quadrics do as well above
    if (options.faces < 4) {
        throw InputError("faces: " + std::to_string(options.faces) +
                         " is not allowed; a closed surface has at least 4");
    }
    detail::GuardedSurface guarded(surface, guard.model());
    detail::shrink(guarded, interrupter);
    if (effort == Effort::fast) {
        detail::collapseByQuadrics(guarded, options.faces, interrupter);
        return guarded.mesh();
    }
    detail::collapseByQuadrics(guarded, measuredFrom * options.faces, interrupter);
    detail::tighten(guarded, 3, areaPerSample(guarded, 2 * options.faces), interrupter);
    detail::collapseByMeasure(guarded, options.faces, effort == Effort::best, interrupter);
    return guarded.mesh();
}

Mesh tighten(const Mesh& cage, const BoundingGuard& guard, const TightenOptions& options, Interrupter* interrupter)
{
    requireSweeps(options.sweeps);
    detail::GuardedSurface guarded(cage, guard.model());
    if (guarded.liveFaces() == 0) return guarded.mesh();
    detail::tighten(guarded, options.sweeps, areaPerSample(guarded, guarded.liveFaces()), interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
