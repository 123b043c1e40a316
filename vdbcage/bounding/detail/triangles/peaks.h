#pragma once

#include <vdbcage/bounding/face_wishes.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Flattens vertices of a triangle cage that stick out of surroundings that lie on the model: those much farther away
/// than the cage's mean distance, and no nearer than their neighbours. Mostly the least angle holds such a vertex: no
/// move around it leaves room for that angle.
/// \pre as tighten(), and there are no quads
/// \throw Cancelled
/// Cost: O(n log m) for n faces and m of the model where there are few of them.
Mesh withoutPeaks(const Mesh& cage, const BoundingGuard& guard, const FaceWishes& wishes, Interrupter* interrupter);

} // namespace vdbcage::detail
