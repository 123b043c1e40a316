#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <set>

#include <render/meshes.h>
#include <tools/vdbcage/render_geometry.h>
#include <tools/vdbcage/render_view.h>

using namespace vdbcage;
using namespace vdbcage::render;
using openvdb::Vec3d;

namespace {

Vec3d toDouble(const Vec3f& v)
{
    return {v[0], v[1], v[2]};
}

Geometry geometryOf(const Mesh& mesh, double creaseDegrees)
{
    return makeGeometry(mesh, Frame(boundingBox(mesh)), creaseDegrees);
}

double largestAngle(const Geometry& geometry)
{
    double largest = 0;
    for (const Corner& corner : geometry.corners) {
        const Vec3d position = toDouble(corner.position);
        largest = std::max(largest, std::acos(std::min(1.0, position.unit().dot(toDouble(corner.normal)))));
    }
    return largest;
}

/// Where a clip matrix puts a point on the panel, [-1, 1] both ways, and its depth.
Vec3d project(const Matrix& matrix, const Vec3f& p)
{
    std::array<double, 4> clip{};
    for (std::size_t i = 0; i < 4; ++i) {
        clip[i] =
            double(matrix[i]) * p[0] + double(matrix[4 + i]) * p[1] + double(matrix[8 + i]) * p[2] + matrix[12 + i];
    }
    return Vec3d(clip[0], clip[1], clip[2]) / clip[3];
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
        BOOST_TEST(geometry.segments.size() == 12U);
        BOOST_REQUIRE(geometry.corners.size() == 36U);
        for (const Corner& corner : geometry.corners) {
            const Vec3d normal = toDouble(corner.normal);
            BOOST_TEST(std::abs(normal.x()) + std::abs(normal.y()) + std::abs(normal.z()) == 1.0);
            BOOST_TEST(normal.dot(toDouble(corner.position)) > 0);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_sphere_is_smooth_also_across_seams)
{
    const Mesh mesh = test::sphere(12);
    BOOST_TEST(largestAngle(geometryOf(mesh, 40)) < 0.01);
    BOOST_TEST(largestAngle(geometryOf(mesh, 0)) > 0.05);
    // Euler: 6 n^2 faces, 6 n^2 + 2 points.
    BOOST_TEST(geometryOf(mesh, 40).segments.size() == 12U * 12 * 12);
}

BOOST_AUTO_TEST_CASE(the_crease_angle_decides)
{
    // Two squares that meet at 30 degrees.
    const double angle = 30 * 3.14159265358979323846 / 180;
    Mesh mesh;
    mesh.points = {{0, 0, 0},
                   {1, 0, 0},
                   {1, 0, 1},
                   {0, 0, 1},
                   {-std::cos(angle), -std::sin(angle), 0},
                   {-std::cos(angle), -std::sin(angle), 1}};
    mesh.quads = {{0, 3, 2, 1}, {4, 5, 3, 0}};
    const auto normals = [&](double crease) {
        std::set<Vec3f> result;
        for (const Corner& corner : geometryOf(mesh, crease).corners) result.insert(corner.normal);
        return result.size();
    };
    BOOST_TEST(normals(29) == 2U); // each face its own
    BOOST_TEST(normals(31) == 3U); // and one between them along the edge
    BOOST_TEST(geometryOf(mesh, 0).segments.size() == 7U);
}

BOOST_AUTO_TEST_CASE(the_normal_does_not_depend_on_the_diagonal)
{
    // A corner of the cube cut as one quad and two triangles a side: angles weigh the same.
    Mesh split = test::cube();
    split.triangles = triangulate(split);
    split.quads.clear();
    const Geometry whole = geometryOf(test::cube(), 180);
    const Geometry halves = geometryOf(split, 180);
    std::set<std::pair<Vec3f, Vec3f>> one;
    std::set<std::pair<Vec3f, Vec3f>> two;
    for (const Corner& corner : whole.corners) one.insert({corner.position, corner.normal});
    for (const Corner& corner : halves.corners) {
        two.insert({corner.position, corner.normal});
        BOOST_TEST(toDouble(corner.normal).dot(toDouble(corner.position)) > 0.999999);
    }
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
    BOOST_TEST(geometry.segments.size() == 12U);
    for (const Corner& corner : geometry.corners) {
        for (const float value : corner.normal) BOOST_TEST(std::isfinite(value));
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
        BOOST_TEST(std::abs(frame(box.max()).length() - 1) < 1e-6);
        BOOST_TEST((frame(box.max()) + frame(box.min())).length() < 1e-6);
    }
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(view)

BOOST_AUTO_TEST_CASE(all_points_are_seen_and_two_opposite_margins_are_touched)
{
    for (const Vec3d& stretch : {Vec3d(1, 1, 1), Vec3d(10, 1, 1), Vec3d(1, 10, 1), Vec3d(0.1, 1, 10)}) {
        Mesh mesh = test::sphere(4);
        for (Vec3d& point : mesh.points) point *= stretch;
        const Geometry geometry = geometryOf(mesh, 0);
        for (const double aspect : {0.25, 1.0, 4.0 / 3, 5.0}) {
            for (const double azimuth : {0.0, 35.0, -120.0}) {
                for (const double elevation : {-90.0, 0.0, 18.0, 90.0}) {
                    const Eye eye = fitEye({azimuth, elevation, UpAxis::y}, {&geometry}, aspect);
                    const Matrix toClip = clipMatrix(eye, {});
                    openvdb::BBoxd seen;
                    for (const Corner& corner : geometry.corners) seen.expand(project(toClip, corner.position));
                    const double reach = std::max(seen.max().x() - seen.min().x(), seen.max().y() - seen.min().y());
                    BOOST_TEST(reach <= 1.8 + 1e-5);
                    if (stretch.x() == stretch.y() && stretch.x() == stretch.z()) BOOST_TEST(reach >= 1.8 - 1e-5);
                    for (int i = 0; i < 2; ++i) {
                        BOOST_TEST(std::abs(seen.max()[i] + seen.min()[i]) < 1.8);
                        BOOST_TEST(std::max(seen.max()[i], -seen.min()[i]) <= 0.9 + 1e-5);
                    }
                    BOOST_TEST(seen.min().z() > -1);
                    BOOST_TEST(seen.max().z() < 1);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(the_angles_are_those_of_the_front)
{
    const Geometry geometry = geometryOf(test::cube(), 0);
    const auto from = [&](double azimuth, double elevation, UpAxis up) {
        return fitEye({azimuth, elevation, up}, {&geometry}, 1).back;
    };
    BOOST_TEST((from(0, 0, UpAxis::y) - Vec3d(0, 0, 1)).length() < 1e-12);
    BOOST_TEST((from(90, 0, UpAxis::y) - Vec3d(1, 0, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 90, UpAxis::y) - Vec3d(0, 1, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 0, UpAxis::z) - Vec3d(0, -1, 0)).length() < 1e-12);
    BOOST_TEST((from(90, 0, UpAxis::z) - Vec3d(1, 0, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 90, UpAxis::z) - Vec3d(0, 0, 1)).length() < 1e-12);
    const Eye eye = fitEye({}, {&geometry}, 1);
    BOOST_TEST((eye.right.cross(eye.up) - eye.back).length() < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_crop_is_that_part_of_the_picture)
{
    const Geometry geometry = geometryOf(test::sphere(3), 0);
    const Eye eye = fitEye({}, {&geometry}, 1.5);
    const Matrix whole = clipMatrix(eye, {});
    const Crop crop{-0.5, 0.25, 0.5, 0.75};
    const Matrix part = clipMatrix(eye, crop);
    for (const Corner& corner : geometry.corners) {
        const Vec3d a = project(whole, corner.position);
        const Vec3d b = project(part, corner.position);
        BOOST_TEST(std::abs(b.x() - (a.x() - crop.x) / crop.halfWidth) < 1e-5);
        BOOST_TEST(std::abs(b.y() - (a.y() - crop.y) / crop.halfHeight) < 1e-5);
    }
}

BOOST_AUTO_TEST_SUITE_END()
