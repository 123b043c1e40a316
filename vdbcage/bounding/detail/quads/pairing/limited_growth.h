#pragma once

#include <functional>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

/// Changes that may move a surface away from the model, but not far.
namespace vdbcage::detail {

/// The volume that a surface encloses, with its other half where there is a plane of symmetry. Quads count as the mean
/// over both diagonals.
double enclosedVolume(const GuardedMesh& surface);

/// Asks for a change of the surface, which returns whether it is done. Undoes it if not, or if the enclosed volume grew
/// by more than `maxGrowth`. Returns whether it stays.
/// Cost: O(faces), for a copy to go back to.
bool changeWithin(GuardedMesh& surface, double maxGrowth, const std::function<bool()>& change);

} // namespace vdbcage::detail
