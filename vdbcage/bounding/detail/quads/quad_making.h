#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Makes quads of all pairs of triangles that are one in the table, under the guard. Returns those that do not go.
///
/// First all are given the room that the other diagonals need. Where some do not go they get more, and all are made
/// flatter, in rounds.
/// \pre no quad is paired in the surface, which `table` is of
/// \throw Cancelled
std::vector<std::uint32_t> makeQuads(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter);

/// The same, but vertices are only moved where a quad does not go. The surface stays nearer to the model, but more
/// quads may be left.
std::vector<std::uint32_t> makeQuadsInPlace(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter);

} // namespace vdbcage::detail
