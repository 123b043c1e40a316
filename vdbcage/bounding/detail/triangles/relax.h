#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/core/interrupter.h>

/// Operators that move the vertices of a surface and leave its connectivity, under the guard. Results are the same for
/// any number of threads. All that take an interrupter throw Cancelled.
namespace vdbcage::detail {

class ShapeTerm;

/// Moves every vertex once, half way between the average of its neighbours and the model.
void shrink(GuardedMesh& surface, Interrupter* interrupter);

/// Moves vertices to where the integral of the distance over their stars is less, until a sweep gains little or
/// `sweeps` are done.
///
/// `areaPerSample` is as in DistanceMeasure. The first sweeps go only half of the way: a vertex that used up all the
/// room would stop its neighbours short of a better place. If `shape` is given, it is added to the integral.
void tighten(GuardedMesh& surface, int sweeps, double areaPerSample, Interrupter* interrupter,
             const ShapeTerm* shape = nullptr);

/// Tightens some vertices; the others stay.
void tighten(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, int sweeps, double areaPerSample,
             Interrupter* interrupter, const ShapeTerm* shape);

/// Moves every vertex of a tightened surface twice more, by steps and for gains too small for tighten().
///
/// The surface becomes half a percent tighter, and flatter over flat parts of the model, where only such steps are
/// left. `shape` is as in tighten().
void relaxFinally(GuardedMesh& surface, double areaPerSample, Interrupter* interrupter,
                  const ShapeTerm* shape = nullptr);

void inflate(GuardedMesh& surface, double by, Interrupter* interrupter);

/// Inflates some vertices, where `shape`, if given, keeps quads fit.
void inflate(GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, double by, Interrupter* interrupter,
             const ShapeTerm* shape = nullptr);

/// Inflates the vertices of faces that are in no quad.
void inflateTriangles(GuardedMesh& surface, double by, Interrupter* interrupter);

/// Pushes all vertices outward a little and tightens again, `times` times. That frees vertices that hold each other.
///
/// Where the surface does not come nearer to the model, the moves are undone as far as the guard allows. If it does not
/// come nearer on the whole, they are undone everywhere, and the next push is smaller. `shape` is as in tighten().
/// Progress goes from 0 to 100 % of a stage.
void perturb(GuardedMesh& surface, int times, int sweeps, double areaPerSample, Interrupter* interrupter,
             const ShapeTerm* shape = nullptr);

/// Smooths by sweeps of the HC Laplacian: towards the average of the neighbours, and partly back against shrinking.
/// Based on: Vollmer, Mencl, Muller, Improved Laplacian Smoothing of Noisy Surface Meshes, 1999.
void roundOff(GuardedMesh& surface, int sweeps, Interrupter* interrupter);

double area(const GuardedMesh& surface);

/// Returns the area that each sample of the distance stands for, if each of `faces` has `samples`.
double areaPerSample(const GuardedMesh& surface, std::size_t faces, int samples);

/// Returns the median over the faces of their centroids' distance to the model; 0 if there are none.
double medianDistance(const GuardedMesh& surface);

/// Returns the integral of the distance to the model over the surface.
double integratedDistance(const GuardedMesh& surface, double areaPerSample, Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
