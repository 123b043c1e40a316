#pragma once

#include <optional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Axes that a model lies along.
struct AlignedAxes {
    openvdb::Mat3d rows = openvdb::Mat3d::identity(); ///< each an axis: `rows * p` has the coordinates of p along them
    double share = 1; ///< of the surface that voxels along x, y and z have, that of voxels along these; at most 1
};

/// The right-handed axes along which voxels around the model have the smallest surface: of fine ones, the sum of what
/// the model's faces are seen from each axis. So the faces of a box, and of boxes that are parallel, are square to
/// them. With `kept`, 0 to 2, that axis stays.
///
/// Directions are turned about one axis at a time to the best angle there, from those of the model's larger faces. The
/// same for a soup. No axes are better along them by less than a millionth: then they are x, y and z.
/// \pre requireUsable
/// \throw Cancelled
/// Cost: O(faces); some milliseconds beside.
/// Based on: Huang, Jiang, Shi, Tong, Bao, Desbrun, L1-Based Construction of Polycube Maps from Complex Shapes, 2014.
VDBCAGE_API AlignedAxes alignedAxes(const Mesh& model, std::optional<int> kept = {},
                                    Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
