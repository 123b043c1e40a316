#include <vdbcage/bounding/smooth.h>

#include <vdbcage/bounding/detail/triangles/relax.h>

namespace vdbcage {

Mesh smooth(const Mesh& surface, const BoundingGuard& guard, const BoundingSmoothOptions& options,
            Interrupter* interrupter)
{
    requireWithin(BoundingSmoothOptions::sweepCounts, options.sweeps, "sweeps");
    detail::GuardedMesh guarded(surface, detail::modelOf(guard), detail::GuardedMesh::Quads::keep);
    detail::roundOff(guarded, options.sweeps, interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
