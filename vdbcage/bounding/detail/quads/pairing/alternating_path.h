#pragma once

#include <cstddef>
#include <cstdint>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// The end of a path: its last two faces become a quad, or vanish by a collapse.
enum class PathEnd { quad, collapse };

struct PathOptions {
    double mergeAngleDegrees; ///< of quads, at most
    double maxGrowth;         ///< of the enclosed volume
    std::size_t maxPairs;     ///< of faces on a path; a path without a quad has one
    PathEnd end;
};

/// Pairs a triangle with another: splits the quads on a path between them and pairs the faces across the other edges.
///
/// Each quad on the path is split along either diagonal. With PathEnd::collapse the last pair vanishes, by collapsing
/// the edge between its faces. The first path that the guard allows is taken; if there is none, nothing changes.
/// Cost: O(faces) for each path that is tried, of a fixed number at most.
/// Based on: Edmonds, Paths, Trees, and Flowers, 1965.
void pairAlongPath(GuardedMesh& surface, std::uint32_t triangle, const PathOptions& options);

} // namespace vdbcage::detail
