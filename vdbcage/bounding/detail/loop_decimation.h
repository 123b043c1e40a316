#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/quad_shape_term.h>
#include <vdbcage/bounding/detail/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// The distance of a mean quad: what the weights of shapes are parts of.
double distancePerQuad(const GuardedMesh& surface, const QuadTable& table, double areaPerSample);

/// How many quads are not fit, and what one counts for in parts of the distance of a mean quad.
std::size_t countUnfit(const GuardedMesh& surface, const QuadTable& table);
constexpr double unfitWeight = 8;

/// tighten() with the shape that quads have while loops come and go, all vertices or some.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, int sweeps, Interrupter* interrupter);
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const std::vector<std::uint32_t>& vertices, int sweeps,
                Interrupter* interrupter);

/// tighten() with the quads' shape. `weights` are parts of the distance of a mean quad as the surface is now.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeights& weights, int sweeps,
                Interrupter* interrupter);

/// Collapses the cheapest of the loops that pass one of these quads and may go. Returns whether there was one.
bool collapseLoopThrough(GuardedMesh& surface, QuadTable& table, const std::vector<std::uint32_t>& quads);

/// Collapses loops until at most `quads` are left, or none may go.
///
/// Those that cost least by quadrics for each quad that goes are first. A collapse that brings the surface much farther
/// from the model than a quad less does on average is put off. In between all vertices are moved to where the distance
/// is less and corners are near square. Serial, but for the moves.
/// \pre `table` is that of `surface`
/// \throw Cancelled
/// Cost: O(n sqrt(n) log m) for n quads and m faces of the model.
/// Based on: Daniels, Silva, Shepherd, Cohen, Quadrilateral Mesh Simplification, 2008.
void collapseLoops(GuardedMesh& surface, QuadTable& table, std::size_t quads, Interrupter* interrupter);

} // namespace vdbcage::detail
