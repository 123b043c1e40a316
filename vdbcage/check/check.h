#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The verdict on a cage. Yes/no answers and counts are exact on the coordinates given (a quad counts under both
/// diagonals); measures are rounded. Faces are numbered triangles first, then quads.
struct CageCheck {
    // The cage by itself
    std::size_t points = 0, triangles = 0, quads = 0;
    std::size_t components = 0;          ///< connected over edges
    long genus = 0;                      ///< sum over the components; only meaningful if closed and manifold
    std::size_t boundaryEdges = 0;       ///< edges with one face
    std::size_t nonManifoldEdges = 0;    ///< edges with more than two faces
    std::size_t nonManifoldVertices = 0; ///< vertices whose faces form more than one fan
    std::size_t misorientedEdges = 0;    ///< edges whose two faces run along them in the same direction
    std::size_t inwardComponents = 0;    ///< components whose volume is not positive under either diagonal
    std::size_t degenerateFaces = 0;     ///< faces with a repeated corner or a triangle of zero area
    std::size_t selfIntersections = 0;   ///< pairs of faces that meet in more than the corners and edges they share

    // The cage against the model
    std::size_t contactFaces = 0;         ///< cage faces that touch or cross the model
    std::size_t modelVerticesOutside = 0; ///< model vertices (used by faces) not strictly inside, for any diagonal
    std::vector<std::uint32_t> badFaces;  ///< sorted: cage faces in a self-intersection or contact, degenerate, or with
                                          ///< a model vertex between the two diagonals of the quad

    // Measures; lengths are fractions of the diagonal of the model's bounding box
    double meanDistance = 0;    ///< from the cage to the model, over an even sample of the cage's area
    double maxDistance = 0;     ///< the largest of these
    double minDistance = 0;     ///< the smallest of these (sampled, not exact)
    double cageVolume = 0;      ///< in world units cubed
    double volumeRatio = 0;     ///< cage volume / model volume; 0 if the model is not closed
    double minAngleDegrees = 0; ///< the smallest triangle angle (quads: under both diagonals)
    double angle1stPercentileDegrees = 0;

    bool closed() const { return triangles + quads > 0 && boundaryEdges == 0; }
    bool manifold() const { return nonManifoldEdges == 0 && nonManifoldVertices == 0; }
    bool oriented() const { return misorientedEdges == 0 && inwardComponents == 0; }
    /// A cage at all: closed, 2-manifold, facing outward, without degenerate faces and self-intersections.
    bool valid() const
    {
        return closed() && manifold() && oriented() && degenerateFaces == 0 && selfIntersections == 0;
    }
    /// A valid cage that strictly bounds the model: no contact, every vertex of the model inside.
    bool bounding() const { return valid() && contactFaces == 0 && modelVerticesOutside == 0; }
};

struct CheckOptions {
    bool measure = true;         ///< fill in the measures too (distances cost the most)
    std::size_t samples = 20000; ///< points on the cage for the distances
};

/// Examines `cage` against `model`, both any polygon soup with valid indices and finite points; never throws for a bad
/// cage. Exact predicates (CGAL's filtered kernel) decide every yes/no. O((n + m) log n) for ordinary meshes.
/// \throw InputError (a mesh with an index out of range or a point that is not finite, a model without faces),
///        Cancelled
VDBCAGE_API CageCheck checkCage(const Mesh& cage, const Mesh& model, const CheckOptions& options = {},
                                Interrupter* interrupter = nullptr);

} // namespace vdbcage
