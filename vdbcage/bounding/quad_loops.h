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
    /// Largest mean of the angles by which corners are off square. Distance is given up until it is reached, as far as
    /// that goes.
    double meanAngleDegrees = 16;
    double mostAngleDegrees = 42;   ///< largest angle off square of 95 % of the corners, reached in the same way
    int exchanges = 4;              ///< times that loops go where they bring little, and come where they bring more
    TightenOptions tightening = {}; ///< of the result
};

/// Makes a cage as drawn by hand of a surface that bounds the guard's model and keeps it so: quads only, in closed
/// loops around limbs and body, with corners near square. \ref bounding describes the steps.
/// \param surface closed, 2-manifold, of quads, bounding the model with the guard's clearance
/// \param guard of the model
/// \param options more faces are left where no loop may go, and triangles where the guard allows no quad
/// \param wishes where faces should go; none by default
/// \param interrupter told of the progress; may be null
/// \throw InputError when an option is out of range; when the surface has a triangle, or is not closed and 2-manifold
/// \throw Cancelled when asked to stop
/// Cost: O(n sqrt(n) log m) for n quads and m faces of the model.
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
VDBCAGE_API Mesh quadLoops(const Mesh& surface, const BoundingGuard& guard, const QuadLoopsOptions& options = {},
                           const FaceWishes& wishes = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
