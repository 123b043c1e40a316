#pragma once

#include <cstddef>

#include <vdbcage/check/detail/cage_faces.h>
#include <vdbcage/check/detail/checked_model.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Counts the cage's faces that touch or cross the model, and marks them bad. Sets the flags in `touched`, one for each
/// part of the model, of the parts that they touch.
/// \throw Cancelled
/// Cost: O(n log m + candidates), in parallel.
std::size_t countContacts(CageFaces& cage, const CheckedModel::View& model, Flags& touched, Interrupter* interrupter);

/// Counts the model's vertices that lie on the cage or have a winding number other than 1 for some choice of diagonals.
/// Marks the quads bad that have such a vertex between their diagonals.
/// \pre the cage is a cycle (see MeshTopology)
/// \throw Cancelled
/// Cost: one ray for each part that is not touched and for each vertex of the others, in parallel.
std::size_t countOutside(CageFaces& cage, const CheckedModel::View& model, const Flags& touched,
                         Interrupter* interrupter);

/// Counts the model's points that no face uses and that are not strictly inside, in the sense of countOutside(). Marks
/// no face.
/// \pre the cage is a cycle
/// \throw Cancelled
/// Cost: one ray for each, in parallel.
std::size_t countLooseOutside(const CageFaces& cage, const CheckedModel::View& model, Interrupter* interrupter);

} // namespace vdbcage::detail
