#pragma once

#include <memory>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>

/// \addtogroup volume
/// \par Morphology
/// All of it keeps to these rules:
/// - Masks are sets of active voxels on the unbounded integer lattice. Outside of a grid is empty; there is no border.
/// - Active tiles of every level count as their voxels, and are never made dense.
/// - The grid's transform plays no part, nor do the values of a BoolGrid, as with OpenVDB's own morphology.
/// - Results are exact. They have a copy of the input's transform and no other metadata.
/// - Results depend on the set of active voxels alone, not on the number of threads (TBB). Equal sets give equal trees,
///   the smallest there are.
/// - Active voxels have coordinates in [-2^30, 2^30); others are an InputError.
/// - The fastest instructions that the machine has are chosen at run time. The results are the same.
/// Cost: time grows with the number of contour leaves (8^3 nodes that hold a boundary voxel). For the sphere it also
/// grows with the radius, beyond some ten voxels. Memory beyond the trees is some 100 bytes for each contour leaf. For
/// the sphere it is also 32 bytes (above 120 voxels 64) times the squared radius.
namespace vdbcage {

/// The structuring element of radius r: a set of voxel offsets d on the integer lattice.
enum class StructuringElement {
    sphere, ///< |d|^2 <= r^2, any real r
    cube    ///< max |d_i| <= r, so that r counts rounded down
};

/// The radii and the element of closeMask().
struct CloseOptions {
    double closeRadiusVoxels = 4; ///< radius of the dilation, in voxels, 0 to 512
    double erodeRadiusVoxels = 4; ///< radius of the erosion, in voxels, 0 to closeRadiusVoxels
    StructuringElement element = StructuringElement::sphere; ///< of the dilation and of the erosion
};

/// The dilation of `mask`: every voxel within the radius of an active voxel, by the element's measure.
/// \throw InputError a radius that is negative, not finite or above 512 voxels; coordinates out of range
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                      StructuringElement element = StructuringElement::sphere,
                                                      Interrupter* interrupter = nullptr);

/// dilate() of the active voxels of any BoolGrid.
/// \throw InputError as of a mask
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                      StructuringElement element = StructuringElement::sphere,
                                                      Interrupter* interrupter = nullptr);

/// The erosion of `mask`: every voxel whose element lies wholly in the active voxels of `mask`.
/// \throw InputError as dilate
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> erode(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                     StructuringElement element = StructuringElement::sphere,
                                                     Interrupter* interrupter = nullptr);

/// erode() of the active voxels of any BoolGrid.
/// \throw InputError as of a mask
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> erode(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                     StructuringElement element = StructuringElement::sphere,
                                                     Interrupter* interrupter = nullptr);

/// The opening of `mask`: the dilation of its erosion.
///
/// It is within `mask`, idempotent and increasing. What no element within `mask` covers goes, such as thin parts,
/// spikes and specks.
/// \throw InputError as dilate
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> openMask(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                        StructuringElement element = StructuringElement::sphere,
                                                        Interrupter* interrupter = nullptr);

/// openMask() of the active voxels of any BoolGrid.
/// \throw InputError as of a mask
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> openMask(const openvdb::BoolGrid& mask, double radiusVoxels,
                                                        StructuringElement element = StructuringElement::sphere,
                                                        Interrupter* interrupter = nullptr);

/// The closing of `solid`: the erosion (by the erode radius) of its dilation (by the close radius).
///
/// It is extensive: it never loses a voxel of `solid`. It is idempotent and increasing for equal radii. Gaps, notches
/// and handles narrower than twice the close radius fill up. An erode radius below the close radius leaves an offset of
/// the difference.
/// \throw InputError a radius out of range; the erode radius above the close radius; coordinates out of range
/// \throw Cancelled
/// Based on: Calderon and Boubekeur, Bounding Proxies for Shape Approximation, 2017 (asymmetric closing).
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid>
closeMask(const openvdb::MaskGrid& solid, const CloseOptions& options = {}, Interrupter* interrupter = nullptr);

/// closeMask() of the active voxels of any BoolGrid.
/// \throw InputError as of a mask
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid>
closeMask(const openvdb::BoolGrid& solid, const CloseOptions& options = {}, Interrupter* interrupter = nullptr);

} // namespace vdbcage
