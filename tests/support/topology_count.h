#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

/// The topology of a surface by the plainest counts; independent of the library's own.
struct TopologyCount {
    std::size_t points = 0, edges = 0, faces = 0; // points used by faces; quads count once
    std::size_t openEdges = 0;                    // without exactly one face on each side
    std::size_t splitPoints = 0;                  // whose faces form more than one umbrella
    std::size_t parts = 0;                        // connected over edges
    double volume = 0, area = 0;                  // quads split by the diagonal of corners 0 and 2

    bool closedManifold() const { return faces > 0 && openEdges == 0 && splitPoints == 0; }
    long euler() const { return long(points) - long(edges) + long(faces); }
    long genus() const { return (2 * long(parts) - euler()) / 2; }
};

inline std::vector<std::vector<openvdb::Index32>> polygons(const Mesh& mesh)
{
    std::vector<std::vector<openvdb::Index32>> faces;
    for (const auto& f : mesh.triangles) faces.push_back({f[0], f[1], f[2]});
    for (const auto& f : mesh.quads) faces.push_back({f[0], f[1], f[2], f[3]});
    return faces;
}

inline TopologyCount countTopology(const Mesh& mesh)
{
    TopologyCount count;
    const auto faces = polygons(mesh);
    count.faces = faces.size();
    std::map<std::pair<unsigned, unsigned>, std::vector<std::size_t>> sides;  // directed edge -> faces
    std::map<unsigned, std::vector<std::pair<unsigned, unsigned>>> umbrellas; // point -> (from, to) of each face at it
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const std::size_t n = faces[f].size();
        for (std::size_t i = 0; i < n; ++i) {
            sides[{faces[f][i], faces[f][(i + 1) % n]}].push_back(f);
            umbrellas[faces[f][i]].emplace_back(faces[f][(i + 1) % n], faces[f][(i + n - 1) % n]);
        }
    }
    count.points = umbrellas.size();
    std::vector<std::size_t> part(faces.size());
    std::iota(part.begin(), part.end(), std::size_t(0));
    const auto root = [&](std::size_t f) {
        while (part[f] != f) f = part[f] = part[part[f]];
        return f;
    };
    std::set<std::pair<unsigned, unsigned>> edges;
    for (const auto& [side, users] : sides) {
        edges.insert(std::minmax(side.first, side.second));
        const auto other = sides.find({side.second, side.first});
        if (users.size() != 1 || other == sides.end() || other->second.size() != 1) {
            ++count.openEdges;
        } else {
            part[root(users[0])] = root(other->second[0]);
        }
    }
    count.edges = edges.size();
    for (std::size_t f = 0; f < faces.size(); ++f) count.parts += root(f) == f;
    for (const auto& [point, umbrella] : umbrellas) {
        std::map<unsigned, unsigned> next(umbrella.begin(), umbrella.end());
        unsigned at = umbrella.front().first;
        std::size_t steps = 0;
        do {
            const auto step = next.find(at);
            if (step == next.end()) break;
            at = step->second;
            ++steps;
        } while (at != umbrella.front().first && steps < umbrella.size());
        count.splitPoints += steps != umbrella.size();
    }
    for (const openvdb::Vec3I& t : triangulate(mesh)) {
        const openvdb::Vec3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        count.volume += (a - mesh.points[0]).dot((b - mesh.points[0]).cross(c - mesh.points[0])) / 6;
        count.area += (b - a).cross(c - a).length() / 2;
    }
    return count;
}

/// Returns all angles of the triangles in degrees (quads split by the diagonal of corners 0 and 2), ascending.
inline std::vector<double> sortedAngles(const Mesh& mesh)
{
    std::vector<double> angles;
    for (const openvdb::Vec3I& t : triangulate(mesh)) {
        for (int i = 0; i < 3; ++i) {
            const openvdb::Vec3d& p = mesh.points[t[i]];
            const openvdb::Vec3d a = mesh.points[t[(i + 1) % 3]] - p, b = mesh.points[t[(i + 2) % 3]] - p;
            angles.push_back(std::atan2(a.cross(b).length(), a.dot(b)) * 180 / detail::pi);
        }
    }
    std::sort(angles.begin(), angles.end());
    return angles;
}

} // namespace vdbcage::test
