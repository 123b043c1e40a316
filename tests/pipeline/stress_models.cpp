#include "stress_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include <support/shapes.h>
#include <vdbcage/core/detail/pi.h>

namespace vdbcage::test {

namespace {

using openvdb::Index32;
using openvdb::Vec3d;

using detail::pi;

/// Only what the engine itself gives, since the standard's distributions differ between libraries. For the same reason
/// no expression below asks twice but in braces, which keep the order.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// 0 to 1.
    double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    int below(int count) { return static_cast<int>(unit() * count); }
    /// In the cube from -half to half.
    Vec3d point(double half)
    {
        const double x = between(-half, half), y = between(-half, half);
        return {x, y, between(-half, half)};
    }
    Vec3d direction()
    {
        Vec3d p = point(1);
        while (p.lengthSqr() > 1 || p.lengthSqr() < 0.01) p = point(1);
        p.normalize();
        return p;
    }

private:
    std::mt19937_64 engine_;
};

/// The entry of a family's list of parameters for its i-th model.
template <typename Value, std::size_t count>
Value pick(const Value (&values)[count], int i)
{
    return values[static_cast<std::size_t>(i) % count];
}

void addTriangle(Mesh& mesh, const Vec3d& a, const Vec3d& b, const Vec3d& c)
{
    const auto first = static_cast<Index32>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

void addTetrahedron(Mesh& mesh, const std::array<Vec3d, 4>& p)
{
    const auto first = static_cast<Index32>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), p.begin(), p.end());
    for (const openvdb::Vec3I& t :
         {openvdb::Vec3I(0, 2, 1), openvdb::Vec3I(0, 1, 3), openvdb::Vec3I(1, 2, 3), openvdb::Vec3I(2, 0, 3)}) {
        mesh.triangles.push_back(t + openvdb::Vec3I(first));
    }
}

void add(Mesh& mesh, const Mesh& other)
{
    mesh = joined(std::move(mesh), other);
}

void addBox(Mesh& mesh, const Vec3d& low, const Vec3d& high)
{
    add(mesh, box(low, high));
}

void turnInsideOut(Mesh& mesh)
{
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    for (auto& q : mesh.quads) std::swap(q[0], q[2]);
}

/// x, y, z become y, z, x.
Mesh turned(Mesh mesh)
{
    for (Vec3d& p : mesh.points) p = {p.y(), p.z(), p.x()};
    return mesh;
}

Mesh rotatedAtRandom(Mesh mesh, Random& random)
{
    const Vec3d x = random.direction(), other = random.direction();
    Vec3d z = x.cross(other);
    z.normalize();
    const Vec3d y = z.cross(x);
    for (Vec3d& p : mesh.points) p = p.x() * x + p.y() * y + p.z() * z;
    return mesh;
}

/// An open sheet of `columns` x `rows` quads through surface(u, v), u and v from 0 to 1.
Mesh sheet(int columns, int rows, const std::function<Vec3d(double, double)>& surface)
{
    Mesh mesh;
    for (int i = 0; i <= columns; ++i) {
        for (int j = 0; j <= rows; ++j) {
            mesh.points.push_back(surface(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<Index32>(i * (rows + 1) + j); };
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) mesh.quads.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return mesh;
}

/// A tube around a closed curve, t from 0 to 1; where it closes, it is as twisted as its frame has become.
Mesh closedTube(const std::function<Vec3d(double)>& curve, double radius, int along, int across)
{
    Mesh mesh;
    Vec3d side(0.3, 0.5, 0.8);
    for (int i = 0; i < along; ++i) {
        const double t = static_cast<double>(i) / along;
        Vec3d tangent = curve(t + 1e-4) - curve(t - 1e-4);
        tangent.normalize();
        side -= side.dot(tangent) * tangent;
        side.normalize();
        const Vec3d up = tangent.cross(side);
        for (int j = 0; j < across; ++j) {
            const double angle = 2 * pi * j / across;
            mesh.points.push_back(curve(t) + radius * (std::cos(angle) * side + std::sin(angle) * up));
        }
    }
    const auto at = [&](int i, int j) { return static_cast<Index32>((i % along) * across + j % across); };
    for (int i = 0; i < along; ++i) {
        for (int j = 0; j < across; ++j)
            mesh.quads.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    return mesh;
}

// The families. Each makes its i-th model, about as large as the unit cube; i goes from 0 up.

Mesh soup(Random& random, int i)
{
    const int count = pick({10, 30, 100, 300, 1000, 3000}, i);
    const double size = pick({2.0, 0.3, 0.05}, i / 2);
    Mesh mesh;
    for (int k = 0; k < count; ++k) {
        const Vec3d centre = random.point(0.5);
        const Vec3d a = random.point(size / 2), b = random.point(size / 2);
        addTriangle(mesh, centre + a, centre + b, centre + random.point(size / 2));
    }
    return mesh;
}

Mesh needles(Random& random, int i)
{
    const double aspect = pick({1e2, 1e3, 1e4, 1e5, 1e6}, i);
    const int count = pick({1, 5, 40, 200}, i);
    Mesh mesh;
    for (int k = 0; k < count; ++k) {
        const Vec3d start = random.point(0.5), end = random.point(0.5);
        addTriangle(mesh, start, end, end + (end - start).length() / aspect * random.direction());
    }
    return mesh;
}

Mesh dust(Random& random, int i)
{
    const int count = pick({2, 20, 200, 1000}, i);
    const double size = pick({1e-2, 1e-4, 1e-6}, i);
    Mesh mesh;
    for (int k = 0; k < count; ++k) {
        const Vec3d a = random.point(0.5), b = a + size * random.direction(), c = a + size * random.direction();
        if (i % 2 == 0) {
            addTriangle(mesh, a, b, c);
        } else {
            addTetrahedron(mesh, {a, b, c, a + size * random.direction()});
        }
    }
    return mesh;
}

Mesh nestedShells(Random& random, int i)
{
    Mesh mesh;
    double radius = 1;
    for (int shell = 0; shell < 2 + i % 5; ++shell) {
        Mesh next =
            (i + shell) % 3 == 0 ? box(Vec3d(-0.57 * radius), Vec3d(0.57 * radius)) : sphere(Vec3d(0), radius, 8);
        if (random.below(2) == 0) turnInsideOut(next);
        add(mesh, next);
        radius *= pick({0.9, 0.5, 0.999, 0.999999}, i);
    }
    return mesh;
}

Mesh closeSheets(Random& random, int i)
{
    const double distance = pick({1e-3, 1e-5, 1e-7, 1e-9, 0.0}, i);
    Mesh mesh;
    for (int layer = 0; layer < 2 + i % 4; ++layer) {
        const double tilt = distance * random.between(-1, 1);
        add(mesh,
            sheet(1 + i % 6, 1 + layer, [&](double u, double v) { return Vec3d(u, v, layer * distance + u * tilt); }));
    }
    return mesh;
}

Mesh coplanarTriangles(Random& random, int i)
{
    const double depth = pick({0.0, 1e-9, 1e-6}, i);
    Mesh mesh;
    for (int k = 0; k < pick({2, 10, 60, 300}, i); ++k) {
        const auto corner = [&] {
            const Vec3d p = random.point(0.5);
            return Vec3d(p.x(), p.y(), depth * p.z());
        };
        const Vec3d a = corner(), b = corner();
        addTriangle(mesh, a, b, corner());
    }
    return mesh;
}

Mesh touchingBoxes(Random& random, int i)
{
    const int side = 2 + i / 4 % 3;
    Mesh mesh;
    for (int x = 0; x < side; ++x) {
        for (int y = 0; y < side; ++y) {
            for (int z = 0; z < side; ++z) {
                // All of them: faces touch. Every second: edges. A diagonal: corners. By chance: all of these.
                const bool there = i % 4 == 0   ? true
                                   : i % 4 == 1 ? (x + y + z) % 2 == 0
                                   : i % 4 == 2 ? x == y && y == z
                                                : random.below(3) == 0;
                if (there || x + y + z == 0) addBox(mesh, Vec3d(x, y, z), Vec3d(x + 1, y + 1, z + 1));
            }
        }
    }
    return mesh;
}

Mesh stacks(Random& random, int i)
{
    // Boxes of different sizes on one another, apart by nothing or by next to nothing.
    const double gap = pick({0.0, 1e-12, 1e-6, -1e-6}, i);
    Mesh mesh;
    double top = 0;
    for (int k = 0; k < 2 + i; ++k) {
        const Vec3d size{random.between(0.2, 1), random.between(0.2, 1), random.between(0.02, 0.3)};
        const Vec3d low{random.between(-0.2, 0.2), random.between(-0.2, 0.2), top};
        addBox(mesh, low, low + size);
        top += size.z() + gap;
    }
    return mesh;
}

Mesh openShells(Random& random, int i)
{
    const double arc = random.between(0.2, 0.95);
    return sheet(12, 24, [&](double u, double v) {
        const double around = 2 * pi * v, polar = pi * arc * u;
        if (i % 3 == 0) // a bowl: a dish to nearly a ball
            return Vec3d(std::sin(polar) * std::cos(around), std::sin(polar) * std::sin(around), std::cos(polar));
        if (i % 3 == 1) // a part of a cylinder's wall
            return Vec3d(std::cos(arc * around), std::sin(arc * around), 3 * arc * u);
        return Vec3d(u * std::cos(arc * around), u * std::sin(arc * around), 2 * u); // a part of a cone
    });
}

Mesh moebiusBands(Random& random, int i)
{
    const int halfTwists = pick({1, 3, 2, 7}, i);
    const double width = random.between(0.05, 0.9);
    return sheet(64, 4, [&](double u, double v) {
        const double around = 2 * pi * u, twist = pi * halfTwists * u, across = width * (v - 0.5);
        const double reach = 1 + across * std::cos(twist);
        return Vec3d(reach * std::cos(around), reach * std::sin(around), across * std::sin(twist));
    });
}

Mesh knots(Random& random, int i)
{
    const int p = pick({2, 3, 2, 5}, i), q = pick({3, 4, 7, 6}, i);
    // Thick ones run into themselves.
    const double radius = pick({0.02, 0.15, 0.4, 1e-4}, i / 2), sway = random.between(0.3, 0.6);
    return closedTube(
        [&](double t) {
            const double around = 2 * pi * p * t, across = 2 * pi * q * t, reach = 1 + sway * std::cos(across);
            return Vec3d(reach * std::cos(around), reach * std::sin(around), sway * std::sin(across));
        },
        radius, 96, 6);
}

Mesh lattices(Random& random, int i)
{
    const int cells = 1 + i % 4;
    const double half = pick({0.02, 0.1, 0.3, 1e-4}, i) * random.between(0.8, 1.2);
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis) {
        for (int a = 0; a <= cells; ++a) {
            for (int b = 0; b <= cells; ++b) {
                Vec3d low, high;
                low[axis] = -half;
                high[axis] = cells + half;
                low[(axis + 1) % 3] = a - half;
                high[(axis + 1) % 3] = a + half;
                low[(axis + 2) % 3] = b - half;
                high[(axis + 2) % 3] = b + half;
                addBox(mesh, low, high);
            }
        }
    }
    return mesh;
}

Mesh urchins(Random& random, int i)
{
    const double thickness = pick({0.1, 0.02, 1e-3, 1e-5}, i);
    Mesh mesh = sphere(Vec3d(0), 0.3, 6);
    for (int k = 0; k < pick({5, 30, 150}, i); ++k) {
        const Vec3d out = random.direction(), a = random.direction(), b = random.direction();
        const Vec3d root = 0.29 * out;
        addTetrahedron(mesh, {root + thickness * a, root + thickness * b, root - thickness * (a + b),
                              random.between(0.4, 1) * out});
    }
    return mesh;
}

Mesh platesWithHoles(Random& random, int i)
{
    const int cells = pick({3, 5, 9, 16}, i);
    const double thickness = pick({0.0, 0.02, 1e-4, 1e-8}, i / 2);
    Mesh mesh;
    for (int x = 0; x < cells; ++x) {
        for (int y = 0; y < cells; ++y) {
            const bool hole = i % 2 == 0 ? x % 2 == 1 && y % 2 == 1 : random.below(3) == 0;
            if (hole && x + y > 0) continue;
            if (thickness > 0) {
                addBox(mesh, Vec3d(x, y, 0), Vec3d(x + 1, y + 1, thickness * cells));
            } else {
                add(mesh, sheet(1, 1, [&](double u, double v) { return Vec3d(x + u, y + v, 0); }));
            }
        }
    }
    return mesh;
}

Mesh combs(Random& random, int i)
{
    const int teeth = pick({2, 6, 20, 60}, i);
    const double width = pick({0.5, 0.1, 0.9, 0.999}, i / 2) / teeth;
    Mesh mesh = box(Vec3d(0, -0.1, 0), Vec3d(1, 0, 0.1));
    for (int k = 0; k < teeth; ++k) {
        const double x = static_cast<double>(k) / teeth;
        addBox(mesh, Vec3d(x, 0, 0), Vec3d(x + width, random.between(0.5, 1), 0.1));
    }
    return mesh;
}

Mesh chains(Random& random, int i)
{
    const double tube = pick({0.05, 0.15, 0.3, 0.005}, i);
    const Mesh link = torus(1, tube, 24, 6);
    Mesh mesh;
    for (int k = 0; k < 2 + i / 2; ++k) {
        const double wave = 0.3 * tube * random.unit();
        add(mesh, transformed(k % 2 == 0 ? link : turned(turned(link)), 1, Vec3d(1.3 * k, wave, -wave)));
    }
    return mesh;
}

Mesh singleFaces(Random& random, int i)
{
    Mesh mesh;
    if (i % 4 == 0) { // any triangle
        const Vec3d a = random.point(1), b = random.point(1);
        addTriangle(mesh, a, b, random.point(1));
    } else if (i % 4 == 1) { // one with its corners nearly on a line
        addTriangle(mesh, Vec3d(0), Vec3d(1, 0, 0), Vec3d(random.unit(), pick({1e-3, 1e-6, 1e-10}, i / 4), 0));
    } else if (i % 4 == 2) { // a flat polygon, as a star
        const int corners = pick({5, 17, 100}, i / 4);
        mesh.points.emplace_back(0);
        for (int k = 0; k <= corners; ++k) {
            const double angle = 2 * pi * k / corners;
            mesh.points.emplace_back(std::cos(angle), std::sin(angle), 0);
            if (k > 0) mesh.triangles.emplace_back(0, k, k + 1);
        }
    } else { // a quad that is no plane
        mesh.points = {{0, 0, 0}, {1, 0, random.unit()}, {1, 1, 0}, {0, 1, random.unit()}};
        mesh.quads = {{0, 1, 2, 3}};
    }
    return mesh;
}

Mesh brokenFaces(Random& random, int i)
{
    Mesh mesh = i % 2 == 0 ? sphere(Vec3d(0), 1, 8) : torus(1, 0.4, 20, 8);
    const auto corner = [&] { return static_cast<Index32>(random.below(static_cast<int>(mesh.points.size()))); };
    const std::vector<openvdb::Vec4I> quads = mesh.quads;
    mesh.quads.clear();
    for (const openvdb::Vec4I& quad : quads) {
        const int what = random.below(6);
        if (what > 0) mesh.quads.push_back(quad); // else it is missing
        if (what == 1) mesh.quads.push_back(quad);
        if (what == 2) std::swap(mesh.quads.back()[0], mesh.quads.back()[2]);
        if (what == 3) mesh.quads.emplace_back(quad[0], quad[2], quad[1], quad[3]);
        if (what == 4) mesh.triangles.emplace_back(quad[0], quad[0], corner());
        if (what == 5) mesh.triangles.emplace_back(quad[3], quad[3], quad[3]);
    }
    mesh.points.push_back(random.point(100)); // no face uses it
    return mesh;
}

Mesh sizeContrasts(Random& random, int i)
{
    const double size = pick({1e-2, 1e-4, 1e-6}, i);
    const Mesh tiny = transformed(i % 2 == 0 ? torus(1, 0.4, 24, 12) : sphere(Vec3d(0), 1, 12), size, Vec3d(0));
    const Vec3d place = random.point(0.5);
    Mesh mesh;
    switch (i % 5) {
    case 0: // inside
        mesh = box(Vec3d(-1), Vec3d(1));
        break;
    case 1: // outside of everything, nearby
        mesh = transformed(box(Vec3d(-1), Vec3d(1)), 1, Vec3d(1.5 + 2 * size, 0, 0));
        break;
    case 2: // across the surface
        mesh = box(Vec3d(-1, -1, -1), Vec3d(1, 1, place.z()));
        break;
    case 3: // as far as it can be
        mesh = transformed(tiny, 1, Vec3d(1));
        break;
    default: // at the tip of something thin
        addTriangle(mesh, place, place + Vec3d(1, 0, 0), place + Vec3d(1, size / 10, 0));
    }
    add(mesh, transformed(tiny, 1, place));
    return mesh;
}

Mesh scrolls(Random& random, int i)
{
    // Rolled sheets; the turns come near to each other.
    const double turns = random.between(1.2, 8), flat = pick({1.0, 0.05, 2.0}, i);
    return sheet(160, 2, [&](double u, double v) {
        const double angle = 2 * pi * turns * u, reach = 0.05 + 0.95 * u;
        return Vec3d(reach * std::cos(angle), reach * std::sin(angle), flat * v);
    });
}

Mesh sponges(Random& random, int i)
{
    // Menger's sponge (boxes that share faces) and Sierpinski's tetrahedron (tetrahedra that share corners).
    std::vector<std::pair<Vec3d, double>> cells{{Vec3d(0), 1.0}};
    const bool tetrahedra = i % 2 == 1;
    for (int level = 0; level < 1 + i / 2 % (tetrahedra ? 5 : 2); ++level) {
        std::vector<std::pair<Vec3d, double>> finer;
        for (const auto& cell : cells) {
            const double size = cell.second / (tetrahedra ? 2 : 3);
            for (int k = 0; k < (tetrahedra ? 8 : 27); ++k) {
                const openvdb::Vec3i at =
                    tetrahedra ? openvdb::Vec3i(k & 1, k >> 1 & 1, k >> 2) : openvdb::Vec3i(k % 3, k / 3 % 3, k / 9);
                const auto middles = (at[0] == 1) + (at[1] == 1) + (at[2] == 1);
                if (tetrahedra ? middles % 2 == 1 : middles >= 2) continue;
                finer.emplace_back(cell.first + size * Vec3d(at), size);
            }
        }
        cells = finer;
    }
    Mesh mesh;
    for (const auto& [low, size] : cells) {
        if (random.below(10) == 0 && cells.size() > 20) continue; // some damage
        if (tetrahedra) {
            addTetrahedron(mesh,
                           {low, low + Vec3d(size, size, 0), low + Vec3d(size, 0, size), low + Vec3d(0, size, size)});
        } else {
            addBox(mesh, low, low + Vec3d(size));
        }
    }
    return mesh;
}

Mesh terrains(Random& random, int i)
{
    const int cells = pick({4, 12, 30}, i);
    const double height = pick({0.05, 0.5, 5.0, 1e-7}, i);
    Mesh mesh = sheet(cells, cells, [](double u, double v) { return Vec3d(u, v, 0); });
    for (Vec3d& p : mesh.points) p.z() = height * random.unit();
    return mesh;
}

Mesh crossedSheets(Random& random, int i)
{
    // Sheets with a common edge or a common centre: the edges are not manifold.
    const int count = pick({2, 3, 5, 16}, i);
    Mesh mesh;
    for (int k = 0; k < count; ++k) {
        const double angle = pi * k / count * pick({1.0, 1e-3, 1e-6}, i / 2);
        const double reach = random.between(0.5, 1);
        add(mesh, sheet(2, 2, [&](double u, double v) {
                const double across = i % 2 == 0 ? u : 2 * u - 1;
                return Vec3d(reach * across * std::cos(angle), reach * across * std::sin(angle), v);
            }));
    }
    return mesh;
}

Mesh roomsWithKeyholes(Random& random, int i)
{
    // A shell with a small hole and something inside, that may stick out through the hole.
    Mesh mesh = sphere(Vec3d(0), 1, 4 * (1 + i % 4));
    const std::size_t first = mesh.quads.size() / 2;
    mesh.quads.erase(mesh.quads.begin() + static_cast<std::ptrdiff_t>(first));
    if (i % 3 == 0) addBox(mesh, random.point(0.1) - Vec3d(0.2), Vec3d(0.3));
    if (i % 3 == 1) {
        const Vec3d inside = random.point(0.3), out = 2 * mesh.points[mesh.quads[first][0]];
        addTriangle(mesh, inside, out, out + 0.01 * random.direction());
    }
    return mesh;
}

Mesh crumpled(Random& random, int i)
{
    // A strip that turns at random as it goes on.
    Vec3d place(0), along = random.direction();
    std::vector<std::pair<Vec3d, Vec3d>> ribs;
    const int length = pick({10, 40, 200}, i);
    const double wildness = pick({0.3, 1.0, 3.0}, i / 3), width = pick({0.5, 3.0}, i);
    for (int k = 0; k <= length; ++k) {
        const Vec3d side = along.cross(random.direction());
        ribs.emplace_back(place + width * side, place - width * side);
        along += wildness * random.direction();
        along.normalize();
        place += along;
    }
    return sheet(length, 1, [&](double u, double v) {
        const auto& rib = ribs[static_cast<std::size_t>(std::lround(u * length))];
        return v < 0.5 ? rib.first : rib.second;
    });
}

Mesh hair(Random& random, int i)
{
    // Lines and points, which are degenerate faces, about one triangle.
    Mesh mesh;
    mesh.points = {random.point(0.2), random.point(0.2), random.point(0.2)};
    mesh.triangles = {{0, 1, 2}};
    for (int k = 0; k < pick({1, 10, 100, 500}, i); ++k) {
        const Vec3d start = random.point(0.5);
        const Vec3d end = i % 3 == 0 ? start : start + random.point(0.3);
        addTriangle(mesh, start, end, start);
    }
    return mesh;
}

Mesh thinSolids(Random& random, int i)
{
    // Boxes and tubes much thinner than a voxel, in one direction or two.
    const double thin = pick({1e-2, 1e-4, 1e-7, 1e-10}, i);
    const double other = i % 2 == 0 ? random.between(0.1, 1) : thin;
    if (i % 3 == 2) {
        return closedTube([](double t) { return Vec3d(std::cos(2 * pi * t), std::sin(2 * pi * t), 0.2 * t * (1 - t)); },
                          thin, 40, 4);
    }
    return box(Vec3d(0), Vec3d(1, other, thin));
}

struct Family {
    const char* name;
    Mesh (*make)(Random&, int);
};

const Family families[] = {
    {"soup", soup},
    {"needles", needles},
    {"dust", dust},
    {"nested-shells", nestedShells},
    {"close-sheets", closeSheets},
    {"coplanar", coplanarTriangles},
    {"touching-boxes", touchingBoxes},
    {"stacks", stacks},
    {"open-shells", openShells},
    {"moebius", moebiusBands},
    {"knots", knots},
    {"lattices", lattices},
    {"urchins", urchins},
    {"plates", platesWithHoles},
    {"combs", combs},
    {"chains", chains},
    {"single-faces", singleFaces},
    {"broken-faces", brokenFaces},
    {"contrasts", sizeContrasts},
    {"scrolls", scrolls},
    {"sponges", sponges},
    {"terrains", terrains},
    {"crossed-sheets", crossedSheets},
    {"keyholes", roomsWithKeyholes},
    {"crumpled", crumpled},
    {"hair", hair},
    {"thin", thinSolids},
};
constexpr int modelsOfAFamily = 12;

/// The longest side, and the distance from the origin as a multiple of it. At 150 floats just still hold a model, at
/// 1000 no more.
struct Placement {
    const char* name;
    double side, distance;
};

const Placement placements[] = {
    {"unit", 1, 0},     {"tiny", 1e-6, 0},       {"huge", 1e6, 0},       {"off", 10, 150},
    {"far", 0.01, 1e3}, {"tiny-far", 1e-6, 1e5}, {"huge-far", 1e6, 1e4},
};

Mesh placed(const Mesh& mesh, const Placement& placement)
{
    const openvdb::BBoxd bounds = boundingBox(mesh);
    const double side = bounds.extents()[static_cast<int>(bounds.maxExtent())];
    const Vec3d move = placement.side * placement.distance * Vec3d(-1, 0.7, 0.2);
    return transformed(mesh, placement.side / side, move);
}

} // namespace

std::vector<StressModel> stressModels()
{
    std::vector<StressModel> models;
    std::uint64_t seed = 1;
    for (const Family& family : families) {
        for (int i = 0; i < modelsOfAFamily; ++i, ++seed) {
            Random random(seed);
            Mesh mesh = family.make(random, i);
            // The others keep faces along the axes, which meet voxel borders and stay exactly coplanar.
            if (random.below(2) == 0) mesh = rotatedAtRandom(std::move(mesh), random);
            const Placement& placement = placements[seed % std::size(placements)];
            const std::string number = (i < 10 ? "-0" : "-") + std::to_string(i) + "-";
            models.push_back({family.name + number + placement.name, placed(mesh, placement)});
        }
    }
    return models;
}

} // namespace vdbcage::test
