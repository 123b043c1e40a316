#pragma once

#include <functional>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

/// Changes that may move a surface away from the model, within a limit.
namespace vdbcage::detail {

/// Returns the volume that a surface encloses, with its other half where there is a plane of symmetry. Quads count as
/// the mean over both diagonals.
double enclosedVolume(const GuardedMesh& surface);

/// Calls `change`, which returns whether it changed the surface as intended. Undoes the change if not, or if the
/// enclosed volume grew by more than `maxGrowth`. Returns whether the change stays.
/// Cost: O(faces), for a copy to go back to.
bool changeWithin(GuardedMesh& surface, double maxGrowth, const std::function<bool()>& change);

} // namespace vdbcage::detail
