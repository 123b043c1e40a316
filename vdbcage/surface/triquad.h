#pragma once

#include <cstddef>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/tighten.h>

namespace vdbcage {

struct TriquadOptions {
    double mergeAngleDegrees = 10; ///< largest dihedral angle between two triangles that become a quad, 0 to 180
};

/// Merges pairs of triangles into quads, flattest and squarest pairs first. Quads are convex under both diagonals, with
/// no corner above 160 degrees; no two faces come to share two edges, no inner point is left with fewer than three.
/// The merged edge runs from a quad's corner 0 to corner 2. Points keep their order; quads of the input stay and come
/// first. Any soup will do: edges that are not between two faces in opposite directions are left alone. O(n log n).
/// \throw InputError (an angle out of range; no usable face)
VDBCAGE_API Mesh triquad(const Mesh& triangles, const TriquadOptions& options = {});

struct BoundingTriquadOptions {
    /// Largest angle between the triangles of a quad in the end, under either diagonal, 0 to 180; 90 allows most.
    double mergeAngleDegrees = 30;
    std::size_t faces = 400; ///< to end with, at most; a quad counts once; at least 4
    double quads = 0.62;     ///< the part of the faces to be quads, 0 to 1; more where they cost no distance
    TightenOptions tightening = {};
};

/// Makes triangles and quads of a surface that bounds `guard`'s model and keeps it so, each quad under both diagonals:
/// the surface is decimated as far as pairing needs to reach `faces`, and given a little room; pairs become quads, flat
/// and square ones that follow the directions of curvature first. Until enough of the faces are quads, triangles are
/// then paired across the quads between them, vanish in twos, or become quads by splitting the strip of quads between
/// two of them, with ever more room and at ever more cost of distance; and the result is tightened with all four
/// triangles of every quad under the guard. Quads are convex as above, and no two polygons come to share two
/// edges, under either diagonal.
/// A surface of two to three times the faces wanted gives the best result. More than the faces asked for are left only
/// where decimation stops there. TBB-parallel, same result for any number of threads. \pre `surface` is closed,
/// 2-manifold and bounds the model with the guard's clearance \throw InputError (options; not closed and 2-manifold),
/// Cancelled O(n log n log m) for n faces and m of the model.
VDBCAGE_API Mesh triquad(const Mesh& surface, const BoundingGuard& guard, const BoundingTriquadOptions& options,
                         Interrupter* interrupter = nullptr);

} // namespace vdbcage
