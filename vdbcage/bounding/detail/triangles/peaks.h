#pragma once

#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Flattens vertices of a triangle cage that stick out of surroundings that lie on the model: those much farther away
/// than the cage is in the mean, and no nearer than their neighbours. What holds such a vertex is the least angle,
/// mostly, which no move around it leaves room for.
/// \pre as tighten(), and there are no quads
/// \throw Cancelled
/// Cost: O(n log m) for n faces and m of the model where there are few of them.
Mesh withoutPeaks(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter);

} // namespace vdbcage::detail
