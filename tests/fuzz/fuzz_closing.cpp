// Trees of masks with voxels, leaves and active tiles, anywhere on the lattice: dilation, erosion and closing by both
// elements are what the definition says, and the same for all instruction sets.

#include <cstddef>
#include <cstdint>

#include <fuzz/bytes.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/sphere/sphere_pass.h>
#include <vdbcage/volume/factor_field.h>
#include <volume/by_definition.h>

using namespace vdbcage;
using namespace vdbcage::test;
using fuzz::Choices;
using fuzz::require;

namespace {

constexpr int side = 48;

/// Where nodes of all levels begin, or almost where coordinates end.
Coord cornerOf(Choices& choices)
{
    Coord corner;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::array<int, 8> starts{0, -8, 128, -128, 4096, -4096, (1 << 30) - 200, -(1 << 30) + 100};
        const int start = starts[static_cast<std::size_t>(choices.below(8))];
        corner[axis] = start - choices.below(side);
    }
    return corner;
}

/// The boxes that leaves and tiles of leaves cover.
CoordBBox leafAt(const Coord& voxel)
{
    return CoordBBox::createCube(voxel & ~7, 8);
}

/// Voxels, blocks, leaves and tiles, set and taken away; some voxels of the tree may be outside of the box.
MaskGrid::Ptr maskOf(Choices& choices, const CoordBBox& box)
{
    auto grid = MaskGrid::create();
    auto& tree = grid->tree();
    while (!choices.isAtEnd()) {
        const int kind = choices.below(8);
        const bool isOn = choices.below(4) != 3;
        const Coord place = box.min() + Coord{choices.below(side), choices.below(side), choices.below(side)};
        if (kind == 0) {
            tree.addTile(1, place, isOn, isOn);
        } else if (kind == 1) {
            auto* const leaf = tree.touchLeaf(place);
            isOn ? leaf->setValuesOn() : leaf->setValuesOff();
        } else if (kind == 2) {
            CoordBBox block(place, place + Coord{choices.below(12), choices.below(12), choices.below(12)});
            block.intersect(box);
            tree.sparseFill(block, isOn, isOn);
        } else if (kind == 3) {
            tree.touchLeaf(place); // maybe without any active voxel
        } else if (isOn) {
            tree.setValueOn(place);
        } else {
            tree.setValueOff(place);
        }
    }
    return grid;
}

void requireSimd(const MaskGrid& grid, double radius)
{
    const auto squared = static_cast<std::int64_t>(radius * radius);
    const auto plain = detail::dilateBySphere(grid.tree(), squared, {}, detail::Simd::plain);
    const auto eroded = detail::erodeBySphere(*plain, &grid.tree(), squared, {}, detail::Simd::plain);
    for (const detail::Simd simd : detail::supportedSimd()) {
        require(sameTree(*MaskGrid::create(detail::dilateBySphere(grid.tree(), squared, {}, simd)),
                         *MaskGrid::create(plain)));
        require(sameTree(*MaskGrid::create(detail::erodeBySphere(*plain, &grid.tree(), squared, {}, simd)),
                         *MaskGrid::create(eroded)));
    }
}

/// A field that varies: the closing loses nothing, and done again it changes nothing.
void requireClosingByField(const MaskGrid& grid, double radius, Choices& choices)
{
    const CoordBBox box = grid.evalActiveVoxelBoundingBox();
    FactorField field;
    FactorRegion region;
    region.lower = box.min().asVec3d();
    region.radius = side * choices.share();
    region.factor = 3 * choices.share();
    field.regions.push_back(region);
    const CloseOptions options{radius, radius, StructuringElement::sphere};
    const MaskGrid::Ptr closed = closeMask(grid, options, field);
    require(isSubset(grid, *closed));
    require(sameTree(*closeMask(*closed, options, field), *closed));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices(data, size);
    const auto element = static_cast<StructuringElement>(choices.below(2));
    const double radius = 7 * choices.share(), erodeRadius = choices.oneIn(2) ? radius : radius * choices.share();
    const int more = choices.below(4);
    Choices ofField = choices;
    const Coord corner = cornerOf(choices);
    // Leaves that have a part in this box are all in the one around it.
    const CoordBBox box = CoordBBox::createCube(corner, side);
    const CoordBBox around(leafAt(box.min()).min(), leafAt(box.max()).max());
    const MaskGrid::Ptr grid = maskOf(choices, box);
    if (grid->empty()) return 0;

    const DenseSet set(*grid, grown(around, static_cast<int>(radius) + 1));
    const DenseSet dilated = dilatedByDefinition(set, radius, element);
    const MaskGrid::Ptr fast = dilate(*grid, radius, element);
    require(holds(*fast, dilated));
    require(holds(*erode(*grid, erodeRadius, element), erodedByDefinition(set, erodeRadius, element)));
    const DenseSet eroded = erodedByDefinition(dilated, erodeRadius, element);
    const MaskGrid::Ptr closed = closeMask(*grid, {radius, erodeRadius, element});
    require(holds(*closed, eroded));
    require(sameTree(*erode(*fast, erodeRadius, element), *closed));
    require(isSubset(*grid, *closed));
    if (more == 0) requireSimd(*grid, radius);
    if (more == 1) requireClosingByField(*grid, radius, ofField);
    return 0;
}
