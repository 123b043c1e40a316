#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Makes quads of all pairs of triangles that are one in the table, under the guard. Returns those that it cannot make.
///
/// First all vertices move outward to make room for the other diagonals. In rounds, the quads that still fail get more
/// room and all become flatter.
/// \pre no quad is paired in the surface, which `table` is of
/// \throw Cancelled
std::vector<std::uint32_t> makeQuads(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter);

/// Does the same, but moves vertices only where a quad fails. The surface stays nearer to the model, but more quads may
/// be left.
std::vector<std::uint32_t> makeQuadsInPlace(GuardedMesh& surface, const QuadTable& table, Interrupter* interrupter);

} // namespace vdbcage::detail
