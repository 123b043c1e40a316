#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/corner_shape.h>
#include <vdbcage/bounding/detail/quad_table.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// What a corner's error may cost, in parts of the distance of a mean quad, and up to which |cos| it costs nothing.
struct ShapeWeight {
    double share, free;
};

/// tighten() with the corners' shape. Its weight is that of the surface as it is now.
void relaxQuads(GuardedMesh& surface, const QuadTable& table, const ShapeWeight& shape, int sweeps,
                Interrupter* interrupter);

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
