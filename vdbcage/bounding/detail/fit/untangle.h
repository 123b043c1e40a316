#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/guard/move_limit.h>
#include <vdbcage/core/interrupter.h>

/// Takes a cage out of itself by moving its points.
namespace vdbcage::detail {

/// Returns the triangles that cross others, come nearer to them than the guard allows or have no area, ascending.
/// \param points in the guard's units
std::vector<std::uint32_t> crossingTriangles(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                                             const GuardModel& guard);

/// Moves points until no triangles cross: smooths where they do, and if that is in vain, draws limbs that go through
/// other parts back to where they come from. Returns whether none crosses; if not, the points are where they were.
/// \param points in the guard's units; they are changed, and rounded where they are
/// \param limits of the points
/// \throw Cancelled
bool untangle(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const MoveLimits& limits,
              const GuardModel& guard, Interrupter* interrupter);

} // namespace vdbcage::detail
