#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <draw/meshes.h>
#include <tools/draw/geometry.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::draw;
using openvdb::Vec3d;

namespace {

Vec3d toDouble(const Vec3f& v)
{
    return {v[0], v[1], v[2]};
}

Geometry geometryOf(const Mesh& mesh, double creaseDegrees)
{
    return {mesh, Frame(boundingBox(mesh)), creaseDegrees};
}

double largestAngle(const Geometry& geometry)
{
    double largest = 0;
    for (std::size_t vertex = 0; vertex < geometry.positions().size(); ++vertex) {
        const Vec3d position = toDouble(geometry.positions()[vertex]);
        const Vec3d normal = toDouble(geometry.normals()[vertex]);
        largest = std::max(largest, std::acos(std::min(1.0, position.unit().dot(normal))));
    }
    return largest;
}

} // namespace

BOOST_AUTO_TEST_SUITE(geometry)

BOOST_AUTO_TEST_CASE(a_cube_is_flat_and_has_twelve_edges_whether_points_are_shared_or_not)
{
    Mesh apart; // each face with points of its own
    const Mesh box = test::cube();
    for (const openvdb::Vec4I& quad : box.quads) {
        const auto first = static_cast<openvdb::Index32>(apart.points.size());
        for (int i = 0; i < 4; ++i) apart.points.push_back(box.points[quad[i]]);
        apart.quads.emplace_back(first, first + 1, first + 2, first + 3);
    }
    for (const Mesh& mesh : {box, apart}) {
        const Geometry geometry = geometryOf(mesh, 40);
        BOOST_TEST(geometry.edges().size() == 12U);
        BOOST_TEST(geometry.triangles().size() == 12U);
        BOOST_REQUIRE(geometry.positions().size() == 24U); // each corner has a vertex a side
        for (std::size_t vertex = 0; vertex < 24; ++vertex) {
            const Vec3d normal = toDouble(geometry.normals()[vertex]);
            BOOST_TEST(std::abs(normal.x()) + std::abs(normal.y()) + std::abs(normal.z()) == 1.0);
            BOOST_TEST(normal.dot(toDouble(geometry.positions()[vertex])) > 0);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_sphere_is_smooth_also_across_seams)
{
    const Mesh mesh = test::sphere(12);
    BOOST_TEST(largestAngle(geometryOf(mesh, 40)) < 0.01);
    BOOST_TEST(largestAngle(geometryOf(mesh, 0)) > 0.05);
    // Euler: 6 n^2 faces, 6 n^2 + 2 points.
    BOOST_TEST(geometryOf(mesh, 40).edges().size() == 12U * 12 * 12);
}

BOOST_AUTO_TEST_CASE(the_crease_angle_decides)
{
    // Two squares that meet at 30 degrees.
    const double angle = 30 * detail::pi / 180;
    Mesh mesh;
    mesh.points = {{0, 0, 0},
                   {1, 0, 0},
                   {1, 0, 1},
                   {0, 0, 1},
                   {-std::cos(angle), -std::sin(angle), 0},
                   {-std::cos(angle), -std::sin(angle), 1}};
    mesh.quads = {{0, 3, 2, 1}, {4, 5, 3, 0}};
    const auto normals = [&](double crease) {
        const Geometry geometry = geometryOf(mesh, crease);
        return std::set<Vec3f>(geometry.normals().begin(), geometry.normals().end()).size();
    };
    BOOST_TEST(normals(29) == 2U); // each face its own
    BOOST_TEST(normals(31) == 3U); // and one between them along the edge
    BOOST_TEST(geometryOf(mesh, 0).edges().size() == 7U);
}

BOOST_AUTO_TEST_CASE(the_normal_does_not_depend_on_the_diagonal)
{
    // A corner of the cube cut as one quad and two triangles a side: angles weigh the same.
    Mesh split = test::cube();
    split.triangles = triangulate(split);
    split.quads.clear();
    const auto vertices = [](const Mesh& mesh) {
        const Geometry geometry = geometryOf(mesh, 180);
        std::set<std::pair<Vec3f, Vec3f>> result;
        for (std::size_t vertex = 0; vertex < geometry.positions().size(); ++vertex) {
            const Vec3f& position = geometry.positions()[vertex];
            const Vec3f& normal = geometry.normals()[vertex];
            BOOST_TEST(toDouble(normal).dot(toDouble(position)) > 0.999999);
            result.insert({position, normal});
        }
        return result;
    };
    const auto one = vertices(test::cube());
    const auto two = vertices(split);
    BOOST_TEST(one.size() == 8U);
    BOOST_TEST(two.size() >= 8U);
}

BOOST_AUTO_TEST_CASE(degenerate_faces_and_unused_points_do_no_harm)
{
    Mesh mesh = test::cube();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    mesh.points.emplace_back(nan, nan, nan);
    mesh.triangles = {{0, 0, 1}, {0, 1, 0}, {3, 3, 3}};
    mesh.quads.emplace_back(0, 0, 1, 1);
    const Geometry geometry = geometryOf(mesh, 40);
    BOOST_TEST(geometry.edges().size() == 12U);
    for (const Vec3f& normal : geometry.normals()) {
        for (const float value : normal) BOOST_TEST(std::isfinite(value));
    }
}

BOOST_AUTO_TEST_CASE(any_size_and_place_fits_the_frame)
{
    const double huge = std::numeric_limits<double>::max();
    const double tiny = std::numeric_limits<double>::denorm_min();
    const Vec3d far(1e15, -2e15, 3e15);
    for (const openvdb::BBoxd& box :
         {openvdb::BBoxd(Vec3d(-1), Vec3d(1)), openvdb::BBoxd(Vec3d(-huge), Vec3d(huge)),
          openvdb::BBoxd(Vec3d(-4 * tiny), Vec3d(4 * tiny)), openvdb::BBoxd(Vec3d(-1e-6), Vec3d(1e-6)),
          openvdb::BBoxd(far - Vec3d(16), far + Vec3d(16))}) {
        const Frame frame(box);
        BOOST_TEST(std::abs(frame.toDrawing(box.max()).length() - 1) < 1e-6);
        BOOST_TEST((frame.toDrawing(box.max()) + frame.toDrawing(box.min())).length() < 1e-6);
        const Vec3d middle = 0.5 * box.min() + 0.5 * box.max();
        const Vec3d back = frame.toWorld(frame.toDrawing(middle)) - middle;
        BOOST_TEST(back.length() <= 1e-6 * (box.max() - middle).length() + 1e-15 * middle.length());
    }
}

BOOST_AUTO_TEST_CASE(other_points_give_what_a_new_geometry_of_them_has)
{
    // Nowhere near the crease angle, neither before nor after, so that the same edges are sharp.
    const Mesh rest = test::sphere(6);
    Mesh posed = rest;
    for (Vec3d& point : posed.points) point = {1.1 * point.x() + 0.2 * point.y(), point.y(), 0.9 * point.z()};
    const Frame frame(boundingBox(rest));
    for (const double crease : {0.0, 80.0}) {
        Geometry moved(rest, frame, crease);
        moved.setPoints(posed.points);
        const Geometry fresh(posed, frame, crease);
        BOOST_CHECK(moved.positions() == fresh.positions());
        BOOST_CHECK(moved.normals() == fresh.normals());
        BOOST_CHECK(moved.triangles() == fresh.triangles());
        BOOST_CHECK(moved.edges() == fresh.edges());
        moved.setPoints(rest.points);
        BOOST_CHECK(moved.normals() == Geometry(rest, frame, crease).normals());
    }
}

BOOST_AUTO_TEST_CASE(points_that_do_not_fit_are_refused_and_change_nothing)
{
    const Mesh mesh = test::cube();
    Geometry geometry = geometryOf(mesh, 40);
    const std::vector<Vec3f> before = geometry.positions();
    std::vector<Vec3d> points = mesh.points;
    points[3].y() = std::numeric_limits<double>::infinity();
    BOOST_CHECK_EXCEPTION(geometry.setPoints(points), InputError, [](const InputError& error) {
        return std::string(error.what()).find("point 3 is not finite") != std::string::npos;
    });
    points.pop_back();
    BOOST_CHECK_EXCEPTION(geometry.setPoints(points), InputError, [](const InputError& error) {
        return std::string(error.what()).find("7 points were given for a mesh of 8") != std::string::npos;
    });
    BOOST_CHECK(geometry.positions() == before);
}

BOOST_AUTO_TEST_CASE(lines_are_edges_without_faces)
{
    const Frame frame(openvdb::BBoxd(Vec3d(-1), Vec3d(1)));
    const Geometry lines({{Vec3d(-1), Vec3d(1)}, {Vec3d(0), Vec3d(1, 0, 0)}}, frame);
    BOOST_TEST(lines.pointCount() == 4U);
    BOOST_TEST(lines.triangles().empty());
    BOOST_REQUIRE(lines.edges().size() == 2U);
    const auto& [from, to] = lines.edges()[1];
    BOOST_TEST((toDouble(lines.positions()[to]) - frame.toDrawing(Vec3d(1, 0, 0))).length() < 1e-6);
    BOOST_TEST((toDouble(lines.positions()[from])).length() < 1e-6);
}

BOOST_AUTO_TEST_SUITE_END()
