#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Operators that move the vertices of a surface and leave its connectivity, under the guard. Vertices that are not
/// neighbours are moved side by side; the result is the same for any number of threads.
namespace vdbcage::detail {

/// Moves every vertex once, half way between the average of its neighbours and the model.
void shrink(GuardedMesh& surface, Interrupter* interrupter);

/// Moves vertices to where the integral of the distance over their stars is less, until a sweep gains little or
/// `sweeps` are done. `areaPerSample` as DistanceMeasure. The first sweeps go half of the way only: a vertex that used
/// up all the room there is would stop its neighbours short of a better place.
void tighten(GuardedMesh& surface, int sweeps, double areaPerSample, Interrupter* interrupter);

/// Moves every vertex of a tightened surface twice more, by steps and for gains too small for tighten(): half a percent
/// tighter, and flatter over flat parts of the model, where such steps are all that there is.
void relaxFinally(GuardedMesh& surface, double areaPerSample, Interrupter* interrupter);

/// Moves every vertex outward.
void inflate(GuardedMesh& surface, double by, Interrupter* interrupter);

/// Moves the vertices of triangles that are in no quad outward.
void inflateTriangles(GuardedMesh& surface, double by, Interrupter* interrupter);

/// Pushes all vertices outward a little and tightens again, `times` times. Where that did not bring the surface nearer
/// to the model it is undone, as far as the guard allows; if it has not on the whole, everywhere, and then it is pushed
/// less. Frees vertices that hold each other.
void perturb(GuardedMesh& surface, int times, int sweeps, double areaPerSample, Interrupter* interrupter);

/// Sweeps of HC Laplacian smoothing: towards the average of the neighbours, less what that would shrink the surface.
void roundOff(GuardedMesh& surface, int sweeps, Interrupter* interrupter);

/// The total area of the surface.
double area(const GuardedMesh& surface);

/// The part of its area that each sample of the distance stands for, if each of `faces` has `samples`.
double areaPerSample(const GuardedMesh& surface, std::size_t faces, int samples);

/// The median over the triangles of their centroids' distance to the model; 0 without any.
double medianDistance(const GuardedMesh& surface);

/// The integral of the distance to the model over the surface. In parallel.
double integratedDistance(const GuardedMesh& surface, double areaPerSample);

} // namespace vdbcage::detail
