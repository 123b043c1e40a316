#pragma once

#include <memory>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/pipeline/detail/candidate.h>

namespace vdbcage::detail {

/// The surface of a closing or of its convex hull, grown to keep the guard's clearance: all of it by as many whole
/// voxels as the clearance has, then the places where that is not enough, until it is. Symmetric where the guard has a
/// plane. \throw Cancelled
StartingSurface startingSurface(std::shared_ptr<Closing> closing, CageStart kind, const BoundingGuard& guard,
                                Interrupter* interrupter);

} // namespace vdbcage::detail
