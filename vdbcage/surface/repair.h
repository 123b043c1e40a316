#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// How much there is of a cage, before and after repair().
struct RepairMeasures {
    std::size_t faces = 0; ///< triangles and quads
    std::size_t parts = 0; ///< connected over edges, with points at one place taken for one
    double area = 0;       ///< of all faces, in world units squared
    /// In world units cubed, of all parts; of a part that meets itself the signed sum. Before: as soon as faces are
    /// oriented and holes filled.
    double volume = 0;
};

/// Counts what repair() did and what it could not do.
struct RepairReport {
    std::size_t mergedPoints = 0;            ///< points that lay on another one
    std::size_t removedFaces = 0;            ///< degenerate and duplicate faces taken out
    std::size_t hangingFaces = 0;            ///< faces taken out that hung in edges with more than two: fins and walls
    std::size_t splitVertices = 0;           ///< non-manifold vertices duplicated
    std::size_t stitchedEdges = 0;           ///< pairs of boundary edges joined
    std::size_t filledHoles = 0;             ///< boundary loops closed
    std::size_t unfilledHoles = 0;           ///< boundary loops that could not be closed
    std::size_t movedPoints = 0;             ///< points moved so that faces do not meet
    std::size_t cutFaces = 0;                ///< faces cut where they met, or taken out as they lay inside
    std::size_t selfIntersectionsBefore = 0; ///< pairs of faces that met, of the oriented cage without holes
    std::size_t selfIntersectionsAfter = 0;  ///< pairs of faces that still meet
    bool reoriented = false;                 ///< some faces were turned to face outward
    RepairMeasures before;                   ///< of the cage that was given
    RepairMeasures after;                    ///< of the cage that is returned
};

/// Whether this build has repair(): it was made with VDBCAGE_WITH_CGAL_GPL.
VDBCAGE_API bool hasRepair();

/// The result of repair().
struct RepairedCage {
    Mesh cage;           ///< closed, outward and free of self-intersections, as far as `report` says
    RepairReport report; ///< what was done, and what is still wrong
};

/// Mends a cage made elsewhere, and changes no more of it than that needs.
///
/// A valid cage comes back as it came. Else coincident points are merged, degenerate, duplicate and hanging faces taken
/// out, faces oriented, edges stitched and holes filled. Where faces meet, points go back between their neighbours, if
/// that helps; faces and quads stay then. What still meets, such as parts that overlap, becomes the surface of what it
/// encloses once or more often, and quads that are cut there become triangles. Where nothing helps, faces still meet.
///
/// Only in builds with VDBCAGE_WITH_CGAL_GPL (GPL when distributed).
/// \throw InputError no usable face; a build without it
/// \throw Cancelled
/// Cost: O(n log n) for n faces; where parts of n faces with m meetings are cut O(m log m + n) in exact arithmetic, and
/// O(n) for each piece of surface between cuts.
VDBCAGE_API RepairedCage repair(const Mesh& cage, Interrupter* interrupter = nullptr);

} // namespace vdbcage
