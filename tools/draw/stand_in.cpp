// Based on: Rossignac and Borrel, Multi-resolution 3D approximations for rendering complex scenes, 1993 (clusters of
// points by the cells of a grid). Differs: a cluster's point is the mean.
#include <tools/draw/stand_in.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace vdbcage::draw {

namespace {

using openvdb::Vec3d;
using openvdb::Vec3I;

double areaOf(const Mesh& mesh, const std::vector<Vec3I>& triangles, double scale)
{
    double area = 0;
    for (const Vec3I& t : triangles) {
        const Vec3d a = mesh.points[t[0]] * scale;
        area += 0.5 * (mesh.points[t[1]] * scale - a).cross(mesh.points[t[2]] * scale - a).length();
    }
    return area;
}

struct Cluster {
    Vec3d sum{0};
    double count = 0;
};

/// Returns the mesh with the points of each cell of a grid merged. Cells are `size` wide, from `origin` on.
StandIn clustered(const Mesh& mesh, const std::vector<Vec3I>& triangles, const Vec3d& origin, double scale, double size)
{
    std::unordered_map<std::uint64_t, openvdb::Index32> cells;
    std::vector<Cluster> clusters;
    constexpr openvdb::Index32 none = ~openvdb::Index32(0);
    std::vector<openvdb::Index32> clusterOf(mesh.points.size(), none);
    const auto find = [&](openvdb::Index32 i) {
        if (clusterOf[i] != none) return clusterOf[i];
        std::uint64_t key = 0;
        const Vec3d p = (mesh.points[i] - origin) * scale;
        for (int k = 0; k < 3; ++k) key = key << 21 | static_cast<std::uint64_t>(std::max(0.0, p[k] / size));
        const auto cell = cells.emplace(key, static_cast<openvdb::Index32>(clusters.size())).first;
        if (cell->second == clusters.size()) clusters.emplace_back();
        clusters[cell->second].sum += p;
        clusters[cell->second].count += 1;
        return clusterOf[i] = cell->second;
    };
    std::vector<std::array<openvdb::Index32, 3>> faces;
    for (const Vec3I& t : triangles) {
        std::array<openvdb::Index32, 3> face{find(t[0]), find(t[1]), find(t[2])};
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        faces.push_back(face);
    }
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    StandIn result;
    for (const Cluster& cluster : clusters) {
        result.mesh.points.push_back(cluster.sum / (cluster.count * scale) + origin);
    }
    for (const auto& face : faces) result.mesh.triangles.emplace_back(face[0], face[1], face[2]);
    std::vector<double> least(clusters.size(), std::numeric_limits<double>::infinity());
    result.points.assign(clusters.size(), 0);
    for (openvdb::Index32 i = 0; i < mesh.points.size(); ++i) {
        const openvdb::Index32 cluster = clusterOf[i];
        if (cluster == none) continue;
        const double distance = ((mesh.points[i] - result.mesh.points[cluster]) * scale).lengthSqr();
        if (distance < least[cluster]) {
            least[cluster] = distance;
            result.points[cluster] = i;
        }
    }
    return result;
}

} // namespace

StandIn standIn(const Mesh& mesh, std::size_t mostTriangles)
{
    const auto itself = [&] {
        StandIn result{mesh, std::vector<openvdb::Index32>(mesh.points.size())};
        std::iota(result.points.begin(), result.points.end(), openvdb::Index32(0));
        return result;
    };
    const std::vector<Vec3I> triangles = triangulate(mesh);
    if (triangles.size() <= mostTriangles) return itself();
    const openvdb::BBoxd box = boundingBox(mesh);
    const Vec3d extents = box.extents();
    const double longest = std::max({extents.x(), extents.y(), extents.z()});
    // In a box of size 1 nothing overflows.
    const double scale = longest > 0 && std::isfinite(1 / longest) ? 1 / longest : 1;
    // A closed surface has two triangles in each cell that it runs through.
    double size = std::sqrt(2 * areaOf(mesh, triangles, scale) / static_cast<double>(mostTriangles));
    size = std::clamp(size, 1e-6, 1.0);
    for (;; size *= 1.3) {
        StandIn result = clustered(mesh, triangles, box.min(), scale, size);
        // A stand-in with no triangle would be invisible, which is worse than too many triangles.
        if (result.mesh.triangles.empty()) return itself();
        if (result.mesh.triangles.size() <= mostTriangles) return result;
    }
}

} // namespace vdbcage::draw
