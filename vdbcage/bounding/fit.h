#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of fitCage().
struct FitOptions {
    static constexpr Range tightnesses{0, 1};                                ///< of `tightness`
    static constexpr Range ways{0, std::numeric_limits<double>::infinity()}; ///< of `mostWay`

    /// 0 moves only points that have to move, and no farther than they have to. 1 is as tight as tighten(). Between
    /// them distance is traded against the shape that was drawn.
    double tightness = 0.5;
    /// No point goes farther than this, as a share of the longest side of the model's box.
    double mostWay = std::numeric_limits<double>::infinity();
    /// Points of the cage that stay where they are: their indices, in any order.
    std::vector<std::size_t> keptPoints = {};
    /// A point of the cage that moves along some axes only: in a plane of symmetry, say.
    struct Rail {
        std::size_t point;           ///< its index
        std::array<bool, 3> mayMove; ///< along x, y, z
    };
    std::vector<Rail> rails = {};   ///< in any order
    TightenOptions tightening = {}; ///< for a tightness above 0
};

/// A fitted cage, or the best that came of it.
struct Fit {
    /// The reasons for which a cage does not bound in the end.
    enum class Obstacle {
        none,   ///< it bounds
        itself, ///< faces of the cage cross each other, and no place was found where they do not
        model,  ///< faces cut the model, and found no place beyond it
        quads   ///< quads that are not convex, so that one of their splits does not bound
    };

    Mesh cage; ///< the cage with other positions of points; connectivity and order are as they were
    Obstacle obstacle = Obstacle::none; ///< none if it bounds
    /// Faces that keep it from bounding, ascending, triangles first, then quads; none if it bounds.
    std::vector<std::size_t> heldFaces = {};
    /// Corners of these faces that are kept or on rails, ascending.
    std::vector<std::size_t> holdingPoints = {};
};

/// Returns the options of a guard for fitCage(): cages that people drew have narrower faces and gaps than those that
/// are made.
/// \param precision of the fitted cage's coordinates
[[nodiscard]] VDBCAGE_API GuardOptions fitGuardOptions(Precision precision = Precision::automatic);

/// The turns that placeCage() may take.
enum class PlaceTurns {
    none,    ///< it is not turned
    quarters ///< it may be turned by 90 or 180 degrees about the axes, in all 24 ways
};

/// Moves a cage and scales it along the axes, so that its bounding box is that of the guard's model. For cages in other
/// units, or of other models.
/// \param cage any mesh with faces
/// \param guard of the model
/// \param turns the turn after which the cage and the model are least apart is taken
/// \param interrupter asked whether to stop; may be null
/// \return the cage with other positions of points
/// \throw InputError when the cage has no faces, an index out of range, or a point that is not finite
/// \throw Cancelled when asked to stop
/// Cost: O((m + n + s log n) turns) for n faces, m of the model and s samples of it.
VDBCAGE_API Mesh placeCage(Mesh cage, const BoundingGuard& guard, PlaceTurns turns = PlaceTurns::none,
                           Interrupter* interrupter = nullptr);

/// Moves the points of a cage that somebody drew until it bounds the guard's model with the clearance, then tightens
/// it; \ref bounding tells how. Quads count under both diagonals and are never split. Points at one place of a seam,
/// where edges have one face, move together.
/// \param cage closed and 2-manifold once seams are closed; it may cut the model, lie inside of it, and cross itself
/// \param guard of the model, best with fitGuardOptions(). If it has a plane of symmetry, points that are within 1 % of
/// the model's longest side of each other's mirror image stay pairs, and the cage becomes exactly symmetric
/// \param options in the ranges of their members
/// \param interrupter told of the progress; may be null
/// \return the cage, and whether it bounds; a point that need not move keeps its bits
/// \throw InputError when an option is out of range or no point of the cage; when the cage is not closed and
/// 2-manifold, or faces inward; when the guard has a plane of symmetry, and the cage has points or faces without a
/// mirror image, or no edges in the plane
/// \throw Cancelled when asked to stop
/// Cost: O(rounds * (n log m + s log n)) for n faces, m of the model and s <= m + 20,000 samples of it; up to 600
/// rounds, mostly 5 to 40.
VDBCAGE_API Fit fitCage(const Mesh& cage, const BoundingGuard& guard, const FitOptions& options = {},
                        Interrupter* interrupter = nullptr);

} // namespace vdbcage
