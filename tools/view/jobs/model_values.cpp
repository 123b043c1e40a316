#include <tools/view/jobs/model_values.h>

#include <algorithm>
#include <cmath>

namespace vdbcage::view {

namespace {

using openvdb::Vec3d;

/// As a fraction of the cage's longest side: small enough for the normals of Green coordinates to change evenly, large
/// enough for single precision weights.
constexpr double relativeStep = 1e-3;
constexpr double mostStretch = 4;

std::vector<double> areasAround(const std::vector<openvdb::Vec3I>& triangles, const std::vector<Vec3d>& points)
{
    std::vector<double> areas(points.size(), 0);
    for (const openvdb::Vec3I& t : triangles) {
        const double area = (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).length();
        for (int k = 0; k < 3; ++k) areas[t[k]] += area;
    }
    return areas;
}

} // namespace

std::vector<double> influence(const Binding& binding, const std::vector<openvdb::Index32>& points)
{
    std::vector<double> values(binding.points().size(), 0);
    if (points.empty()) return values;
    const Vec3d extents = boundingBox(binding.cage()).extents();
    const double step = relativeStep * std::max({extents.x(), extents.y(), extents.z()});
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<Vec3d> cage = binding.cage().points;
        for (const openvdb::Index32 i : points) cage[i][axis] += step;
        const std::vector<Vec3d> posed = binding.pose(cage);
        for (std::size_t i = 0; i < values.size(); ++i) {
            values[i] += (posed[i][axis] - binding.points()[i][axis]) / (3 * step);
        }
    }
    return values;
}

std::vector<double> stretch(const Mesh& mesh, const std::vector<Vec3d>& posed)
{
    const std::vector<openvdb::Vec3I> triangles = triangulate(mesh);
    const std::vector<double> before = areasAround(triangles, mesh.points), after = areasAround(triangles, posed);
    std::vector<double> values(posed.size(), 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(before[i] > 0)) continue;
        values[i] = std::clamp(0.5 * std::log2(after[i] / before[i]), -mostStretch, mostStretch);
    }
    return values;
}

std::vector<double> cornersOf(const std::vector<std::uint32_t>& triangles, const Mesh& mesh)
{
    std::vector<double> values(mesh.points.size(), 0);
    const std::vector<openvdb::Vec3I> all = triangulate(mesh);
    for (const std::uint32_t triangle : triangles) {
        for (int k = 0; k < 3; ++k) values[all[triangle][k]] = 1;
    }
    return values;
}

} // namespace vdbcage::view
