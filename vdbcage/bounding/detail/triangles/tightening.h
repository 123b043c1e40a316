#pragma once

#include <cstddef>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>
#include <vdbcage/bounding/tighten.h>

/// The common code of operators under the guard.
namespace vdbcage::detail {

class ShapeTerm;

/// \throw InputError fewer than 4
void requireFaces(std::size_t faces);
/// \throw InputError an option out of range
void requireValid(const TightenOptions& options);

/// The mean distance of a cage from the model, as the density of the wishes counts it.
/// \throw Cancelled
double meanDistance(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter);

/// Does what vdbcage::tighten() does; it reports 0 to 100 % of a stage. If `shape` is given, it is part of what is to
/// be less. \throw Cancelled
void tightenAndPerturb(GuardedMesh& surface, const TightenOptions& options, Interrupter* interrupter,
                       const ShapeTerm* shape = nullptr);

} // namespace vdbcage::detail
