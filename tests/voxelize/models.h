#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <support/shapes.h>

/// Models that are hard to voxelize, each with a resolution at which it is.
namespace vdbcage::test {

struct HardModel {
    std::string name;
    Mesh mesh;
    int resolution;
};

inline std::ostream& operator<<(std::ostream& out, const HardModel& model)
{
    return out << model.name;
}

/// Triangles and quads between random points of a cube of this side; some of them degenerate. With `whole` the
/// coordinates are whole numbers, and 0 and `side` are among them.
inline Mesh soup(std::uint32_t seed, int triangles, int quads, double side, bool whole)
{
    std::mt19937 random(seed);
    const auto coordinate = [&] {
        const double value = side * double(random()) / double(random.max());
        return whole ? std::round(value) : value;
    };
    Mesh mesh;
    mesh.points = {openvdb::Vec3d(0), openvdb::Vec3d(side)};
    for (int i = 0; i < 3 * triangles / 2; ++i) {
        const double x = coordinate(), y = coordinate();
        mesh.points.emplace_back(x, y, coordinate());
    }
    const auto corner = [&] { return static_cast<openvdb::Index32>(random() % mesh.points.size()); };
    mesh.triangles.emplace_back(0U, 1U, 2U);
    for (int i = 0; i < triangles; ++i) {
        const openvdb::Index32 a = corner(), b = corner();
        mesh.triangles.emplace_back(a, b, i % 8 == 0 ? a : corner());
    }
    for (int i = 0; i < quads; ++i) {
        const openvdb::Index32 a = corner(), b = corner(), c = corner();
        mesh.quads.emplace_back(a, b, c, corner());
    }
    return mesh;
}

/// The half of a sphere below its centre, open at the top.
inline Mesh bowl(double radius, int rings)
{
    Mesh mesh = sphere(openvdb::Vec3d(0), radius, rings), half;
    half.points = mesh.points;
    const auto below = [&](openvdb::Index32 i) { return mesh.points[i].z() < 0.01 * radius; };
    for (const auto& t : mesh.triangles) {
        if (below(t[0]) && below(t[1]) && below(t[2])) half.triangles.push_back(t);
    }
    for (const auto& q : mesh.quads) {
        if (below(q[0]) && below(q[1]) && below(q[2]) && below(q[3])) half.quads.push_back(q);
    }
    return half;
}

/// `mesh` with every second face turned round.
inline Mesh halfReversed(Mesh mesh)
{
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    for (std::size_t i = 0; i < mesh.quads.size(); i += 2) std::swap(mesh.quads[i][0], mesh.quads[i][2]);
    return mesh;
}

/// Triangles in a fan, each `aspect` times longer than wide, in no special direction.
inline Mesh needles(int count, double aspect)
{
    Mesh mesh;
    for (int i = 0; i < count; ++i) {
        const double angle = 0.1 + 2.4 * i;
        const openvdb::Vec3d end(std::cos(angle), std::sin(angle), std::cos(1.7 * i)), side(-end.y(), end.z(), end.x());
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), {0.1 * end, end, end + side / aspect});
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

inline std::vector<HardModel> hardModels()
{
    using openvdb::Vec3d;
    Mesh triangle;
    triangle.points = {{0.1, 0.2, 0.3}, {5.3, 1.9, 2.2}, {1.4, 4.4, 7.1}};
    triangle.triangles = {{0, 1, 2}};
    Mesh sheet; // one cell thick along y
    sheet.points = {{0, 2, 0}, {16, 2, 0}, {16, 2, 11}, {0, 2, 11}};
    sheet.quads = {{0, 1, 2, 3}};
    Mesh tilted = sheet;
    for (Vec3d& p : tilted.points) p = Vec3d(p.x() + 0.3 * p.z(), 0.2 * p.x() - 0.4 * p.z(), p.z());
    Mesh degenerate; // a triangle, a segment along no axis, one along an axis, and two points
    degenerate.points = {{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {1, 2, 3}, {3, 6, 9}, {2, 4, 6}, {5, 5, 1}, {5, 5, 12}};
    degenerate.triangles = {{0, 1, 2}, {3, 4, 5}, {6, 7, 6}, {7, 7, 7}, {4, 4, 4}};
    Mesh saddle;
    saddle.points = {{0, 0, 0}, {10, 0, 6}, {10, 10, 0}, {0, 10, 6}};
    saddle.quads = {{0, 1, 2, 3}};
    Mesh pyramid; // faces of more than 64 voxels
    pyramid.points = {{0, 0, 0}, {1, 0.1, 0.2}, {0.1, 0.9, 0.3}, {0.3, 0.2, 0.8}};
    pyramid.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Mesh ball = sphere(Vec3d(0.3, 0.1, -0.2), 1, 8);
    return {
        {"triangle", triangle, 20},
        {"triangle in one voxel", triangle, 1},
        {"sheet", sheet, 16},
        {"tilted sheet", tilted, 31},
        {"degenerate faces", degenerate, 24},
        {"saddle quad", saddle, 30},
        {"sphere", ball, 25},
        {"pyramid", pyramid, 80},
        {"sphere, half reversed", halfReversed(ball), 24},
        {"box on voxel centres", box(Vec3d(0), Vec3d(8, 6, 4)), 8},
        {"box on voxel borders", box(Vec3d(0), Vec3d(8, 5, 3)), 8},
        {"box, odd resolution", box(Vec3d(-1), Vec3d(7, 4, 1.7)), 13},
        {"thin along x", box(Vec3d(0), Vec3d(0.01, 1, 1)), 33},
        {"thin along z", box(Vec3d(0), Vec3d(1, 1, 0.01)), 33},
        {"torus", torus(1, 0.4, 16, 8), 28},
        {"bowl", bowl(1, 10), 24},
        {"nested shells", joined(ball, transformed(sphere(Vec3d(0.3, 0.1, -0.2), 1, 6), 0.5, Vec3d(0.15))), 24},
        {"overlapping spheres", joined(ball, transformed(ball, 0.8, Vec3d(0.7, 0.2, 0.1))), 25},
        {"a sphere twice", joined(ball, ball), 21},
        {"needles", needles(12, 1e4), 40},
        {"soup", soup(1, 60, 10, 1.7, false), 22},
        {"soup of small triangles", soup(2, 400, 0, 1, false), 6},
        {"soup on voxel centres", soup(3, 40, 10, 12, true), 12},
        {"soup on voxel borders and centres", soup(4, 40, 10, 7, true), 14},
        {"larger soup on voxel centres", soup(5, 6, 2, 66, true), 66},
    };
}

} // namespace vdbcage::test
