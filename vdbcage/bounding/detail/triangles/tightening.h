#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/bounding/tighten.h>

/// Code shared by operators under the guard.
namespace vdbcage::detail {

class ShapeTerm;

/// \throw InputError fewer than 4
void requireFaces(std::size_t faces);
/// \throw InputError an option out of range
void requireValid(const TightenOptions& options);

/// Returns the mean distance of a cage from the model, weighted by the density of the wishes.
/// \throw Cancelled
double meanDistance(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter);

/// Does the work of vdbcage::tighten(). If `shape` is given, it is added to the integral of the distance. Progress goes
/// from 0 to 100 % of a stage.
/// \throw Cancelled
void tightenAndPerturb(GuardedMesh& surface, const TightenOptions& options, Interrupter* interrupter,
                       const ShapeTerm* shape = nullptr);

} // namespace vdbcage::detail
