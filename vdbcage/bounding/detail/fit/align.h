#pragma once

#include <vdbcage/bounding/detail/fit/demands.h>

/// Fits a cage as a whole.
namespace vdbcage::detail {

/// Moves a surface and scales it along the axes, as a whole, to where less of the model is outside of it; leaves it
/// where it is if little is, or if it would be much farther from the model then. No faces come to meet in this way.
/// Coordinates are not rounded.
/// \param points of the surface, in the order of `triangles`; they are changed
/// \throw Cancelled
void align(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, DemandFinder& finder,
           Interrupter* interrupter);

/// Moves a surface and scales it along the axes, so that its box is `box`.
/// \param points of the surface, in the order of `triangles`; they are changed
/// \param mayTurn take the turn by multiples of 90 degrees about the axes after which surface and model are least apart
/// \throw Cancelled
void place(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const Box& box, bool mayTurn,
           DemandFinder& finder, Interrupter* interrupter);

} // namespace vdbcage::detail
