#pragma once

#include <optional>

#include <openvdb/math/Mat3.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Axes along which a model lies.
struct AlignedAxes {
    openvdb::Mat3d rows = openvdb::Mat3d::identity(); ///< each an axis: `rows * p` has the coordinates of p along them
    double share = 1; ///< the surface of voxels along these axes, over that of voxels along x, y and z; at most 1
};

/// Returns the right-handed axes along which voxels around the model have the smallest surface. The surface of fine
/// voxels is the sum of the faces' areas projected along each axis. The faces of a box, and of parallel boxes, are thus
/// square to the axes. With `kept`, 0 to 2, that axis stays.
///
/// From the directions of the model's larger faces, axes are turned about one at a time to the best angle there. This
/// works for a soup, too. Axes that are better by less than a millionth are not taken: x, y and z are returned.
/// \pre requireUsable
/// \throw Cancelled
/// Cost: O(faces), plus some milliseconds.
/// Based on: Huang, Jiang, Shi, Tong, Bao, Desbrun, L1-Based Construction of Polycube Maps from Complex Shapes, 2014.
VDBCAGE_API AlignedAxes alignedAxes(const Mesh& model, std::optional<int> kept = {},
                                    Interrupter* interrupter = nullptr);

} // namespace vdbcage::detail
