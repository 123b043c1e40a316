#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include <vdbcage/mesh/mesh.h>

/// Functions that write a surface as another program might.
namespace vdbcage::test {

/// Returns a random order of 0, 1, 2 ...
inline std::vector<std::size_t> shuffled(std::size_t count, std::mt19937& random)
{
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::shuffle(order.begin(), order.end(), random);
    return order;
}

/// Returns the same faces, in another order and with other first corners.
inline Mesh withFacesShuffled(Mesh mesh, std::mt19937& random)
{
    const auto shuffle = [&](auto& faces) {
        std::shuffle(faces.begin(), faces.end(), random);
        for (auto& face : faces) {
            const auto before = face;
            const int turn = static_cast<int>(random() % 4);
            for (int i = 0; i < face.size; ++i) face[i] = before[(i + turn) % face.size];
        }
    };
    shuffle(mesh.triangles);
    shuffle(mesh.quads);
    return mesh;
}

/// Returns the same surface: point `order[i]` is now point i.
inline Mesh withPointsIn(const std::vector<std::size_t>& order, const Mesh& mesh)
{
    std::vector<openvdb::Index32> now(order.size());
    Mesh result;
    for (std::size_t i = 0; i < order.size(); ++i) {
        now[order[i]] = static_cast<openvdb::Index32>(i);
        result.points.push_back(mesh.points[order[i]]);
    }
    const auto renumber = [&](const auto& from, auto& to) {
        for (auto face : from) {
            for (int k = 0; k < face.size; ++k) face[k] = now[face[k]];
            to.push_back(face);
        }
    };
    renumber(mesh.triangles, result.triangles);
    renumber(mesh.quads, result.quads);
    renumber(mesh.alternatives, result.alternatives);
    return result;
}

/// Does all of these at once.
inline Mesh reordered(const Mesh& mesh, std::mt19937& random)
{
    return withFacesShuffled(withPointsIn(shuffled(mesh.points.size(), random), mesh), random);
}

/// Returns the mesh with some of its quads split, so that it looks different from each side. \pre eight quads or more
inline Mesh lopsided(Mesh mesh)
{
    const auto taken = [&](std::size_t quad) {
        const openvdb::Vec4I q = mesh.quads[quad];
        mesh.quads.erase(mesh.quads.begin() + static_cast<std::ptrdiff_t>(quad));
        return q;
    };
    for (int k = 0; k < 2; ++k) { // by a point in the middle
        const openvdb::Vec4I q = taken(0);
        const auto middle = static_cast<openvdb::Index32>(mesh.points.size());
        mesh.points.push_back((mesh.points[q[0]] + mesh.points[q[1]] + mesh.points[q[2]] + mesh.points[q[3]]) * 0.25);
        for (int i = 0; i < 4; ++i) mesh.triangles.emplace_back(q[i], q[(i + 1) % 4], middle);
    }
    const openvdb::Vec4I q = taken(5);
    mesh.triangles.emplace_back(q[0], q[1], q[2]);
    mesh.triangles.emplace_back(q[0], q[2], q[3]);
    return mesh;
}

} // namespace vdbcage::test
