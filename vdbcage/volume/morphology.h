#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

namespace vdbcage {

/// The structuring element of radius r: a set of voxel offsets d on the integer lattice.
enum class StructuringElement {
    sphere, ///< |d|^2 <= r^2, any real r
    cube    ///< max |d_i| <= r, so that r counts rounded down
};

/// The options of closeMask(): its radii and its structuring element.
struct CloseOptions {
    double closeRadiusVoxels = 4; ///< radius of the dilation, in voxels, 0 to 512
    double erodeRadiusVoxels = 4; ///< radius of the erosion, in voxels, 0 to closeRadiusVoxels
    StructuringElement element = StructuringElement::sphere; ///< of the dilation and of the erosion
};

/// Returns the dilation of a mask: every voxel within the radius of an active voxel, by the element's measure. The
/// \ref volume "page of this room" has the rules of morphology.
/// \param mask active voxels in [-2^30, 2^30)
/// \param radiusVoxels 0 to 512 voxels
/// \param element measures the radius
/// \param interrupter told of progress; may be null
/// \throw InputError when the radius or a coordinate is out of range
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                      StructuringElement element = StructuringElement::sphere,
                                                      Interrupter* interrupter = nullptr);

/// As dilate(), of the active voxels of any BoolGrid.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                      StructuringElement element = StructuringElement::sphere,
                                                      Interrupter* interrupter = nullptr);

/// Returns the erosion of a mask: every voxel whose element lies wholly in the active voxels of `mask`.
/// \param mask active voxels in [-2^30, 2^30)
/// \param radiusVoxels 0 to 512 voxels
/// \param element measures the radius
/// \param interrupter told of progress; may be null
/// \throw InputError when the radius or a coordinate is out of range
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> erode(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                     StructuringElement element = StructuringElement::sphere,
                                                     Interrupter* interrupter = nullptr);

/// As erode(), of the active voxels of any BoolGrid.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> erode(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                     StructuringElement element = StructuringElement::sphere,
                                                     Interrupter* interrupter = nullptr);

/// Returns the opening of a mask: the dilation of its erosion.
///
/// It is within `mask`, idempotent and increasing. Voxels that no element within `mask` covers go, such as thin parts,
/// spikes and specks.
/// \param mask active voxels in [-2^30, 2^30)
/// \param radiusVoxels of both, 0 to 512 voxels
/// \param element measures the radius
/// \param interrupter told of progress; may be null
/// \throw InputError when the radius or a coordinate is out of range
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> openMask(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                        StructuringElement element = StructuringElement::sphere,
                                                        Interrupter* interrupter = nullptr);

/// As openMask(), of the active voxels of any BoolGrid.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> openMask(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                        StructuringElement element = StructuringElement::sphere,
                                                        Interrupter* interrupter = nullptr);

/// Returns the closing of a solid: the erosion (by the erode radius) of its dilation (by the close radius).
///
/// It is extensive: it never loses a voxel of `solid`. It is idempotent and increasing for equal radii. Gaps, notches
/// and handles narrower than twice the close radius fill up. An erode radius below the close radius leaves an offset of
/// the difference.
/// \param solid active voxels in [-2^30, 2^30)
/// \param options radii in range
/// \param interrupter told of progress; may be null
/// \throw InputError when a radius or a coordinate is out of range, or the erode radius is above the close radius
/// \throw Cancelled when the interrupter asks to stop
/// Based on: Calderon and Boubekeur, Bounding Proxies for Shape Approximation, 2017 (asymmetric closing).
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid>
closeMask(const openvdb::MaskGrid& solid, const CloseOptions& options = {}, Interrupter* interrupter = nullptr);

/// As closeMask(), of the active voxels of any BoolGrid.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid>
closeMask(const openvdb::BoolGrid& solid, const CloseOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
