#include <boost/test/unit_test.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>
#include <vdbcage/mesh/mesh.h>

using namespace vdbcage;
using openvdb::Vec3d;
using openvdb::Vec3I;
using openvdb::Vec4I;

namespace {

Mesh unitSquare()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.quads = {{0, 1, 2, 3}};
    return mesh;
}

auto saying(const std::string& text)
{
    return [text](const InputError& error) { return std::string(error.what()).find(text) != std::string::npos; };
}

} // namespace

BOOST_AUTO_TEST_SUITE(mesh)

BOOST_AUTO_TEST_CASE(triangulate_splits_quads_by_the_diagonal_of_corners_0_and_2)
{
    Mesh mesh = unitSquare();
    mesh.triangles = {{3, 1, 0}};
    BOOST_TEST(faceCount(mesh) == 2U);
    const std::vector<Vec3I> triangles = triangulate(mesh);
    BOOST_REQUIRE(triangles.size() == 3U);
    BOOST_CHECK(triangles[0] == Vec3I(3, 1, 0));
    BOOST_CHECK(triangles[1] == Vec3I(0, 1, 2));
    BOOST_CHECK(triangles[2] == Vec3I(0, 2, 3));
}

BOOST_AUTO_TEST_CASE(the_bounding_box_is_that_of_the_points_that_faces_use)
{
    Mesh mesh = unitSquare();
    mesh.points.emplace_back(100, 100, 100);
    const openvdb::BBoxd box = boundingBox(mesh);
    BOOST_CHECK(box.min() == Vec3d(0, 0, 0));
    BOOST_CHECK(box.max() == Vec3d(1, 1, 0));
    BOOST_TEST(boundingBox(Mesh()).empty());
}

BOOST_AUTO_TEST_CASE(usable_meshes_pass)
{
    BOOST_CHECK_NO_THROW(requireUsable(unitSquare(), "model"));
    Mesh withBadFaces = unitSquare();
    withBadFaces.triangles = {{0, 0, 1}, {2, 2, 2}};
    withBadFaces.points.emplace_back(std::nan(""), 0, 0); // used by no face
    BOOST_CHECK_NO_THROW(requireUsable(withBadFaces, "model"));
    Mesh halfAQuad = unitSquare();
    halfAQuad.quads = {{0, 0, 1, 2}};
    BOOST_CHECK_NO_THROW(requireUsable(halfAQuad, "model"));
}

BOOST_AUTO_TEST_CASE(unusable_meshes_are_named_with_the_value)
{
    BOOST_CHECK_EXCEPTION(requireUsable(Mesh(), "the cage"), InputError, saying("the cage: it has no faces"));
    Mesh mesh = unitSquare();
    mesh.quads[0][2] = 4;
    BOOST_CHECK_EXCEPTION(requireUsable(mesh, "m"), InputError, saying("uses point 4; there are 4 points"));
    mesh = unitSquare();
    mesh.points[3].y() = -std::numeric_limits<double>::infinity();
    BOOST_CHECK_EXCEPTION(requireUsable(mesh, "m"), InputError, saying("point 3 is (0, -inf, 0)"));
    mesh = unitSquare();
    mesh.quads.clear();
    mesh.triangles = {{0, 1, 1}, {2, 2, 2}};
    BOOST_CHECK_EXCEPTION(requireUsable(mesh, "m"), InputError, saying("every face is degenerate"));
}

BOOST_AUTO_TEST_CASE(degenerate_is_decided_exactly_at_every_scale, *boost::unit_test::label("property"))
{
    // Small integers, scaled by a power of two: integer arithmetic is the reference.
    std::mt19937 random(1);
    std::uniform_int_distribution<std::int64_t> coordinate(-3, 3);
    int degenerate = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        std::int64_t p[3][3];
        for (auto& point : p) {
            for (auto& x : point) x = coordinate(random);
        }
        std::int64_t u[3], v[3];
        for (int i = 0; i < 3; ++i) {
            u[i] = p[1][i] - p[0][i];
            v[i] = p[2][i] - p[0][i];
        }
        const bool expected = u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2];
        degenerate += expected;
        for (const int exponent : {0, -1074, -600, -300, 300, 900, 1021}) {
            Vec3d q[3];
            for (int i = 0; i < 3; ++i) {
                for (int axis = 0; axis < 3; ++axis) q[i][axis] = std::ldexp(double(p[i][axis]), exponent);
            }
            BOOST_TEST_REQUIRE(detail::isDegenerate(q[0], q[1], q[2]) == expected);
        }
    }
    BOOST_TEST(degenerate > 100);
}

BOOST_AUTO_TEST_CASE(points_of_a_line_are_degenerate_where_their_differences_are_rounded,
                     *boost::unit_test::label("property"))
{
    // Points t d of a line through the origin, exact in doubles; t spans so many powers of two that differences are
    // not.
    std::mt19937 random(2);
    std::uniform_int_distribution<int> whole(-7, 7);
    std::uniform_int_distribution<int> exponent(-56, 0);
    int misjudgedIfRounded = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        for (const int scale : {0, -530, 510}) {
            const Vec3d direction(whole(random), whole(random), whole(random));
            Vec3d p[3];
            for (Vec3d& point : p) point = direction * std::ldexp(double(whole(random)), exponent(random) + scale);
            BOOST_TEST_REQUIRE(detail::isDegenerate(p[0], p[1], p[2]));
            misjudgedIfRounded += (p[1] - p[0]).cross(p[2] - p[0]) != Vec3d(0, 0, 0);
        }
    }
    BOOST_TEST(misjudgedIfRounded > 1000);
    // Where products fall below the normal doubles, the rounding of one may tip that of the other.
    const Vec3d direction(1, 5, 0);
    const auto at = [&](double t) { return direction * std::ldexp(t, -534); };
    BOOST_TEST(detail::isDegenerate(at(-0x1p-55), at(0x1.4p-2), at(-0x1.8p-2)));
}

BOOST_AUTO_TEST_CASE(a_triangle_one_unit_in_the_last_place_from_a_line_is_not_degenerate)
{
    const double next = std::nextafter(0.3, 1.0);
    BOOST_TEST(detail::isDegenerate({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, 0.3}));
    BOOST_TEST(!detail::isDegenerate({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.3, 0.3, next}));
    BOOST_TEST(!detail::isDegenerate({1e300, 0, 0}, {-1e300, 0, 0}, {0, 5e-324, 0}));
    BOOST_TEST(detail::isDegenerate({1e300, 0, 0}, {-1e300, 0, 0}, {5e-324, 0, 0}));
}

BOOST_AUTO_TEST_SUITE_END()
