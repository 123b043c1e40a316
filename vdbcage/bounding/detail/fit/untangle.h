#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/core/interrupter.h>

/// Takes a cage out of itself by moving its points.
namespace vdbcage::detail {

/// Returns the triangles that cross others, come nearer to them than the guard allows or have no area, ascending.
/// \param points in the guard's units
std::vector<std::uint32_t> crossingTriangles(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                                             const GuardModel& guard);

/// Moves the points of crossing triangles towards the mean of their neighbours, and with rounds in vain more rings
/// around them, until none crosses. Returns whether none does.
/// \param points in the guard's units; they are changed, and rounded where they are
/// \param isKept by point: it stays
/// \throw Cancelled
bool untangle(std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const std::vector<char>& isKept,
              const GuardModel& guard, Interrupter* interrupter);

} // namespace vdbcage::detail
