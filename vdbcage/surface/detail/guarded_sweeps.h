#pragma once

#include <cstddef>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/surface/detail/guarded_surface.h>

/// Operators that move every vertex of a surface and leave its connectivity, under the guard. Vertices that are not
/// neighbours are moved side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Moves every vertex once, half way between the average of its neighbours and the model.
void shrink(GuardedSurface& surface, Interrupter* interrupter);

/// Moves vertices to where the integral of the distance over their stars is less, until a sweep gains little or
/// `sweeps` are done. `areaPerSample` as DistanceMeasure.
void tighten(GuardedSurface& surface, int sweeps, double areaPerSample, Interrupter* interrupter);

/// Sweeps of HC Laplacian smoothing: towards the average of the neighbours, less what that would shrink the surface.
void roundOff(GuardedSurface& surface, int sweeps, Interrupter* interrupter);

/// The total area of the surface.
double area(const GuardedSurface& surface);

} // namespace vdbcage::detail
