#pragma once

#include <memory>
#include <optional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/pipeline/detail/stages/candidate.h>

namespace vdbcage::detail {

/// Makes the surface of a closing or of its convex hull, grown to keep the guard's clearance.
///
/// All of it grows by the whole voxels in the clearance. Then places where that is not enough grow until it is. The
/// surface is symmetric where the guard has a plane. A closing of the model turned by `axes` is turned back.
/// `extracted` is the surface of the closing, if it is known already, or null.
/// \throw Cancelled
StartingSurface startingSurface(std::shared_ptr<const Closing> closing, CageStart kind,
                                const std::optional<openvdb::Mat3d>& axes, std::shared_ptr<const Mesh> extracted,
                                const BoundingGuard& guard, Interrupter* interrupter);

/// Makes the box around the model along `axes`, six quads, or a tetrahedron around that box. It is as near as the
/// clearance allows, but no side is shorter than `thinnest`, a fraction of the longest. The box is symmetric where the
/// guard has a plane, to which one of the axes is perpendicular.
/// \pre `kind` is orientedBox or tetrahedron
StartingSurface simpleSolid(std::shared_ptr<const Closing> closing, CageStart kind, const Mesh& model,
                            const openvdb::Mat3d& axes, double thinnest, const BoundingGuard& guard,
                            Interrupter* interrupter);

} // namespace vdbcage::detail
