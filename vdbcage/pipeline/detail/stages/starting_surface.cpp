#include <vdbcage/pipeline/detail/stages/starting_surface.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/mask_grid.h>
#include <vdbcage/pipeline/detail/stages/mesh_tools.h>
#include <vdbcage/pipeline/detail/stages/simple_solids.h>
#include <vdbcage/volume/convex_hull.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/mirror.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage::detail {

namespace {

/// Adds the voxels on the outer side of faces between voxels. Returns the number of new ones.
std::size_t addVoxelsOutside(const Mesh& surface, const std::vector<std::size_t>& faces,
                             const std::optional<openvdb::Mat3d>& axes, openvdb::MaskGrid& mask)
{
    auto voxels = mask.getAccessor();
    std::size_t added = 0;
    for (const std::size_t face : faces) {
        const openvdb::Vec4I& q = surface.quads[face - surface.triangles.size()];
        const auto corner = [&](int i) {
            const openvdb::Vec3d& p = surface.points[q[i]];
            return mask.worldToIndex(axes ? *axes * p : p);
        };
        const openvdb::Vec3d a = corner(0), b = corner(1), c = corner(2), d = corner(3);
        openvdb::Vec3d outward = (c - a).cross(d - b);
        outward.normalize();
        const auto voxel = openvdb::Coord::round(0.25 * (a + b + c + d) + 0.5 * outward);
        added += !voxels.isValueOn(voxel);
        voxels.setValueOn(voxel);
    }
    return added;
}

/// Returns the surface of a symmetric mask; the voxels added to make it well-composed are symmetric, too.
Mesh symmetricSurface(const openvdb::MaskGrid& mask, const SolidKey& voxels, Interrupter* interrupter)
{
    for (auto both = withMirrorImage(mask, voxels.plane->axis, voxels.resolution, interrupter);;) {
        const auto composed = makeWellComposed(*both, interrupter);
        both = withMirrorImage(*composed, voxels.plane->axis, voxels.resolution, interrupter);
        if (countOf(*both) == countOf(*composed)) return extractSurface(*composed, interrupter);
    }
}

} // namespace

StartingSurface startingSurface(std::shared_ptr<const Closing> closing, CageStart kind,
                                const std::optional<openvdb::Mat3d>& axes, std::shared_ptr<const Mesh> extracted,
                                const BoundingGuard& guard, Interrupter* interrupter)
{
    StartingSurface start;
    start.kind = kind;
    start.closing = std::move(closing);
    const SolidKey& voxels = start.closing->key.solid;
    const openvdb::MaskGrid::ConstPtr solid =
        kind == CageStart::hull ? convexHull(*start.closing->mask, interrupter) : start.closing->mask;
    const Stage stage(interrupter, StageName::surface);
    start.offsetVoxels = std::floor(guard.clearance() / solid->voxelSize()[0]);
    const auto grownBy = [&](double radius, const openvdb::MaskGrid& mask) {
        return dilate(mask, radius, StructuringElement::sphere, interrupter);
    };
    const auto turnedBack = [&](Mesh mesh) { return axes ? turned(std::move(mesh), axes->transpose()) : mesh; };
    openvdb::MaskGrid::Ptr mask; // the solid itself until it has to grow
    if (start.offsetVoxels > 0) mask = grownBy(start.offsetVoxels, *solid);
    if (mask || kind != CageStart::closing) extracted.reset();
    for (;;) {
        throwIfInterrupted(interrupter);
        const openvdb::MaskGrid& now = mask ? *mask : *solid;
        if (guard.symmetry()) {
            const Mesh whole = turnedBack(symmetricSurface(now, voxels, interrupter));
            start.surface = std::make_shared<const Mesh>(guard.symmetrized(whole, now.voxelSize()[0] / 4));
        } else if (extracted) {
            start.surface = std::exchange(extracted, nullptr); // of the solid as it is
        } else {
            start.surface = std::make_shared<const Mesh>(turnedBack(extractSurface(now, interrupter)));
        }
        const std::vector<std::size_t> tooNear = guard.facesTooNear(*start.surface);
        if (tooNear.empty()) break;
        if (!mask) mask = maskGridLike(*solid, maskTreeLike(solid->tree()));
        if (addVoxelsOutside(*start.surface, tooNear, axes, *mask) == 0) mask = grownBy(1, *mask);
    }
    start.topology = analyzeTopology(*start.surface, interrupter);
    return start;
}

StartingSurface simpleSolid(std::shared_ptr<const Closing> closing, CageStart kind, const Mesh& model,
                            const openvdb::Mat3d& axes, double thinnest, const BoundingGuard& guard,
                            Interrupter* interrupter)
{
    openvdb::BBoxd box = boundingBox(turned(model, axes));
    if (guard.symmetry()) box = boxWithMirrorImage(box, *guard.symmetry());
    const double least = thinnest * longestSide(box);
    for (const int axis : {0, 1, 2}) {
        const double lacking = std::max(0.0, least - box.extents()[axis]);
        box.min()[axis] -= lacking / 2;
        box.max()[axis] += lacking / 2;
    }
    StartingSurface start;
    start.kind = kind;
    start.closing = std::move(closing);
    for (double margin = 2 * guard.clearance();; margin *= 2) {
        throwIfInterrupted(interrupter);
        openvdb::BBoxd wider = box;
        wider.expand(margin);
        Mesh mesh = turned(kind == CageStart::tetrahedron ? tetrahedronMesh(wider) : boxMesh(wider), axes.transpose());
        if (guard.symmetry()) mesh = guard.symmetrized(mesh, 0);
        start.surface = std::make_shared<const Mesh>(std::move(mesh));
        if (guard.facesTooNear(*start.surface).empty()) break;
    }
    start.topology = analyzeTopology(*start.surface, interrupter);
    return start;
}

} // namespace vdbcage::detail
