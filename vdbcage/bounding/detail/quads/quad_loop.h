#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>

namespace vdbcage::detail {

/// Quads in a row that comes back to its first one, or goes from the plane of symmetry to the plane. Each is left
/// across the side opposite to the one that it is entered across, or beside it: there the loop turns.
///
/// Where each rung becomes one vertex the quads are gone, and what was on both sides of them is joined. So all faces
/// stay quads.
struct QuadLoop {
    /// Rung i is the side across which quad i is entered; one more at the plane. All first ends are on one side of the
    /// loop, all second ends on the other.
    std::vector<Rung> rungs;
    std::vector<std::uint32_t> quads; ///< each once

    bool isClosed() const { return rungs.size() == quads.size(); }
};

/// All loops that never turn and pass no quad twice: the polychords that close.
/// Cost: O(quads).
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
std::vector<QuadLoop> straightLoops(const QuadTable& table);

/// Loops that turn twice: a part of a polychord that closes, and the part of another one that crosses it at both ends.
/// Both turns are at quads with irregular corners, so that no more vertices are irregular without the loop than with
/// it. Where whole polychords cannot go, these may. Cost: O(p^2 sqrt(n)) for p polychords and n quads at most.
std::vector<QuadLoop> turningLoops(const GuardedMesh& surface, const QuadTable& table);

/// Whether collapsing a loop leaves a surface of quads: closed and 2-manifold, valences 3 to 8, no two quads with two
/// sides or both ends of a diagonal in common.
bool leavesQuads(const GuardedMesh& surface, const QuadTable& table, const QuadLoop& loop);

} // namespace vdbcage::detail
