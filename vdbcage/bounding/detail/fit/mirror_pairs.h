#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/geometry/triangle.h>
#include <vdbcage/mesh/symmetry.h>

namespace vdbcage::detail {

/// Returns for each point the one that is nearest to its mirror image, which may be itself.
/// \param points in any unit
/// \param vertices the numbers of points to pair; others are their own
/// \param plane in the unit of the points
/// \param tolerance the largest distance from a mirror image, more than 0
/// \throw InputError naming a point that has none within the tolerance, or shares one
/// Cost: O(n) for points that are not crowded.
std::vector<std::uint32_t> mirrorPairs(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& vertices,
                                       const SymmetryPlane& plane, double tolerance);

} // namespace vdbcage::detail
