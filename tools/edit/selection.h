#pragma once

#include <tools/edit/elements.h>

/// Selections from selections. In all of it the numbers of elements must be below their count. Points that no face uses
/// are nowhere to be seen, so nothing here adds them.
namespace vdbcage::edit {

/// The points of what is selected, ascending.
std::vector<Index> pointsOf(const Elements& elements, const Selection& selection);

/// The same in elements of another kind. Of edges and faces: those whose points are all points of what is selected. Of
/// its own kind it is unchanged.
Selection converted(const Elements& elements, const Selection& selection, Element kind);

Selection all(const Elements& elements, Element kind);
/// All but what is selected.
Selection inverted(const Elements& elements, const Selection& selection);
/// The whole connected components of what is selected. Faces with a common point are connected.
Selection linked(const Elements& elements, const Selection& selection);

/// With all neighbours. Neighbours are points that an edge joins, edges with a common point, faces with a common point.
Selection grown(const Elements& elements, const Selection& selection);
/// Without what has a neighbour that is not selected. It is grown() of what is not selected.
Selection shrunk(const Elements& elements, const Selection& selection);

/// With the loops through what is selected.
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

/// What is in either. \throw InputError of two kinds
Selection added(const Selection& selection, const Selection& more);
/// What is in the first and not in the second. \throw InputError of two kinds
Selection removed(const Selection& selection, const Selection& less);

} // namespace vdbcage::edit
