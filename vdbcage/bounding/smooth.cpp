#include <vdbcage/bounding/smooth.h>

#include <vdbcage/bounding/detail/relax.h>
#include <vdbcage/bounding/detail/tightening.h>

namespace vdbcage {

Mesh smooth(const Mesh& surface, const BoundingGuard& guard, const BoundingSmoothOptions& options,
            Interrupter* interrupter)
{
    detail::requireCount("sweeps", options.sweeps);
    detail::GuardedMesh guarded(surface, guard.model(), detail::GuardedMesh::Quads::keep);
    detail::roundOff(guarded, options.sweeps, interrupter);
    return guarded.mesh();
}

} // namespace vdbcage
