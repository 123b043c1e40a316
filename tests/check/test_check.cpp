#include <boost/test/unit_test.hpp>

#include <limits>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <tbb/global_control.h>
#include <vdbcage/check/check.h>
#include <vdbcage/check/detail/predicates.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::box;
using test::joined;
using test::sphere;
using test::transformed;

namespace {

Mesh cube(double radius = 1)
{
    return box(Vec3d(-radius), Vec3d(radius));
}

Mesh triangulated(const Mesh& mesh)
{
    return {mesh.points, triangulate(mesh), {}};
}

Mesh turnedInsideOut(Mesh mesh)
{
    for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    for (auto& q : mesh.quads) std::swap(q[1], q[3]);
    return mesh;
}

Mesh point(const Vec3d& p) // a model that is one point
{
    return {{p}, {{0, 0, 0}}, {}};
}

// The answers alone, all zero for a good cage.
struct Verdict {
    std::size_t boundary = 0, nonManifoldEdges = 0, nonManifoldVertices = 0, misoriented = 0, inward = 0,
                degenerate = 0, self = 0, contact = 0, outside = 0;

    explicit Verdict(const CageCheck& c)
        : boundary(c.boundaryEdges), nonManifoldEdges(c.nonManifoldEdges), nonManifoldVertices(c.nonManifoldVertices),
          misoriented(c.misorientedEdges), inward(c.inwardComponents), degenerate(c.degenerateFaces),
          self(c.selfIntersections), contact(c.contactFaces), outside(c.modelVerticesOutside)
    {
    }
    std::size_t sum() const
    {
        return boundary + nonManifoldEdges + nonManifoldVertices + misoriented + inward + degenerate + self + contact +
               outside;
    }
};

CageCheck check(const Mesh& cage, const Mesh& model = cube(0.5))
{
    CheckOptions options;
    options.measure = false;
    return checkCage(cage, model, options);
}

bool sameAnswers(const CageCheck& a, const CageCheck& b)
{
    const Verdict x(a), y(b);
    return x.boundary == y.boundary && x.nonManifoldEdges == y.nonManifoldEdges &&
           x.nonManifoldVertices == y.nonManifoldVertices && x.misoriented == y.misoriented && x.inward == y.inward &&
           x.degenerate == y.degenerate && x.self == y.self && x.contact == y.contact && x.outside == y.outside &&
           a.badFaces == b.badFaces && a.components == b.components && a.genus == b.genus;
}

} // namespace

BOOST_AUTO_TEST_SUITE(check_cage)

BOOST_AUTO_TEST_CASE(good_cages)
{
    for (const Mesh& cage : {cube(), triangulated(cube()), sphere({}, 2, 8), test::torus(3, 1, 20, 12)}) {
        const bool ring = cage.points.size() == 240;
        const Mesh model = ring ? transformed(cube(0.3), 1, {3, 0, 0}) : cube(0.9);
        const CageCheck result = check(cage, model);
        BOOST_TEST(result.bounding());
        BOOST_TEST(Verdict(result).sum() == 0U);
        BOOST_TEST(result.genus == (ring ? 1 : 0));
        BOOST_TEST(result.components == 1U);
        BOOST_TEST(result.badFaces.empty());
        BOOST_TEST(result.points == cage.points.size());
        BOOST_TEST(result.triangles == cage.triangles.size());
        BOOST_TEST(result.quads == cage.quads.size());
    }
}

BOOST_AUTO_TEST_CASE(a_hole)
{
    Mesh cage = cube();
    cage.quads.pop_back();
    const CageCheck result = check(cage);
    BOOST_TEST(result.boundaryEdges == 4U);
    BOOST_TEST(!result.closed());
    BOOST_TEST(!result.valid());
    BOOST_TEST(result.modelVerticesOutside == 8U); // there is no inside
    BOOST_TEST(!check(Mesh()).closed());
    BOOST_TEST(check(Mesh()).modelVerticesOutside == 8U);
}

BOOST_AUTO_TEST_CASE(a_flipped_face)
{
    Mesh cage = cube();
    std::swap(cage.quads[0][1], cage.quads[0][3]);
    const CageCheck result = check(cage);
    BOOST_TEST(result.misorientedEdges == 4U);
    BOOST_TEST(!result.oriented());
    BOOST_TEST(!result.valid());
    BOOST_TEST(result.modelVerticesOutside == 8U);
}

BOOST_AUTO_TEST_CASE(inside_out)
{
    const CageCheck result = check(turnedInsideOut(cube()));
    BOOST_TEST(result.inwardComponents == 1U);
    BOOST_TEST(result.modelVerticesOutside == 8U); // winding number -1
    BOOST_TEST(!result.valid());
}

BOOST_AUTO_TEST_CASE(nested_shells)
{
    const CageCheck cavity = check(joined(cube(), turnedInsideOut(cube(0.2))), transformed(cube(0.1), 1, {0.6, 0, 0}));
    BOOST_TEST(cavity.inwardComponents == 1U);
    BOOST_TEST(cavity.modelVerticesOutside == 0U); // between the shells the winding number is 1
    BOOST_TEST(!cavity.valid());
    const CageCheck inHole = check(joined(cube(), turnedInsideOut(cube(0.2))), cube(0.1));
    BOOST_TEST(inHole.modelVerticesOutside == 8U);
    const CageCheck twice = check(joined(cube(), cube(0.2)), cube(0.1)); // winding number 2
    BOOST_TEST(twice.modelVerticesOutside == 8U);
    BOOST_TEST(twice.inwardComponents == 0U);
}

BOOST_AUTO_TEST_CASE(a_bow_tie)
{
    Mesh cage = joined(triangulated(cube()), transformed(triangulated(cube()), 1, {2, 2, 2}));
    for (auto& t : cage.triangles) {
        for (int i = 0; i < 3; ++i) {
            if (t[i] == 8) t[i] = 7;
        }
    }
    const CageCheck result = check(cage);
    BOOST_TEST(result.nonManifoldVertices == 1U);
    BOOST_TEST(result.selfIntersections == 0U); // they share the corner by index
    BOOST_TEST(!result.manifold());
}

BOOST_AUTO_TEST_CASE(touching_at_one_point_exactly)
{
    // Corner to corner, at the same place but with another index: three triangles or quads at each.
    const Mesh other = transformed(cube(), 1, {2, 2, 2});
    const CageCheck corner = check(joined(cube(), other));
    BOOST_TEST(corner.selfIntersections == 9U); // three faces around each
    BOOST_TEST(corner.badFaces.size() == 6U);
    BOOST_TEST(corner.manifold());
    // A corner in the middle of a face.
    Mesh tip{
        {{1, 0, 0}, {2, -0.5, -0.5}, {2, 0.5, -0.5}, {2, 0, 0.5}}, {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}, {}};
    BOOST_TEST(check(joined(tip, cube())).inwardComponents == 0U);
    BOOST_TEST(check(joined(tip, cube())).selfIntersections == 3U);
    tip.points[0][0] = std::nextafter(1.0, 2.0);
    BOOST_TEST(check(joined(tip, cube())).selfIntersections == 0U);
    BOOST_TEST(check(joined(tip, cube())).valid());
}

BOOST_AUTO_TEST_CASE(an_edge_of_three_faces_and_duplicate_faces)
{
    Mesh fin = triangulated(cube());
    fin.points.emplace_back(-2, -2, 0);
    fin.triangles.emplace_back(fin.triangles[0][0], fin.triangles[0][1], 8U);
    BOOST_TEST(check(fin).nonManifoldEdges == 1U);
    for (const bool reversed : {false, true}) {
        Mesh twice = triangulated(cube());
        twice.triangles.push_back(twice.triangles[0]);
        if (reversed) std::swap(twice.triangles.back()[0], twice.triangles.back()[1]);
        const CageCheck result = check(twice);
        BOOST_TEST(result.nonManifoldEdges == 3U);
        BOOST_TEST(result.selfIntersections == 1U);
        BOOST_TEST(result.badFaces == (std::vector<std::uint32_t>{0, 12}), boost::test_tools::per_element());
    }
    Mesh quads = cube();
    quads.quads.push_back(quads.quads[0]);
    BOOST_TEST(check(quads).selfIntersections == 1U);
}

BOOST_AUTO_TEST_CASE(more_self_intersections_than_are_counted)
{
    // 1500 triangles have 1,124,250 pairs; a quad on the cube is behind them all.
    const std::size_t copies = 1500;
    for (const bool ownPoints : {false, true}) {
        Mesh cage = triangulated(cube());
        std::vector<std::uint32_t> expected;
        for (std::size_t i = 0; i < copies; ++i) {
            const auto first = static_cast<std::uint32_t>(cage.points.size());
            if (i == 0 || ownPoints) cage.points.insert(cage.points.end(), {{3, 0, 0}, {4, 0, 0}, {3, 1, 0}});
            const std::uint32_t a = i == 0 || ownPoints ? first : 8;
            expected.push_back(static_cast<std::uint32_t>(cage.triangles.size()));
            cage.triangles.emplace_back(a, a + 1, a + 2);
        }
        cage.quads.emplace_back(0U, 1U, 2U, 3U); // bad by itself: it lies on two triangles of the cube
        const CageCheck counted = check(cage);
        BOOST_TEST(counted.selfIntersections == mostSelfIntersections);
        const std::vector<std::uint32_t>& bad = counted.badFaces;
        BOOST_TEST(std::includes(bad.begin(), bad.end(), expected.begin(), expected.end()));
        // With fewer copies all are counted: the same faces of the cube are bad.
        cage.triangles.resize(12 + 2);
        std::vector<std::uint32_t> few = check(cage).badFaces;
        for (std::uint32_t& face : few) face += face == 14 ? static_cast<std::uint32_t>(copies - 2) : 0;
        BOOST_TEST(bad.size() == few.size() + copies - 2);
        BOOST_TEST(std::includes(bad.begin(), bad.end(), few.begin(), few.end()));
    }
}

BOOST_AUTO_TEST_CASE(a_poke)
{
    // The sphere's north pole pulled down through the south one. Its fan of triangles crosses the other.
    Mesh cage = triangulated(sphere({}, 1, 6));
    BOOST_TEST(check(cage, cube(0.1)).valid());
    cage.points.front() = {0.01, 0.02, -1.5};
    const CageCheck result = check(cage, point({0, 0, -1.1}));
    BOOST_TEST(result.selfIntersections >= 12U);
    BOOST_TEST(result.manifold());
    BOOST_TEST(!result.valid());
}

BOOST_AUTO_TEST_CASE(neighbours_that_fold_over)
{
    // A tetrahedron so flat that two neighbours lie on each other; then lifted by the least number above 0.
    Mesh flat{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, {}};
    BOOST_TEST(check(flat).selfIntersections == 3U);
    BOOST_TEST(check(flat).inwardComponents == 1U); // its volume is 0
    flat.points[3][2] = std::numeric_limits<double>::denorm_min();
    BOOST_TEST(check(flat).selfIntersections == 0U);
    BOOST_TEST(check(flat).inwardComponents == 0U);
    BOOST_TEST(check(flat).valid());
}

BOOST_AUTO_TEST_CASE(degenerate_faces)
{
    // The middle of an edge, joined to its ends by a triangle of no area.
    Mesh cage = triangulated(cube());
    const auto face = cage.triangles[0];
    cage.points.push_back((cage.points[face[0]] + cage.points[face[1]]) / 2.0);
    cage.triangles[0] = {face[0], 8, face[2]};
    cage.triangles.emplace_back(8U, face[1], face[2]);
    cage.triangles.emplace_back(face[0], face[1], 8U);
    const CageCheck result = check(cage);
    BOOST_TEST(result.closed());
    BOOST_TEST(result.manifold());
    BOOST_TEST(result.degenerateFaces == 1U);
    BOOST_TEST(!result.valid());
    BOOST_TEST(std::count(result.badFaces.begin(), result.badFaces.end(), 13U) == 1);
    Mesh repeated = cube();
    repeated.quads[0][1] = repeated.quads[0][0];
    BOOST_TEST(check(repeated).degenerateFaces == 1U);
}

BOOST_AUTO_TEST_CASE(folded_and_straight_quads)
{
    // The top of a cube as two quads around a corner in the middle: a dart if the corner is moved towards 4 or 6.
    const auto top = [](double x) {
        Mesh mesh = cube();
        mesh.points.emplace_back(x, x, 1);
        mesh.quads.back() = {4, 5, 8, 6};
        mesh.quads.emplace_back(5U, 7U, 6U, 8U);
        return check(mesh);
    };
    BOOST_TEST(top(0).degenerateFaces == 2U); // one diagonal cuts off nothing
    const CageCheck dart = top(-0.5);         // 4, 5, 8, 6 has its reflex corner at 8
    BOOST_TEST(dart.degenerateFaces == 0U);
    BOOST_TEST(dart.selfIntersections == 2U); // folded; and over its neighbour under the other diagonal
    BOOST_TEST(dart.badFaces == (std::vector<std::uint32_t>{5, 6}), boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_diagonal_on_another_face)
{
    // Two tents over the same square corners 0 and 2, which are an edge of neither.
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 1}, {1, 1, 0}, {0, 1, 1}, {1, 0, -1}, {0, 1, -1}};
    mesh.quads = {{0, 1, 2, 3}, {0, 5, 2, 4}};
    BOOST_TEST(check(mesh).selfIntersections == 1U);
}

BOOST_AUTO_TEST_CASE(contacts_to_the_last_bit)
{
    const double above = std::nextafter(1.0, 2.0), below = std::nextafter(1.0, 0.0);
    for (const Mesh& cage : {cube(), triangulated(cube())}) {
        const std::size_t facesOnSide = cage.quads.empty() ? 2 : 1;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-1.0, 1.0}) {
                Vec3d on(0.25, 0.125, 0.0625), in = on, out = on;
                on[axis] = side;
                in[axis] = side * below;
                out[axis] = side * above;
                BOOST_TEST(check(cage, point(in)).bounding());
                const CageCheck touch = check(cage, point(on));
                BOOST_TEST(touch.contactFaces >= 1U);
                BOOST_TEST(touch.contactFaces <= facesOnSide);
                BOOST_TEST(touch.modelVerticesOutside == 1U);
                BOOST_TEST(touch.valid());
                BOOST_TEST(check(cage, point(out)).contactFaces == 0U);
                BOOST_TEST(check(cage, point(out)).modelVerticesOutside == 1U);
            }
        }
        BOOST_TEST(check(cage, cube(1)).contactFaces == 6 * facesOnSide);
        BOOST_TEST(check(cage, cube(1)).modelVerticesOutside == 8U);
        BOOST_TEST(check(cage, cube(below)).bounding());
        BOOST_TEST(check(cage, cube(above)).contactFaces == 0U);
        BOOST_TEST(check(cage, cube(above)).modelVerticesOutside == 8U);
    }
}

BOOST_AUTO_TEST_CASE(as_floats)
{
    CheckOptions asFloats;
    asFloats.asFloats = true;
    const double inside = 1 - 1e-9; // a float cannot tell it from 1
    BOOST_TEST(check(cube(), cube(inside)).bounding());
    BOOST_TEST(checkCage(cube(), cube(inside), asFloats).contactFaces == 6U);
    BOOST_TEST(checkCage(cube(), cube(inside), asFloats).modelVerticesOutside == 8U);

    const auto rounded = [](Mesh mesh) {
        for (Vec3d& p : mesh.points) p = detail::nearestFloat(p);
        return mesh;
    };
    std::size_t different = 0;
    for (int i = 0; i < 60; ++i) {
        // Spheres around spheres, closer than floats can tell apart.
        const Vec3d move(0.1 * i, 1000.0 / (1 + i), -3.7 * i);
        const Mesh model = transformed(sphere({}, 1, 12), 1, move);
        const Mesh cage = transformed(triangulated(sphere({}, 1 + 2e-5 * i / 60, 12)), 1, move);
        const CageCheck given = checkCage(cage, model), floats = checkCage(cage, model, asFloats);
        BOOST_TEST(sameAnswers(floats, checkCage(rounded(cage), rounded(model))));
        different += !sameAnswers(given, floats);
    }
    BOOST_TEST(different > 5U);
    BOOST_CHECK_THROW(checkCage(cube(1e39), cube(), asFloats), InputError);
    BOOST_CHECK_THROW(checkCage(cube(), cube(1e39), asFloats), InputError);
}

BOOST_AUTO_TEST_CASE(models_of_several_parts)
{
    const Mesh model =
        joined(joined(cube(0.2), transformed(cube(0.2), 1, {5, 0, 0})), transformed(cube(0.2), 1, {0.9, 0.9, 0.9}));
    const CageCheck result = check(cube(), model);
    BOOST_TEST(result.contactFaces == 3U);
    BOOST_TEST(result.modelVerticesOutside == 8U + 7U); // of the part in the cage's corner one vertex is inside
    // A segment right through the cage, both its ends outside; a triangle around it that touches nothing.
    Mesh rod{{{-3, 0, 0}, {3, 0, 0}, {0, 9, 0}}, {{0, 1, 1}}, {}};
    BOOST_TEST(check(cube(), rod).contactFaces == 2U);
    BOOST_TEST(check(cube(), rod).modelVerticesOutside == 2U); // the third point is used by no face
    BOOST_TEST(check(cube(), transformed(cube(), 1, {2.5, 0, 0})).modelVerticesOutside == 8U);
}

BOOST_AUTO_TEST_CASE(copies_of_a_triangle_with_points_of_their_own)
{
    Mesh model;
    for (unsigned i = 0; i < 150; i += 3) {
        for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(0.5, 0, 0.25), Vec3d(0, 2, 0)}) model.points.push_back(p);
        model.triangles.emplace_back(i, i + 1, i + 2);
    }
    const CageCheck check = checkCage(cube(), model);
    BOOST_TEST(check.contactFaces == 1U);
    BOOST_TEST(check.modelVerticesOutside == 50U);
}

BOOST_AUTO_TEST_CASE(the_cage_inside_the_model)
{
    const CageCheck result = check(cube(0.5), cube(1));
    BOOST_TEST(result.contactFaces == 0U);
    BOOST_TEST(result.modelVerticesOutside == 8U);
}

BOOST_AUTO_TEST_CASE(between_the_diagonals_of_a_quad)
{
    // One corner pulled out: each of its three quads becomes a tetrahedron between its diagonals.
    Mesh cage = cube();
    cage.points[7] = {2, 2, 2};
    BOOST_TEST(check(cage, cube(0.9)).bounding());
    const Vec3d middle = (cage.points[7] + cage.points[5] + cage.points[3] + cage.points[1]) / 4.0;
    const CageCheck result = check(cage, joined(cube(0.3), point(middle)));
    BOOST_TEST(result.valid());
    BOOST_TEST(result.contactFaces == 0U);
    BOOST_TEST(result.modelVerticesOutside == 1U);
    BOOST_TEST(result.badFaces == std::vector<std::uint32_t>{1}, boost::test_tools::per_element());
    // The same with a model that touches: every vertex is asked.
    Mesh touching = joined(cube(0.3), Mesh{{middle, {1.1, 1, 1}}, {{0, 1, 1}}, {}});
    BOOST_TEST(check(cage, touching).modelVerticesOutside >= 1U);
    const CageCheck dented = check(cage, triangulated(cage));
    BOOST_TEST(dented.contactFaces == 6U);
    // A model's quad stands for both diagonals too.
    Mesh roof = cube(0.3);
    roof.points[7] = {0.9, 0.9, 0.9};
    BOOST_TEST(check(triangulated(cube(0.5)), roof).contactFaces >= 3U);
}

BOOST_AUTO_TEST_CASE(rays_through_edges_and_corners)
{
    // The ray along x from these points runs through corners, along edges and within faces.
    Mesh octahedron;
    octahedron.points = {{-4, 0, 0}, {4, 0, 0}, {0, -4, 0}, {0, 4, 0}, {0, 0, -4}, {0, 0, 4}};
    for (unsigned x = 0; x < 2; ++x) {
        for (unsigned y = 2; y < 4; ++y) {
            for (unsigned z = 4; z < 6; ++z) {
                if ((x + y + z) % 2)
                    octahedron.triangles.emplace_back(x, y, z);
                else
                    octahedron.triangles.emplace_back(x, z, y);
            }
        }
    }
    BOOST_TEST(check(octahedron, point({0, 0, 0})).inwardComponents == 0U);
    const Mesh grid = joined(octahedron, transformed(cube(), 1, {9, 0, 0}));
    for (int x = -6; x <= 11; ++x) {
        for (int y = -5; y <= 5; ++y) {
            for (int z = -5; z <= 5; ++z) {
                const bool inside = std::abs(x) + std::abs(y) + std::abs(z) < 4 || (x == 9 && y == 0 && z == 0);
                BOOST_TEST(check(grid, point(Vec3d(x, y, z))).modelVerticesOutside == (inside ? 0U : 1U));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(exact_moves_and_scales_change_nothing, *boost::unit_test::label("property"))
{
    const Mesh good = sphere({}, 1, 6), model = transformed(triangulated(sphere({}, 0.75, 5)), 1, {0.0625, 0, 0});
    const auto rounded = [](Mesh mesh) { // to 20 bits, so that moving is exact
        for (Vec3d& p : mesh.points) {
            for (int i = 0; i < 3; ++i) p[i] = std::ldexp(std::round(std::ldexp(p[i], 20)), -20);
        }
        return mesh;
    };
    Mesh poked = good;
    poked.points.front() = {0, 0, -1.25};
    for (const Mesh& plain : {good, poked, joined(good, transformed(good, 1, {1, 0, 0})), cube(0.5)}) {
        const Mesh cage = rounded(plain), inner = rounded(model);
        const CageCheck expected = check(cage, inner);
        BOOST_TEST((plain.points == good.points) == expected.bounding());
        for (const double scale : {std::ldexp(1, -30), std::ldexp(1, 30), std::ldexp(1, -1000), std::ldexp(1, 1000)}) {
            const Vec3d move = std::abs(std::ilogb(scale)) < 100 ? Vec3d(4096, -8192, 12345) * scale : Vec3d(0.0);
            BOOST_TEST(sameAnswers(expected, check(transformed(cage, scale, move), transformed(inner, scale, move))));
        }
    }
}

BOOST_AUTO_TEST_CASE(measures_of_spheres)
{
    const Mesh model = triangulated(sphere({}, 1, 40)), cage = sphere({}, 2, 40);
    const openvdb::Vec3d extent = boundingBox(model).extents();
    const double side = std::max({extent[0], extent[1], extent[2]});
    const CageCheck result = checkCage(cage, model);
    BOOST_TEST(result.diagonal * side == extent.length(), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(result.meanDistance * side == 1, boost::test_tools::tolerance(0.01));
    BOOST_TEST(result.maxDistance * side == 1, boost::test_tools::tolerance(0.01));
    BOOST_TEST(result.minDistance * side == 1, boost::test_tools::tolerance(0.01));
    BOOST_TEST(result.cageVolume == 32.0 / 3 * detail::pi, boost::test_tools::tolerance(0.01));
    BOOST_TEST(result.volumeRatio == 8, boost::test_tools::tolerance(0.001));
    // Far away the volume keeps its digits.
    const Vec3d far(1e6, -1e6, 1e6);
    const CageCheck moved = checkCage(transformed(cage, 1, far), transformed(model, 1, far));
    BOOST_TEST(moved.cageVolume == result.cageVolume, boost::test_tools::tolerance(1e-8));
    BOOST_TEST(moved.meanDistance == result.meanDistance, boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(measures_of_boxes)
{
    // A long box around another: the mean over the area of the distance to the inner one is known.
    const Mesh cage = box({0, 0, 0}, {10, 2, 2}), model = box({1, 0.5, 0.5}, {9, 1.5, 1.5});
    const CageCheck result = checkCage(cage, model);
    BOOST_TEST(result.volumeRatio == 40.0 / 8, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(result.minAngleDegrees == std::atan2(2, 10) * 180 / detail::pi, boost::test_tools::tolerance(1e-9));
    // Of the 72 angles under both diagonals 16 are like the least, 16 are 45 degrees, 16 the least's complement, 24
    // right.
    BOOST_TEST(result.medianAngleDegrees == std::atan2(10, 2) * 180 / detail::pi, boost::test_tools::tolerance(1e-9));
    const double side = 8;
    BOOST_TEST(result.diagonal * side == std::sqrt(66.0), boost::test_tools::tolerance(1e-12));
    BOOST_TEST(result.maxDistance * side == std::sqrt(1.5), boost::test_tools::tolerance(1e-12)); // a corner
    BOOST_TEST(result.minDistance * side == 0.5, boost::test_tools::tolerance(1e-9));
    // By a fine even grid.
    const auto distance = [](const Vec3d& p) {
        Vec3d d(0.0);
        const Vec3d low(1, 0.5, 0.5), high(9, 1.5, 1.5);
        for (int i = 0; i < 3; ++i) d[i] = std::max({low[i] - p[i], p[i] - high[i], 0.0});
        return d.length();
    };
    double sum = 0, area = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Vec3d size(10, 2, 2);
        for (int i = 0; i < 200; ++i) {
            for (int j = 0; j < 200; ++j) {
                Vec3d p(0.0);
                p[u] = (i + 0.5) / 200 * size[u];
                p[v] = (j + 0.5) / 200 * size[v];
                sum += distance(p) * size[u] * size[v] / 40000;
                area += size[u] * size[v] / 40000;
            }
        }
    }
    BOOST_TEST(result.meanDistance * side == sum / area, boost::test_tools::tolerance(1e-3));
    CheckOptions none;
    none.measure = false;
    BOOST_TEST(checkCage(cage, model, none).volumeRatio == 0);
    BOOST_TEST(checkCage(cage, model, none).bounding());
    // Without an inside there is no volume.
    Mesh open = model;
    open.quads.pop_back();
    BOOST_TEST(checkCage(cage, open).volumeRatio == 0);
    BOOST_TEST(checkCage(open, model).cageVolume == 0);
}

BOOST_AUTO_TEST_CASE(hollows_are_counted_by_the_surface_of_the_model)
{
    const auto ball = [](double x, double radius) { return sphere({x, 0, 0}, radius, 8); };
    const auto hollows = [](const Mesh& mesh) { return CageChecker(mesh).hollows(); };
    const Mesh one = joined(ball(0, 1), turnedInsideOut(ball(0.4, 0.3)));
    const Mesh two = joined(one, turnedInsideOut(ball(-0.4, 0.3)));
    Mesh open = ball(0.4, 0.3);
    open.quads.pop_back();
    const std::vector<std::pair<Mesh, std::size_t>> cases{
        {ball(0, 1), 0},
        {turnedInsideOut(ball(0, 1)), 0},
        {one, 1},
        {two, 2},
        {joined(one, ball(0.4, 0.1)), 1},                                          // a solid in the hollow
        {joined(joined(one, ball(0.4, 0.2)), turnedInsideOut(ball(0.4, 0.1))), 2}, // with a hollow of its own
        {joined(joined(one, ball(0, 2)), turnedInsideOut(ball(-1.5, 0.2))),
         1},                                                  // the first is filled by the larger ball
        {joined(ball(0, 1), ball(0.4, 0.3)), 0},              // parts that overlap
        {joined(ball(0, 1), turnedInsideOut(ball(3, 1))), 0}, // side by side
        {joined(ball(0, 1), turnedInsideOut(box({-2, -2, -2}, {2, 2, 2}))), 1},
        {joined(ball(0, 1), turnedInsideOut(open)), 0},
        {joined(ball(0, 1), turnedInsideOut(box({0, 0, 0}, {0.5, 0.5, 0}))), 0}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        BOOST_TEST_CONTEXT("case " << i)
        {
            const auto& [mesh, expected] = cases[i];
            BOOST_TEST(hollows(mesh) == expected);
            BOOST_TEST(hollows(turnedInsideOut(mesh)) == expected);
            BOOST_TEST(hollows(triangulated(mesh)) == expected);
            for (const double scale : {1e-90, 1e90}) {
                BOOST_TEST(hollows(transformed(mesh, scale, scale * Vec3d(5, -7, 9))) == expected);
            }
        }
    }
    test::StopAt stop(0);
    BOOST_CHECK_THROW(CageChecker(two, &stop), Cancelled);
}

BOOST_AUTO_TEST_CASE(strange_but_allowed)
{
    const double huge = 1e300;
    BOOST_TEST(check(cube(huge), cube(0.5 * huge)).bounding());
    BOOST_TEST(check(cube(huge), cube(1e-300)).bounding());
    BOOST_TEST(check(cube(huge), cube(huge)).contactFaces == 6U);
    checkCage(cube(huge), cube(0.5 * huge)); // the measures overflow but do no harm
    checkCage(cube(1e-300), cube(5e-301));
    checkCage(point({0, 0, 0}), point({0, 0, 0}));
    checkCage(Mesh(), cube());
    Mesh loose = cube(0.5);
    loose.points.insert(loose.points.end(), {{0, 0, 0}, {5, 0, 0}, {1, 0, 0}, {0, 0.999, 0}, {0, 0, std::nan("")}});
    const CageCheck counted = checkCage(cube(), loose);
    BOOST_TEST(counted.bounding());
    BOOST_TEST(counted.loosePoints == 5U);
    BOOST_TEST(counted.loosePointsOutside == 3U); // one of them on it, one nowhere
    BOOST_TEST(counted.badFaces.empty());
    Mesh open = cube();
    open.quads.pop_back();
    BOOST_TEST(checkCage(open, loose).loosePointsOutside == 5U); // it has no inside
    Mesh unused = cube();
    unused.points.emplace_back(std::nan(""), 0, 0);
    BOOST_TEST(check(unused).bounding());
    BOOST_TEST(check(cube(), unused).contactFaces == 6U);
    CheckOptions noSamples;
    noSamples.samples = 0;
    BOOST_TEST(checkCage(cube(), cube(0.5), noSamples).meanDistance == 0);
}

BOOST_AUTO_TEST_CASE(bad_input)
{
    Mesh wrong = cube();
    wrong.quads[3][2] = 8;
    BOOST_CHECK_EXCEPTION(check(wrong), InputError, [](const InputError& error) {
        return std::string(error.what()).find("cage: a face uses point 8; there are 8") != std::string::npos;
    });
    BOOST_CHECK_THROW(check(cube(), wrong), InputError);
    Mesh infinite = cube();
    infinite.points[2][1] = std::numeric_limits<double>::infinity();
    BOOST_CHECK_THROW(check(infinite), InputError);
    BOOST_CHECK_THROW(check(cube(), infinite), InputError);
    BOOST_CHECK_THROW(check(cube(), Mesh()), InputError);
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    Mesh cage = joined(sphere({}, 2, 20), test::torus(3, 1, 40, 20));
    cage.points[30] *= 0.2;
    const Mesh model = joined(triangulated(sphere({}, 1.5, 60)), transformed(sphere({}, 0.5, 20), 1, {3, 0, 0}));
    const CageCheck many = checkCage(cage, model);
    BOOST_TEST(many.selfIntersections > 0U);
    BOOST_TEST(many.contactFaces > 0U);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const CageCheck one = checkCage(cage, model);
    BOOST_TEST(sameAnswers(many, one));
    for (const auto measure : {&CageCheck::meanDistance, &CageCheck::maxDistance, &CageCheck::minDistance,
                               &CageCheck::cageVolume, &CageCheck::volumeRatio, &CageCheck::minAngleDegrees}) {
        const double with = many.*measure, without = one.*measure;
        BOOST_TEST(with == without); // every bit
    }
}

BOOST_AUTO_TEST_CASE(one_checker_for_many_cages)
{
    const CageChecker checker(cube(0.5));
    const CageChecker copy = checker;
    CheckOptions options;
    options.measure = false;
    BOOST_TEST(checker.check(cube(1), options).bounding());
    BOOST_TEST(!copy.check(cube(0.25), options).bounding());
    BOOST_TEST(checker.check(cube(2), options).bounding());
}

BOOST_AUTO_TEST_CASE(cancelling_at_every_question)
{
    const Mesh cage = sphere({}, 2, 6), model = sphere({}, 1, 20);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1); // the same questions each time
    test::StopAt never(1000000);
    checkCage(cage, model, {}, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 20);
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(checkCage(cage, model, {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(cancelling_does_not_wait_for_samples)
{
    const Mesh cage = sphere({}, 2, 6), model = sphere({}, 1, 20);
    CheckOptions options;
    options.samples = std::numeric_limits<std::size_t>::max(); // nothing holds them, or gets past them
    for (const int k : {2000, 20000}) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(checkCage(cage, model, options, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_CASE(an_exact_volume_asks_at_each_triangle)
{
    Mesh flat = sphere({}, 1, 6);
    for (Vec3d& p : flat.points) p.z() = 0;
    const std::vector<openvdb::Vec3I> triangles = triangulate(flat);
    test::StopAt never(1000000);
    BOOST_TEST(detail::volumeSign(flat.points, triangles, &never) == 0);
    BOOST_TEST(test::questions(never, 1000000) == int(triangles.size()));
}

BOOST_AUTO_TEST_SUITE_END()
