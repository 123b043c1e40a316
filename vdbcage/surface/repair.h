#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The measures of a cage, before and after repair().
struct RepairMeasures {
    std::size_t faces = 0; ///< triangles and quads
    std::size_t parts = 0; ///< connected over edges, with points at one place taken for one
    double area = 0;       ///< of all faces, world units squared
    /// World units cubed, of all parts; the signed sum for a part that meets itself. Before: as soon as faces are
    /// oriented and holes filled.
    double volume = 0;
};

/// The counts of all that repair() did and could not do.
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

/// Returns whether this build has repair(): it was made with VDBCAGE_WITH_CGAL_GPL (GPL when distributed).
VDBCAGE_API bool hasRepair();

/// The result of repair().
struct RepairedCage {
    Mesh cage;           ///< closed, outward and free of self-intersections, as far as `report` says
    RepairReport report; ///< counts of changes, and of defects that are left
};

/// Mends a cage made elsewhere, and changes no more of it than that needs. The \ref surface "page of this room" says
/// how.
///
/// A valid cage comes back as it came. Others become closed, outward and free of self-intersections as far as possible.
/// \param cage any polygon soup
/// \param interrupter told of progress; may be null
/// \throw InputError when requireUsable() refuses the cage, or this build has no repair(): see hasRepair()
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(n log n) for n faces; where parts of n faces with m meetings are cut O(m log m + n) in exact arithmetic, and
/// O(n) for each piece of surface between cuts.
VDBCAGE_API RepairedCage repair(const Mesh& cage, Interrupter* interrupter = nullptr);

} // namespace vdbcage
