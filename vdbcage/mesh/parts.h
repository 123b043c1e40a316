#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// A mesh without its small parts. A part is a set of faces that hang together over points; points in the same place
/// are one.
struct LargeParts {
    Mesh mesh;                    ///< the other faces, in their order, and all points that these or no face used
    double leastSide = 0;         ///< least longest side of a part's box, world units
    std::size_t partsLeftOut = 0; ///< parts that are not in `mesh`
    std::size_t facesLeftOut = 0; ///< triangles and quads of these parts
};

/// Returns the longest side of the box of a mesh's largest part, world units; 0 without faces.
/// \param mesh any polygon soup
/// \pre the points of faces are finite
/// Cost: as largeParts().
VDBCAGE_API double largestPart(const Mesh& mesh);

/// Returns a mesh without the parts whose boxes have a longest side below a fraction of the largest part's.
/// \param mesh any polygon soup
/// \param leastPart that fraction, 0 to 1
/// \pre the points of faces are finite
/// Cost: O(n log n) for n points.
VDBCAGE_API LargeParts largeParts(const Mesh& mesh, double leastPart);

/// Returns a mesh without the parts whose boxes have a longest side below a length: maybe without all of them.
/// \param mesh any polygon soup
/// \param leastSide that length, world units
/// \pre the points of faces are finite
/// Cost: as largeParts().
VDBCAGE_API LargeParts partsFrom(const Mesh& mesh, double leastSide);

} // namespace vdbcage
