#pragma once

#include <tools/edit/elements.h>

/// Operations on selections. The numbers of elements must be below their count. Points that no face uses are invisible,
/// so no operation adds them.
namespace vdbcage::edit {

/// Returns the points of the selected elements, ascending.
std::vector<Index> pointsOf(const Elements& elements, const Selection& selection);

/// Returns the selection in elements of another kind: edges and faces of which all points belong to selected elements.
/// A selection of the same kind is unchanged.
Selection converted(const Elements& elements, const Selection& selection, Element kind);

Selection all(const Elements& elements, Element kind);
/// Returns all elements that are not selected.
Selection inverted(const Elements& elements, const Selection& selection);
/// Returns the whole connected components of the selected elements. Faces with a common point are connected.
Selection linked(const Elements& elements, const Selection& selection);

/// Returns the selection with all neighbours. Neighbours are points that an edge joins, edges with a common point,
/// faces with a common point.
Selection grown(const Elements& elements, const Selection& selection);
/// Returns the selection except elements with a neighbour that is not selected. The rest is grown() of the elements
/// that are not selected.
Selection shrunk(const Elements& elements, const Selection& selection);

/// Returns the selection with the loops through it.
///
/// Edges: each selected edge is followed both ways. Beyond a point it goes on to the opposite edge, with as many edges
/// on its left as on its right. There is one at points of four edges, and at those of 6, 8, ... edges whose faces are
/// all triangles. The faces around the point must form one closed umbrella. The loop ends at other points, or where it
/// comes back to its beginning.
///
/// Points: the loops of the edges between selected points, as points. A point with no selected neighbour stays alone.
///
/// Faces: each pair of selected quads with a common edge gets the strip of quads through that edge: from quad to quad
/// across opposite edges. A selected quad with no selected face beside it gets both strips. A strip ends before a
/// triangle, at an edge that has not exactly two faces, or where it comes back to its beginning. Triangles have no
/// strip.
Selection loop(const Elements& elements, const Selection& selection);

/// Returns the elements in either. \throw InputError of two kinds
Selection added(const Selection& selection, const Selection& more);
/// Returns the elements in the first and not in the second. \throw InputError of two kinds
Selection removed(const Selection& selection, const Selection& less);

} // namespace vdbcage::edit
