#pragma once

#include <cstddef>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// Options of triquad() under a guard.
struct BoundingTriquadOptions {
    static constexpr Range mergeAngles{0, 180}; ///< of `mergeAngleDegrees`
    static constexpr Range quadShares{0, 1};    ///< of `quads`
    static constexpr Range quadShapes{0, 1};    ///< of `quadShape`

    /// Largest angle between the triangles of a quad in the end, under either diagonal; 90 allows most.
    double mergeAngleDegrees = 30;
    std::size_t faces = 400; ///< to end with, at most; a quad counts once; at least 4
    double quads = 0.62;     ///< the part of the faces to be quads; more where they cost no distance
    /// 0: what is nearest to the model. Above 0 vertices are brought nearer to four edges; corners get squarer, the
    /// more so for more, at the cost of distance.
    double quadShape = 0.5;
    TightenOptions tightening = {}; ///< of the result, with all four triangles of each quad
};

/// Makes triangles and quads of a surface that bounds the guard's model and keeps it so, each quad under both
/// diagonals.
///
/// The surface is decimated as far as pairing needs for `faces`, and given a little room. Pairs of triangles become
/// quads: flat and square ones along the directions of curvature first. Until enough of the faces are quads, more are
/// made, with ever more room and at ever more cost of distance. Triangles are paired across the quads between them,
/// vanish in twos, or become quads by splitting the polychord between two of them. Local changes of connectivity then
/// clean the quads up, if they are to have a shape; where too few can be paired again they stay as they were. The
/// result is tightened with all four triangles of every quad under the guard. Quads are convex with no corner above 160
/// degrees. No two polygons come to share two edges, under either diagonal.
///
/// A surface of two to three times the faces wanted gives the best result. More than the faces asked for are left only
/// where decimation stops there. The same for any number of threads.
/// \pre `surface` is closed, 2-manifold and bounds the model with the guard's clearance
/// \throw InputError an option out of range; not closed and 2-manifold
/// \throw Cancelled
/// Cost: O(n log n log m) for n faces and m of the model.
/// Based on: Tarini, Pietroni, Cignoni, Panozzo, Puppo, Practical Quad Mesh Simplification, 2010 (the clean-up).
VDBCAGE_API Mesh triquad(const Mesh& surface, const BoundingGuard& guard, const BoundingTriquadOptions& options = {},
                         const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
