#pragma once

#include <vdbcage/core/export.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The options of triquad() without a guard.
struct TriquadOptions {
    static constexpr Range mergeAngles{0, 180}; ///< of `mergeAngleDegrees`

    double mergeAngleDegrees = 10; ///< largest angle between the normals of two triangles that become a quad
};

/// Merges pairs of triangles into quads, flattest and squarest pairs first.
///
/// Quads are convex under both diagonals, with no corner above 160 degrees. No two faces come to share two edges. No
/// inner point is left with fewer than three faces. The merged edge runs from a quad's corner 0 to corner 2. Points
/// keep their order; quads of the input stay and come first. Edges that are not between two faces in opposite
/// directions are left alone.
/// \param triangles any polygon soup
/// \param options all in range
/// \throw InputError when an angle is out of range, or requireUsable() refuses the mesh
/// Cost: O(n log n).
VDBCAGE_API Mesh triquad(const Mesh& triangles, const TriquadOptions& options = {});

} // namespace vdbcage
