#pragma once

#include <cstddef>

#include <vdbcage/check/detail/cage_faces.h>
#include <vdbcage/check/detail/checked_model.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage::detail {

/// Counts the cage's faces that touch or cross the model and marks them bad; sets `touched` (one flag for each part of
/// the model) for the parts that do. O(n log m + candidates), in parallel. \throw Cancelled
std::size_t countContacts(CageFaces& cage, const CheckedModel::View& model, Flags& touched, Interrupter* interrupter);

/// Counts the model's vertices that lie on the cage or have a winding number other than 1 for some choice of diagonals;
/// marks the quads bad that have one between their diagonals. The cage must be a cycle (see MeshTopology). One ray for
/// each part that is not touched, one for each vertex of the others, in parallel. \throw Cancelled
std::size_t countOutside(CageFaces& cage, const CheckedModel::View& model, const Flags& touched,
                         Interrupter* interrupter);

} // namespace vdbcage::detail
