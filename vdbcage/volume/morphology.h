#pragma once

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// The structuring element of radius r, a set of voxel offsets d (integer lattice, Outside of a grid is empty):
enum class Element {
    sphere, ///< |d|^2 <= r^2, any real r >= 0
    cube    ///< max |d_i| <= r, r is rounded down to an integer
};

struct CloseOptions {
    double closeRadiusVoxels = 4; ///< radius of the dilation, in voxels, 0 to 512
    double erodeRadiusVoxels = 4; ///< radius of the erosion, in voxels, 0 to closeRadiusVoxels
    Element element = Element::sphere;
};

/// Every voxel within the element's reach of an active voxel of `mask`. Same transform; exact; no border.
/// \throw InputError radius negative, not finite or above 512; Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr dilate(const openvdb::MaskGrid& mask, double radiusVoxels,
                                          Element element = Element::sphere, Interrupter* interrupter = nullptr);

/// Every voxel whose element lies wholly in the active voxels of `mask`. Same transform; exact; outside is empty.
/// \throw InputError, Cancelled as dilate
VDBCAGE_API openvdb::MaskGrid::Ptr erode(const openvdb::MaskGrid& mask, double radiusVoxels,
                                         Element element = Element::sphere, Interrupter* interrupter = nullptr);

/// The closing of `solid`: solid, united with the erosion (by the erode radius) of its dilation (by the close
/// radius). Extensive by construction; idempotent and increasing for equal radii. Gaps, notches and handles narrower
/// than twice the close radius fill up. An erode radius below the close radius leaves an offset of the difference.
/// \throw InputError, Cancelled as dilate
/// Based on: Calderon and Boubekeur, Bounding Proxies for Shape Approximation, 2017 (asymmetric closing).
VDBCAGE_API openvdb::MaskGrid::Ptr closeMask(const openvdb::MaskGrid& solid, const CloseOptions& options = {},
                                             Interrupter* interrupter = nullptr);

/// `mask` with every cavity filled: all voxels that no path of face-connected empty voxels joins to the outside.
/// `cavities`, if not null, gets the number of separate cavities filled. \throw Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr fillCavities(const openvdb::MaskGrid& mask, std::size_t* cavities = nullptr,
                                                Interrupter* interrupter = nullptr);

/// The contour of `mask`: its voxels with a face neighbour that is not active. \throw Cancelled
VDBCAGE_API openvdb::MaskGrid::Ptr contour(const openvdb::MaskGrid& mask, Interrupter* interrupter = nullptr);

} // namespace vdbcage
