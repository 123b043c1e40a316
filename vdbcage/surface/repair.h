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

/// What repair() returns.
struct RepairedCage {
    Mesh cage;           ///< of triangles; closed and outward, as far as `report` says
    RepairReport report; ///< what was done, and what is still wrong
};

/// Mends a cage made elsewhere, by CGAL's Polygon_mesh_processing.
///
/// It merges coincident points, removes degenerate and duplicate faces, orients, stitches, fills holes and removes
/// self-intersections. Only in builds with VDBCAGE_WITH_CGAL_GPL (GPL when distributed).
/// \throw InputError no usable face; a build without it
/// \throw Cancelled
/// Cost: O(n log n) for n faces, and CGAL's search for places of new triangles where faces meet.
VDBCAGE_API RepairedCage repair(const Mesh& cage, Interrupter* interrupter = nullptr);

} // namespace vdbcage
