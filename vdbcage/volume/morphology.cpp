#include <vdbcage/volume/morphology.h>

#include <cmath>
#include <cstdint>
#include <sstream>
#include <utility>

#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/close_options.h>
#include <vdbcage/volume/detail/cube/cube_pass.h>
#include <vdbcage/volume/detail/sphere/sphere_pass.h>

namespace vdbcage {

namespace {

using detail::CubeStep;
using openvdb::BoolGrid;
using openvdb::MaskGrid;
using openvdb::MaskTree;

constexpr double maximumRadius = 512;

void requireRadius(double radius, const char* name, double maximum)
{
    if (radius >= 0 && radius <= maximum) return; // false for NaN
    std::ostringstream text;
    text << name << " is " << radius << " voxels; it must be between 0 and " << maximum;
    throw InputError(text.str());
}

// Returns the largest integer that is not above radius^2; the product may have been rounded up to one.
std::int64_t squared(double radius)
{
    const double square = std::floor(radius * radius);
    return static_cast<std::int64_t>(std::fma(radius, radius, -square) < 0 ? square - 1 : square);
}

int wholeVoxels(double radius)
{
    return static_cast<int>(std::floor(radius));
}

MaskTree::Ptr dilateTree(const MaskTree& mask, double radius, StructuringElement element,
                         const detail::Progress& progress)
{
    if (element == StructuringElement::sphere) return detail::dilateBySphere(mask, squared(radius), progress);
    return detail::applyCube(mask, {{CubeStep::dilation, wholeVoxels(radius)}}, progress);
}

MaskTree::Ptr erodeTree(const MaskTree& mask, double radius, StructuringElement element,
                        const detail::Progress& progress)
{
    if (element == StructuringElement::sphere) return detail::erodeBySphere(mask, nullptr, squared(radius), progress);
    return detail::applyCube(mask, {{CubeStep::erosion, wholeVoxels(radius)}}, progress);
}

MaskTree::Ptr openTree(const MaskTree& mask, double radius, StructuringElement element,
                       const detail::Progress& progress)
{
    if (element == StructuringElement::cube) {
        const int r = wholeVoxels(radius);
        return detail::applyCube(mask, {{CubeStep::erosion, r}, {CubeStep::dilation, r}}, progress);
    }
    const auto eroded = erodeTree(mask, radius, element, progress.part(0, 2));
    const auto opened = dilateTree(*eroded, radius, element, progress.part(1, 2));
    detail::release(*eroded, progress.end());
    return opened;
}

MaskTree::Ptr closeTree(const MaskTree& mask, const CloseOptions& options, const detail::Progress& progress)
{
    const double dilation = options.closeRadiusVoxels, erosion = options.erodeRadiusVoxels;
    if (options.element == StructuringElement::cube) {
        return detail::applyCube(
            mask, {{CubeStep::dilation, wholeVoxels(dilation)}, {CubeStep::erosion, wholeVoxels(erosion)}}, progress);
    }
    const auto dilated = dilateTree(mask, dilation, options.element, progress.part(0, 2));
    // As the erode radius is not above the close radius, no voxel of the mask can be lost.
    const auto closed = detail::erodeBySphere(*dilated, &mask, squared(erosion), progress.part(1, 2));
    detail::release(*dilated, progress.end());
    return closed;
}

MaskGrid::Ptr activeVoxels(const BoolGrid& grid)
{
    return detail::maskGridLike(grid, detail::maskTreeLike(grid.tree()));
}

} // namespace

MaskGrid::Ptr dilate(const MaskGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    requireRadius(radiusVoxels, "the dilation radius", maximumRadius);
    detail::requireSupportedCoordinates(mask.tree());
    return detail::maskGridLike(mask, dilateTree(mask.tree(), radiusVoxels, element, {interrupter}));
}

MaskGrid::Ptr erode(const MaskGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    requireRadius(radiusVoxels, "the erosion radius", maximumRadius);
    detail::requireSupportedCoordinates(mask.tree());
    return detail::maskGridLike(mask, erodeTree(mask.tree(), radiusVoxels, element, {interrupter}));
}

MaskGrid::Ptr openMask(const MaskGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    requireRadius(radiusVoxels, "the opening radius", maximumRadius);
    detail::requireSupportedCoordinates(mask.tree());
    return detail::maskGridLike(mask, openTree(mask.tree(), radiusVoxels, element, {interrupter}));
}

void detail::requireValid(const CloseOptions& options)
{
    requireRadius(options.closeRadiusVoxels, "the close radius", maximumRadius);
    requireRadius(options.erodeRadiusVoxels, "the erode radius", options.closeRadiusVoxels);
}

MaskGrid::Ptr closeMask(const MaskGrid& solid, const CloseOptions& options, Interrupter* interrupter)
{
    detail::requireValid(options);
    detail::requireSupportedCoordinates(solid.tree());
    return detail::maskGridLike(solid, closeTree(solid.tree(), options, {interrupter}));
}

MaskGrid::Ptr dilate(const BoolGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    return dilate(*activeVoxels(mask), radiusVoxels, element, interrupter);
}
MaskGrid::Ptr erode(const BoolGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    return erode(*activeVoxels(mask), radiusVoxels, element, interrupter);
}
MaskGrid::Ptr openMask(const BoolGrid& mask, double radiusVoxels, StructuringElement element, Interrupter* interrupter)
{
    return openMask(*activeVoxels(mask), radiusVoxels, element, interrupter);
}
MaskGrid::Ptr closeMask(const BoolGrid& solid, const CloseOptions& options, Interrupter* interrupter)
{
    return closeMask(*activeVoxels(solid), options, interrupter);
}

} // namespace vdbcage
