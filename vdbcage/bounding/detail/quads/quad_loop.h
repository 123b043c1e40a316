#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>

namespace vdbcage::detail {

/// Quads in a row that comes back to its first one, or that begins and ends at the plane of symmetry. Each is left
/// across the side opposite to the one that it is entered across, or beside it, where the loop turns.
///
/// Collapsing each rung to one vertex removes the quads and joins both sides of the loop, so all faces stay quads.
struct QuadLoop {
    /// Rung i is the side across which quad i is entered; at the plane there is one more. All first ends are on one
    /// side of the loop, all second ends on the other.
    std::vector<Rung> rungs;
    std::vector<std::uint32_t> quads; ///< each once

    bool isClosed() const { return rungs.size() == quads.size(); }
};

/// Returns all loops that never turn and pass no quad twice: the polychords that close.
/// Cost: O(quads).
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
std::vector<QuadLoop> straightLoops(const QuadTable& table);

/// Returns loops that turn twice: a part of a polychord that closes, and the part of another one that crosses it at
/// both ends. Both turns are at quads with irregular corners, so that a collapse makes no more vertices irregular. They
/// may collapse where whole polychords cannot.
/// Cost: O(p^2 sqrt(n)) for p polychords and n quads at most.
std::vector<QuadLoop> turningLoops(const GuardedMesh& surface, const QuadTable& table);

/// Returns whether collapsing a loop leaves a surface of quads: closed and 2-manifold, valences 3 to 8, no two quads
/// with two sides or both ends of a diagonal in common.
bool leavesQuads(const GuardedMesh& surface, const QuadTable& table, const QuadLoop& loop);

} // namespace vdbcage::detail
