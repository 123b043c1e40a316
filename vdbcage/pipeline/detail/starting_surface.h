#pragma once

#include <memory>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/pipeline/detail/candidate.h>

namespace vdbcage::detail {

/// The surface of a closing or of its convex hull, grown to keep the guard's clearance.
///
/// All of it grows by as many whole voxels as the clearance has. Then places where that is not enough grow until it is.
/// The surface is symmetric where the guard has a plane.
/// \throw Cancelled
StartingSurface startingSurface(std::shared_ptr<Closing> closing, CageStart kind, const BoundingGuard& guard,
                                Interrupter* interrupter);

} // namespace vdbcage::detail
