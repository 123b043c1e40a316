#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// A mesh without its small parts. A part is what hangs together over points; points in the same place are one.
struct LargeParts {
    Mesh mesh;                    ///< the other faces, in their order, and all points that these or no face used
    double leastSide = 0;         ///< longest side that the box of a part has at least, world units
    std::size_t partsLeftOut = 0; ///< how many parts are not in it
    std::size_t facesLeftOut = 0; ///< the triangles and quads of these
};

/// Returns the longest side of the box of a mesh's largest part, world units.
/// \pre as largeParts()
/// Cost: as largeParts().
VDBCAGE_API double largestPart(const Mesh& mesh);

/// Leaves out the parts of `mesh` whose boxes have a longest side below `leastPart`, 0 to 1, times that of the largest.
/// \pre the points of faces are finite
/// Cost: O(n log n) for n points.
VDBCAGE_API LargeParts largeParts(const Mesh& mesh, double leastPart);

/// Leaves out the parts of `mesh` whose boxes have a longest side below `leastSide`, world units: maybe all.
/// \pre the points of faces are finite
/// Cost: as largeParts().
VDBCAGE_API LargeParts partsFrom(const Mesh& mesh, double leastSide);

} // namespace vdbcage
