#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// What repair() did and what it could not do.
struct RepairReport {
    std::size_t mergedPoints = 0;            ///< points that lay on another one
    std::size_t removedFaces = 0;            ///< degenerate and duplicate faces taken out
    std::size_t splitVertices = 0;           ///< non-manifold vertices duplicated
    std::size_t stitchedEdges = 0;           ///< pairs of boundary edges joined
    std::size_t filledHoles = 0;             ///< boundary loops closed
    std::size_t unfilledHoles = 0;           ///< boundary loops that could not be closed
    std::size_t selfIntersectionsBefore = 0; ///< pairs of faces that met before the removal
    std::size_t selfIntersectionsAfter = 0;  ///< pairs of faces that still meet
    bool reoriented = false;                 ///< some faces were turned to face outward
};

/// Whether this build has repair(): it was made with VDBCAGE_WITH_CGAL_GPL.
VDBCAGE_API bool hasRepair();

/// Mends a cage made elsewhere: merges coincident points, removes degenerate and duplicate faces, orients, stitches,
/// fills holes and removes self-intersections, by CGAL's Polygon_mesh_processing. The result is triangles, closed and
/// outward where that could be reached; `report`, if not null, says what was done and what was not.
/// Only in builds with VDBCAGE_WITH_CGAL_GPL (GPL when distributed).
/// \throw InputError (no usable face; a build without it), Cancelled
VDBCAGE_API Mesh repair(const Mesh& cage, RepairReport* report = nullptr, Interrupter* interrupter = nullptr);

} // namespace vdbcage
