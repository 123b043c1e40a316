#pragma once

#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <openvdb/math/Mat3.h>
#include <support/shapes.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/detail/triangles.h>
#include <vdbcage/mesh/mesh.h>

/// Cages around the origin, star-shaped from there, and points in them.
namespace vdbcage::test {

using openvdb::Vec3d;

class Random {
public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    double operator()(double low, double high) { return low + (high - low) * double(engine_()) / 4294967296.0; }
    Vec3d direction()
    {
        for (;;) {
            const Vec3d v((*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1));
            if (v.length() < 1 && v.length() > 0.1) return v / v.length();
        }
    }

private:
    std::mt19937 engine_;
};

inline double longestSide(const Mesh& mesh)
{
    const openvdb::BBoxd box = boundingBox(mesh);
    return box.extents()[static_cast<int>(box.maxExtent())];
}

enum class Kind { triangles, quads, both };
constexpr Kind kinds[] = {Kind::triangles, Kind::quads, Kind::both};

/// A ball of about radius 1 whose points are pushed in and out, so that no quad is planar; `fineness` squared times as
/// many faces.
inline Mesh randomCage(Kind kind, std::uint32_t seed, double bumps = 0.2, int fineness = 1)
{
    Mesh mesh;
    if (kind == Kind::quads) { // a box, its sides split, blown up
        const int n = 2 * fineness;
        const auto at = [&](int x, int y, int z) { // points inside the box stay unused
            return static_cast<openvdb::Index32>((x * (n + 1) + y) * (n + 1) + z);
        };
        for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
            mesh.points.emplace_back(i / (n + 1) / (n + 1) - 0.5 * n, i / (n + 1) % (n + 1) - 0.5 * n,
                                     i % (n + 1) - 0.5 * n);
        }
        for (int a = 0; a < n; ++a) {
            for (int b = 0; b < n; ++b) {
                mesh.quads.emplace_back(at(n, a, b), at(n, a + 1, b), at(n, a + 1, b + 1), at(n, a, b + 1));
                mesh.quads.emplace_back(at(0, a, b), at(0, a, b + 1), at(0, a + 1, b + 1), at(0, a + 1, b));
                mesh.quads.emplace_back(at(b, n, a), at(b, n, a + 1), at(b + 1, n, a + 1), at(b + 1, n, a));
                mesh.quads.emplace_back(at(b, 0, a), at(b + 1, 0, a), at(b + 1, 0, a + 1), at(b, 0, a + 1));
                mesh.quads.emplace_back(at(a, b, n), at(a + 1, b, n), at(a + 1, b + 1, n), at(a, b + 1, n));
                mesh.quads.emplace_back(at(a, b, 0), at(a, b + 1, 0), at(a + 1, b + 1, 0), at(a + 1, b, 0));
            }
        }
        for (Vec3d& p : mesh.points) {
            if (p.length() > 0) p *= 0.5 + 0.5 * fineness / p.length();
        }
    } else {
        mesh = sphere(Vec3d(0), 1, 4 * fineness);
        if (kind == Kind::triangles) mesh = {mesh.points, triangulate(mesh), {}};
    }
    Random random(seed);
    for (Vec3d& p : mesh.points) p *= 1 + random(-bumps, bumps);
    return mesh;
}

template <typename Map>
std::vector<Vec3d> mapped(std::vector<Vec3d> points, const Map& map)
{
    for (Vec3d& p : points) p = map(p);
    return points;
}

/// The points, each moved by up to `by` in any direction.
inline std::vector<Vec3d> jittered(std::vector<Vec3d> points, std::uint32_t seed, double by = 0.3)
{
    Random random(seed);
    return mapped(std::move(points), [&](const Vec3d& p) { return p + random(0, by) * random.direction(); });
}

/// A large one around any axis.
inline openvdb::Mat3d rotation(std::uint32_t seed)
{
    Random random(seed);
    openvdb::Mat3d matrix;
    matrix.setToRotation(random.direction(), random(1, 3));
    return matrix;
}

/// All families that reproduce points to rounding. Those that solve equations have tests of their own.
inline std::vector<Coordinates> exactFamilies()
{
    std::vector<Coordinates> list;
    for (const FamilyInfo& info : coordinateFamilies()) {
        const bool solves = info.family == Coordinates::harmonic || info.family == Coordinates::biharmonic;
        if (!solves) list.push_back(info.family);
    }
    return list;
}

/// "there are mvc, green, ...", as errors end.
inline std::string thereAreFamilies()
{
    std::string text;
    for (const FamilyInfo& info : coordinateFamilies())
        text += (text.empty() ? "there are " : ", ") + std::string(info.name);
    return text;
}

/// Whose inside the family knows: some split quads.
inline Mesh cageFor(Coordinates family, const Mesh& cage)
{
    const bool splits = familyInfo(family).splitsQuads;
    return splits ? Mesh{cage.points, detail::triangulateByShorterDiagonal(cage), {}} : cage;
}

/// The cage with one more point, the last: in the middle of the edge from corner 0 to 1 of triangle 4, times 1 +
/// `height`. The other triangle at this edge is split there. Triangle 4 keeps the whole edge, and a sliver closes the
/// gap, which has no area if `height` is 0.
inline Mesh withSliver(Mesh cage, double height)
{
    const openvdb::Vec3I t = cage.triangles.at(4);
    const auto middle = static_cast<openvdb::Index32>(cage.points.size());
    cage.points.push_back(0.5 * (cage.points[t[0]] + cage.points[t[1]]) * (1 + height));
    for (openvdb::Vec3I& other : cage.triangles) {
        for (int k = 0; k < 3; ++k) {
            if (other[k] != t[1] || other[(k + 1) % 3] != t[0]) continue;
            const openvdb::Index32 far = other[(k + 2) % 3];
            other = {t[1], middle, far};
            cage.triangles.emplace_back(middle, t[0], far);
            cage.triangles.emplace_back(t[1], t[0], middle);
            return cage;
        }
    }
    throw std::logic_error("the cage is not closed");
}

/// Points of the cage's volume, the last ones at 1e-9 from faces, edges and vertices.
inline std::vector<Vec3d> pointsInside(const Mesh& cage, std::uint32_t seed, int count = 20)
{
    Random random(seed);
    std::vector<Vec3d> points{Vec3d(0)};
    for (int i = 1; i < count; ++i) points.push_back(random(0, 0.6) * random.direction());
    const auto near = [&](const Vec3d& p) { points.push_back((1 - 1e-9) * p); };
    const auto& p = cage.points;
    for (int i = 0; i < 3; ++i) {
        const double u = random(0.1, 0.9), v = random(0.1, 0.9);
        if (!cage.triangles.empty()) {
            const openvdb::Vec3I t = cage.triangles[static_cast<std::size_t>(i) * 7 % cage.triangles.size()];
            near((1 - v) * ((1 - u) * p[t[0]] + u * p[t[1]]) + v * p[t[2]]);
            near((1 - u) * p[t[0]] + u * p[t[1]]);
            near(p[t[2]]);
        }
        if (!cage.quads.empty()) {
            const openvdb::Vec4I q = cage.quads[static_cast<std::size_t>(i) * 5 % cage.quads.size()];
            near((1 - v) * ((1 - u) * p[q[0]] + u * p[q[1]]) + v * ((1 - u) * p[q[3]] + u * p[q[2]]));
            near((1 - u) * p[q[2]] + u * p[q[3]]);
            near(p[q[1]]);
        }
    }
    return points;
}

/// Where row `i` of `coordinates` puts its point if the handles are at `handles`.
inline Vec3d weighted(const std::vector<double>& coordinates, std::size_t i, const std::vector<Vec3d>& handles)
{
    Vec3d sum(0);
    for (std::size_t k = 0; k < handles.size(); ++k) sum += coordinates[i * handles.size() + k] * handles[k];
    return sum;
}

} // namespace vdbcage::test
