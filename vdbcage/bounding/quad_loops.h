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

/// Options of quadLoops().
struct QuadLoopsOptions {
    static constexpr Range angles{0, 90};          ///< of `meanAngleDegrees` and `mostAngleDegrees`
    static constexpr Range exchangeCounts{0, 100}; ///< of `exchanges`

    std::size_t faces = 400; ///< to end with, at most; at least 6
    /// How far corners may be from square on average. Distance is given up until they are, as far as that goes.
    double meanAngleDegrees = 16;
    double mostAngleDegrees = 42;   ///< how far 95 % of the corners may be from square; likewise
    int exchanges = 4;              ///< times that loops go where they bring little, and come where they bring more
    TightenOptions tightening = {}; ///< of the result
};

/// Makes a cage as drawn by hand of a surface that bounds the guard's model and keeps it so: quads only, in closed
/// loops around limbs and body, with corners near square.
///
/// Whole loops of quads are collapsed, each edge under the guard, so that those that are left stay loops; where none
/// may go, loops of parts of two. Then loops are exchanged: some are collapsed, others are split. What comes out
/// depends on the loops of `surface`. Those of extractSurface are outlines of slices; voxels some twice as wide as
/// for other cages are best, so that there are about three times the quads wanted. The quads that are left are made to
/// bound under both diagonals, and tightened.
///
/// More than the faces asked for are left where no loop may go, and triangles where the guard allows no quad. The same
/// for any number of threads.
/// \pre `surface` is closed, 2-manifold, of quads, and bounds the model with the guard's clearance
/// \throw InputError fewer than 6 faces asked for; an option out of range; a triangle; not closed and 2-manifold
/// \throw Cancelled
/// Cost: O(n sqrt(n) log m) for n quads and m faces of the model.
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
VDBCAGE_API Mesh quadLoops(const Mesh& surface, const BoundingGuard& guard, const QuadLoopsOptions& options = {},
                           const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
