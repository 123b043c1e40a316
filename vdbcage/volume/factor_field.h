#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/volume/morphology.h>

/// \addtogroup volume
/// \par Factor fields
/// Numbers that vary in space and multiply something there: the radius of a closing (smaller where features matter, 0
/// where a hole has to stay), or the density of a cage's faces.
namespace vdbcage {

/// A box or a sphere in world space, its border included, and the factor in it.
struct FactorRegion {
    /// Which of the two it is.
    enum class Shape {
        box,   ///< along the axes, from `lower` to `upper`
        sphere ///< about `lower`, of `radius`
    };
    Shape shape = Shape::sphere; ///< what the numbers below mean
    /// Box: the corner with the smallest coordinates. Sphere: the centre. World units, finite.
    openvdb::Vec3d lower{0};
    /// Box: the corner with the largest coordinates; nothing is inside if one is below that of `lower`. World units.
    openvdb::Vec3d upper{0};
    double radius = 0; ///< of the sphere, world units, at least 0
    double factor = 1; ///< 0 to 8
};

/// A factor for each place: the grid's value, interpolated, times the factor of every region around the place. The grid
/// is in world space, so its voxels may be of any size. No grid counts as 1 everywhere.
struct FactorField {
    /// Values cut to 0 to 8; its background holds outside; a linear transform.
    std::shared_ptr<const openvdb::FloatGrid> grid;
    std::vector<FactorRegion> regions; ///< their factors are multiplied where they overlap
    std::string source = {};           ///< the text that it was read from; empty if it was made otherwise
    std::filesystem::path file = {};   ///< that `grid` was read from; empty if it was not read
};

/// A field from text; "none" is no field.
///
/// The text is parts separated by semicolons: `sphere:X,Y,Z,RADIUS,SCALE`, `box:X,Y,Z,X,Y,Z,SCALE` (two corners) or a
/// .vdb file. Of a file its first grid called `name` counts, or else its only grid; it must be a FloatGrid.
/// \throw InputError naming the part
/// \throw IoError naming the file
VDBCAGE_API FactorField readFactorField(const std::string& text, const std::string& name = "scale");

/// A grid for FactorField::grid from values at points, such as the vertices of a mesh.
///
/// Each voxel within `radius` of a point gets the value of the nearest one, of equally near ones the first. All others
/// get 1. `voxelSize` and `radius` are world lengths above 0; `radius` is at most 64 voxels.
/// \throw InputError not as many values as points; a value that is not finite; `voxelSize` or `radius` out of range
/// \throw Cancelled
/// Cost: O(points (radius / voxelSize)^3).
VDBCAGE_API std::shared_ptr<openvdb::FloatGrid> factorsFromPoints(const std::vector<openvdb::Vec3d>& points,
                                                                  const std::vector<float>& values, double voxelSize,
                                                                  double radius, Interrupter* interrupter = nullptr);

/// Every voxel with an active voxel of `mask` within its own radius: `radiusVoxels` times the field, clamped as below.
/// \throw InputError as closeMask
/// \throw Cancelled
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                      const FactorField& scale, Interrupter* interrupter = nullptr);

/// The closing of `solid` by spheres, both radii of the options multiplied by the field and clamped.
///
/// From voxel to voxel along an axis a radius grows by half a voxel at most, so its slope is below 1 in every
/// direction. Where the field is steeper, the smaller radius spreads.
///
/// The dilation asks, at each voxel, for a voxel of `solid` within the voxel's own radius. The erosion takes away all
/// that is within the radius of a voxel outside, where the radius is that of the voxel outside. So the two are adjoint.
/// The closing is extensive and increasing, and idempotent for equal radii, as with one radius everywhere. A field of 1
/// everywhere is exactly that.
///
/// The field is sampled at every h-th voxel and interpolated between. Here h is the largest power of 2, 1 to 8, that is
/// not above a quarter of the close radius. Where radii vary, some below 3.5 voxels act as if they were up to 0.27
/// less. So the rule for neighbours holds on the lattice of voxels too.
/// \throw InputError as closeMask; the cube, which has one radius only; a region's factor outside 0 to 8 or its radius
/// negative; a grid's value not finite; a radius above 512 voxels; a grid whose transform is not linear; a field of
/// more than 2^28 samples
/// \throw Cancelled
/// Cost: about three times that of one radius, and 4 / h^3 bytes for each voxel of the box where the field is not the
/// same.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> closeMask(const openvdb::MaskGrid& solid, const CloseOptions& options,
                                                         const FactorField& scale, Interrupter* interrupter = nullptr);

} // namespace vdbcage
