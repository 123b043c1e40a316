#pragma once

#include <vdbcage/bounding/detail/fit/demands.h>

/// Fits a cage as a whole.
namespace vdbcage::detail {

/// Moves a surface and scales it along the axes, as a whole, to where less of the model is outside of it; leaves it
/// where it is if little is. No faces come to meet in this way. Coordinates are not rounded.
/// \param points of the surface, in the order of `triangles`; they are changed
/// \throw Cancelled
void align(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, DemandFinder& finder,
           Interrupter* interrupter);

} // namespace vdbcage::detail
