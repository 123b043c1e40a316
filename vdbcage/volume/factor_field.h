#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage {

/// A box or a sphere in world space, its border included, and the factor in it.
struct FactorRegion {
    /// The shapes of regions.
    enum class Shape {
        box,   ///< along the axes, from `lower` to `upper`
        sphere ///< about `lower`, of `radius`
    };
    Shape shape = Shape::sphere; ///< decides on the meaning of the numbers below
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

    /// Returns whether it was left out: the factor is 1 everywhere.
    bool isNone() const { return !grid && regions.empty(); }
};

/// Reads a field from text.
///
/// The text is parts separated by semicolons: `sphere:X,Y,Z,RADIUS,SCALE`, `box:X,Y,Z,X,Y,Z,SCALE` (two corners) or at
/// most one .vdb file, which is read by readFloatGrid(): its first grid called `name` counts, or else its only grid.
/// \param text the parts; "none" is no field
/// \param name of the grid in a file, and of the field in messages
/// \throw InputError naming the part, when it is none of these; naming the number, when it is out of the range of
/// FactorRegion
/// \throw IoError naming the file, as readFloatGrid()
VDBCAGE_API FactorField readFactorField(const std::string& text, const std::string& name = "scale");

/// Makes a grid for FactorField::grid from values at points, such as the vertices of a mesh. Each voxel within `radius`
/// of a point gets the value of the nearest one, of equally near ones the first. All others get 1.
/// \param points world space
/// \param values one a point, finite
/// \param voxelSize world units, above 0
/// \param radius world units, above 0, at most 64 voxels
/// \param interrupter told of progress; may be null
/// \throw InputError when there are not as many values as points, a value is not finite, or a length is out of range
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(points (radius / voxelSize)^3).
VDBCAGE_API std::shared_ptr<openvdb::FloatGrid> factorsFromPoints(const std::vector<openvdb::Vec3d>& points,
                                                                  const std::vector<float>& values, double voxelSize,
                                                                  double radius, Interrupter* interrupter = nullptr);

/// Returns every voxel with an active voxel of `mask` within its own radius.
/// \param mask active voxels in [-2^30, 2^30)
/// \param radiusVoxels multiplied by the field; 0 to 512 voxels before and after
/// \param scale clamped as for closeMask()
/// \param interrupter told of progress; may be null
/// \throw InputError as closeMask() by a factor field
/// \throw Cancelled when the interrupter asks to stop
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> dilate(const openvdb::MaskGrid& mask, double radiusVoxels,
                                                      const FactorField& scale, Interrupter* interrupter = nullptr);

/// Returns the closing of a solid by spheres, both radii of the options multiplied by a field. Where the field is
/// steep, radii are clamped to less; the \ref volume "page of this room" says how, and which rules hold.
/// \param solid active voxels in [-2^30, 2^30)
/// \param options radii in range; the sphere, unless the radius is the same everywhere
/// \param scale regions as FactorRegion has them; a grid of finite values, its transform linear; up to 2^28 samples
/// \param interrupter told of progress; may be null
/// \throw InputError as closeMask(); when `scale` is not so, or makes a radius above 512 voxels; when the element is
/// the cube and radii differ
/// \throw Cancelled when the interrupter asks to stop
/// Cost: about three times that of one radius, and 4 / h^3 bytes for each voxel of the box where the field is not the
/// same; h is the spacing of samples in voxels, 1 to 8.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> closeMask(const openvdb::MaskGrid& solid, const CloseOptions& options,
                                                         const FactorField& scale, Interrupter* interrupter = nullptr);

} // namespace vdbcage
