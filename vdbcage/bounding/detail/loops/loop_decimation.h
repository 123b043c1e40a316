#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Collapses the cheapest of the loops that pass one of these quads and may go. Returns whether there was one. Joints
/// keep their rings.
bool collapseLoopThrough(GuardedMesh& surface, QuadTable& table, const std::vector<std::uint32_t>& quads,
                         Interrupter* interrupter);

/// The rule of collapses for the rings of joints.
enum class AtJoints { anything, keepRings };

/// Collapses loops until at most `quads` are left, or none may go.
///
/// Loops that cost least by quadrics for each removed quad come first. A collapse that brings the surface much farther
/// from the model than one quad less does on average is put off. In between, all vertices move to where the distance is
/// less and corners are near square. Where no whole polychord may collapse, loops of parts of two do. With keepRings no
/// collapse removes a ring that a joint needs. Vertices are measured and moved in parallel. Progress goes from 0 to
/// `mostPercent` of a stage; none is reported if that is 0.
/// \pre `table` is that of `surface`
/// \throw Cancelled
/// Cost: O(n sqrt(n) log m) for n quads and m faces of the model.
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
void collapseLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, AtJoints atJoints, int mostPercent,
                   Interrupter* interrupter);

} // namespace vdbcage::detail
