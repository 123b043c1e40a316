#include <tools/view/jobs/intermediates.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

/// Returns the voxels' faces; none if there are too many to extract, which must not prevent the cage.
Mesh facesOf(const openvdb::MaskGrid& grid, Interrupter* interrupter)
{
    try {
        return extractSurface(grid, interrupter);
    } catch (const InputError&) {
        return {};
    }
}

void addBox(const openvdb::CoordBBox& box, const openvdb::math::Transform& transform, Mesh& mesh)
{
    const auto first = static_cast<openvdb::Index32>(mesh.points.size());
    for (int i = 0; i < 8; ++i) {
        // A voxel reaches half a step to both sides of its centre.
        const Vec3d low = box.min().asVec3d() - Vec3d(0.5), high = box.max().asVec3d() + Vec3d(0.5);
        const Vec3d corner((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                           (i & 4) != 0 ? high.z() : low.z());
        mesh.points.push_back(transform.indexToWorld(corner));
    }
    constexpr std::array<std::array<openvdb::Index32, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& side : sides) {
        mesh.quads.emplace_back(first + side[0], first + side[1], first + side[2], first + side[3]);
    }
}

Mesh nodesOf(const openvdb::MaskGrid& grid)
{
    Mesh mesh;
    for (auto node = grid.tree().cbeginNode(); node; ++node) {
        if (node.getDepth() == 0) continue;
        openvdb::CoordBBox box;
        node.getBoundingBox(box);
        addBox(box, grid.transform(), mesh);
    }
    return mesh;
}

/// Cuts a triangle into n^2 parts.
void addCut(const std::array<Vec3d, 3>& corners, int n, Mesh& mesh)
{
    const auto first = static_cast<openvdb::Index32>(mesh.points.size());
    // Row i has i + 1 points.
    const auto at = [&](int i, int j) { return first + static_cast<openvdb::Index32>(i * (i + 1) / 2 + j); };
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double b = 1.0 * (i - j) / n, c = 1.0 * j / n;
            mesh.points.push_back((1 - b - c) * corners[0] + b * corners[1] + c * corners[2]);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j <= i; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            if (j < i) mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
}

} // namespace

DistanceMap measureDistances(const Mesh& cage, const detail::TriangleBvh& model)
{
    DistanceMap map;
    const std::vector<openvdb::Vec3I> triangles = triangulate(cage);
    const double wanted = std::sqrt(40000.0 / std::max<double>(1, static_cast<double>(triangles.size())));
    const int n = std::clamp(static_cast<int>(std::lround(wanted)), 1, 32);
    for (const openvdb::Vec3I& t : triangles) {
        addCut({cage.points[t[0]], cage.points[t[1]], cage.points[t[2]]}, n, map.mesh);
    }
    std::uint32_t near = detail::TriangleBvh::none;
    for (const Vec3d& point : map.mesh.points) {
        const auto closest = model.closest(point, near);
        near = closest.item;
        map.distances.push_back(static_cast<float>(std::sqrt(closest.squaredDistance)));
    }
    return map;
}

Intermediates intermediatesOf(const Pipeline& pipeline, const detail::TriangleBvh& model, Interrupter* interrupter)
{
    Intermediates made;
    made.solid = pipeline.solid();
    made.closed = pipeline.closed();
    made.solidFaces = facesOf(*made.solid, interrupter);
    made.closedFaces = facesOf(*made.closed, interrupter);
    made.solidNodes = nodesOf(*made.solid);
    made.closedNodes = nodesOf(*made.closed);
    made.surface = pipeline.surface();
    made.smoothed = pipeline.smoothed();
    made.decimated = pipeline.decimated();
    made.distance = measureDistances(pipeline.cage(), model);
    return made;
}

} // namespace vdbcage::view
