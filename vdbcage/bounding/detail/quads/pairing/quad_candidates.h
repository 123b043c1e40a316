#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

/// Pairs of triangles that may become quads, and the order in which to try them.
namespace vdbcage::detail {

/// Two triangles that share an edge.
struct QuadCandidate {
    double score; ///< in degrees; less is better
    /// The least distance to the model that the quad costs, since it bounds under both diagonals; in parts of
    /// `distancePerFace`.
    double loss;
    std::uint32_t f, g;
};

/// Returns how far two faces that share an edge are from a flat quad with right angles, in degrees.
///
/// Returns nothing where pushing vertices is unlikely to make a quad of them: where they are folded by much more than
/// `mergeAngleDegrees`, or are no convex quad.
std::optional<double> shapeError(const GuardedMesh& surface, std::uint32_t f, std::uint32_t g,
                                 double mergeAngleDegrees);

/// Returns all pairs of triangles with a shape error, best first: flat and square ones that cost little, with sides
/// along the directions of curvature.
///
/// `distancePerFace` is the integral of the distance to the model over a mean face.
/// Cost: O(n log n) for n faces.
/// Based on: Cohen-Steiner, Morvan, Restricted Delaunay Triangulations and Normal Cycle, 2003.
std::vector<QuadCandidate> quadCandidates(const GuardedMesh& surface, double mergeAngleDegrees, double distancePerFace);

} // namespace vdbcage::detail
