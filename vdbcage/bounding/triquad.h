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
    double quads = 0.62;     ///< share of the faces that become quads; more where they cost no distance
    /// 0: the quads are those nearest to the model. Above 0 vertices are brought nearer to four edges, and corners get
    /// squarer, the more so for more, at the cost of distance.
    double quadShape = 0.5;
    TightenOptions tightening = {}; ///< of the result, with all four triangles of each quad
};

/// Makes triangles and quads of a surface that bounds the guard's model and keeps it so, each quad under both
/// diagonals. \ref bounding describes the steps.
/// \param surface closed, 2-manifold, bounding the model with the guard's clearance; best with 2 to 3 times the faces
/// \param guard of the model
/// \param options more faces are left only where decimation stops there
/// \param wishes where faces should go; none by default
/// \param interrupter told of the progress; may be null
/// \throw InputError when an option is out of range; when the surface is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(n log n log m) for n faces and m of the model.
/// Based on: Tarini, Pietroni, Cignoni, Panozzo, Puppo, Practical Quad Mesh Simplification, 2010 (the clean-up).
VDBCAGE_API Mesh triquad(const Mesh& surface, const BoundingGuard& guard, const BoundingTriquadOptions& options = {},
                         const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
