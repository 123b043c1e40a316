#pragma once

#include <vector>

#include <tools/edit/elements.h>

namespace vdbcage::edit {

/// Returns weights for moved(), by which the surroundings of the selected points follow: 1 at these, falling with the
/// distance d along the surface to 0 at `radius`. With t = d / radius the weight is 1 - 3 t^2 + 2 t^3, which is level
/// at both ends.
///
/// The distance is the length of the shortest path over edges and both diagonals of quads, measured between `points`.
/// So no weight jumps from one leg to another. With the radius 0 only selected points have a weight.
/// \pre `selected` are indices of points
/// \throw InputError not one point for each of `elements`; a radius that is negative or not finite
/// Cost: O(n log n).
/// Based on: Dijkstra, A note on two problems in connexion with graphs, 1959.
std::vector<double> softWeights(const Elements& elements, const std::vector<openvdb::Vec3d>& points,
                                const std::vector<Index>& selected, double radius);

} // namespace vdbcage::edit
