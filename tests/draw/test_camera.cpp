#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include <draw/meshes.h>
#include <tools/draw/camera.h>
#include <tools/draw/geometry.h>

using namespace vdbcage;
using namespace vdbcage::draw;
using openvdb::Vec3d;

namespace {

constexpr Projection projections[] = {Projection::perspective, Projection::orthographic};

Geometry geometryOf(const Mesh& mesh)
{
    return {mesh, Frame(boundingBox(mesh)), 0};
}

Vec3d toDouble(const Vec3f& p)
{
    return {p[0], p[1], p[2]};
}

/// Where a clip matrix puts a point on the panel, [-1, 1] both ways, and its depth.
Vec3d clipped(const Matrix& matrix, const Vec3d& p)
{
    std::array<double, 4> clip{};
    for (std::size_t i = 0; i < 4; ++i) {
        clip[i] = double(matrix[i]) * p.x() + double(matrix[4 + i]) * p.y() + double(matrix[8 + i]) * p.z() +
                  double(matrix[12 + i]);
    }
    return Vec3d(clip[0], clip[1], clip[2]) / clip[3];
}

/// A camera somewhere around, with a model of points around the origin.
Camera someCamera(std::mt19937& random, Projection projection)
{
    std::uniform_real_distribution<double> unit(-1, 1);
    Camera camera;
    camera.view = {180 * unit(random), 80 * unit(random), unit(random) < 0 ? UpAxis::y : UpAxis::z};
    camera.projection = projection;
    camera.target = {unit(random), unit(random), unit(random)};
    camera.distance = std::exp(2 * unit(random));
    return camera;
}

/// A point that the camera sees, a distance in front of its plane through the target or behind it.
Vec3d seenAt(const Camera& camera, double aspect, double x, double y, double depthShift)
{
    const Eye eye = eyeOf(camera, aspect, {});
    const double depth = camera.distance * (1 + depthShift);
    const double scale = eye.projection == Projection::perspective ? depth : 1;
    return eye.position - depth * eye.back + scale * (x * eye.halfWidth * eye.right + y * eye.halfHeight * eye.up);
}

} // namespace

BOOST_AUTO_TEST_SUITE(camera)

BOOST_AUTO_TEST_CASE(all_points_are_seen_and_two_opposite_margins_are_touched)
{
    for (const Vec3d& stretch : {Vec3d(1, 1, 1), Vec3d(10, 1, 1), Vec3d(1, 10, 1), Vec3d(0.1, 1, 10)}) {
        Mesh mesh = test::sphere(4);
        for (Vec3d& point : mesh.points) point *= stretch;
        const Geometry geometry = geometryOf(mesh);
        const PointSets seenPoints{&geometry.positions()};
        for (const Projection projection : projections) {
            for (const double aspect : {0.25, 1.0, 4.0 / 3, 5.0}) {
                for (const double azimuth : {0.0, 35.0, -120.0}) {
                    for (const double elevation : {-90.0, 0.0, 18.0, 90.0}) {
                        const Camera fitted = fit({azimuth, elevation, UpAxis::y}, projection, seenPoints, aspect);
                        const Matrix toClip = clipMatrix(eyeOf(fitted, aspect, seenPoints), {});
                        openvdb::BBoxd seen;
                        for (const Vec3f& p : geometry.positions()) seen.expand(clipped(toClip, toDouble(p)));
                        const Vec3d size = seen.max() - seen.min();
                        const double larger = std::max(size.x(), size.y());
                        BOOST_TEST(larger <= 1.8 + 1e-5);
                        const bool touches = stretch == Vec3d(1) || projection == Projection::orthographic;
                        if (touches) BOOST_TEST(larger >= 1.8 - 1e-5);
                        for (int i = 0; i < 2; ++i) {
                            BOOST_TEST(std::max(seen.max()[i], -seen.min()[i]) <= 0.9 + 1e-5);
                        }
                        BOOST_TEST(seen.min().z() > -1);
                        BOOST_TEST(seen.max().z() < 1);
                    }
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(without_points_the_default_camera_fits)
{
    const Camera camera = fit({}, Projection::orthographic, {}, 1);
    BOOST_TEST((camera.distance == Camera().distance));
    BOOST_TEST((camera.target == Camera().target));
    const Eye eye = eyeOf(camera, 1, {});
    BOOST_TEST(eye.nearest < eye.farthest);
}

BOOST_AUTO_TEST_CASE(the_eye_keeps_twice_the_radius_before_the_points)
{
    // A rod along the line of sight: its end would fill the view from near by.
    const std::vector<Vec3f> rod{{0, 0, -0.1F}, {0, 0, 0.1F}};
    for (const double radius : {0.1, 1.0}) {
        const Camera close = fit({0, 0, UpAxis::y}, Projection::perspective, {&rod}, 1, radius);
        BOOST_TEST(std::abs(close.distance - (0.1 + 2 * radius)) < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(the_angles_are_those_of_the_front)
{
    const auto from = [&](double azimuth, double elevation, UpAxis up) {
        Camera camera;
        camera.view = {azimuth, elevation, up};
        return eyeOf(camera, 1, {}).back;
    };
    BOOST_TEST((from(0, 0, UpAxis::y) - Vec3d(0, 0, 1)).length() < 1e-12);
    BOOST_TEST((from(90, 0, UpAxis::y) - Vec3d(1, 0, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 90, UpAxis::y) - Vec3d(0, 1, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 0, UpAxis::z) - Vec3d(0, -1, 0)).length() < 1e-12);
    BOOST_TEST((from(90, 0, UpAxis::z) - Vec3d(1, 0, 0)).length() < 1e-12);
    BOOST_TEST((from(0, 90, UpAxis::z) - Vec3d(0, 0, 1)).length() < 1e-12);
    const Eye eye = eyeOf({}, 1, {});
    BOOST_TEST((eye.right.cross(eye.up) - eye.back).length() < 1e-12);
}

BOOST_AUTO_TEST_CASE(a_crop_is_that_part_of_the_picture)
{
    const Geometry geometry = geometryOf(test::sphere(3));
    for (const Projection projection : projections) {
        const PointSets seen{&geometry.positions()};
        const Eye eye = eyeOf(fit({}, projection, seen, 1.5), 1.5, seen);
        const Matrix whole = clipMatrix(eye, {});
        const Crop crop{-0.5, 0.25, 0.5, 0.75};
        const Matrix part = clipMatrix(eye, crop);
        for (const Vec3f& position : geometry.positions()) {
            const Vec3d a = clipped(whole, toDouble(position));
            const Vec3d b = clipped(part, toDouble(position));
            BOOST_TEST(std::abs(b.x() - (a.x() - crop.x) / crop.halfWidth) < 1e-5);
            BOOST_TEST(std::abs(b.y() - (a.y() - crop.y) / crop.halfHeight) < 1e-5);
        }
    }
}

BOOST_AUTO_TEST_CASE(points_rays_and_matrices_agree)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 400; ++i) {
        const Projection projection = projections[i % 2];
        const double aspect = std::exp(unit(random));
        const Camera camera = someCamera(random, projection);
        const double x = unit(random);
        const double y = unit(random);
        const Vec3d point = seenAt(camera, aspect, x, y, 0.5 * unit(random));
        const std::vector<Vec3f> seen{{float(point.x()), float(point.y()), float(point.z())}};
        const Eye eye = eyeOf(camera, aspect, {&seen});

        const Vec3d place = project(eye, point);
        BOOST_TEST(std::abs(place.x() - x) < 1e-12);
        BOOST_TEST(std::abs(place.y() - y) < 1e-12);
        const Ray ray = rayThrough(eye, x, y);
        BOOST_TEST(std::abs(ray.direction.length() - 1) < 1e-12);
        BOOST_TEST(ray.direction.cross(point - ray.from).length() < 1e-12 * (1 + (point - ray.from).length()));
        BOOST_TEST(ray.direction.dot(point - ray.from) > 0);
        const Vec3d clip = clipped(clipMatrix(eye, {}), point - eye.origin);
        BOOST_TEST(std::abs(clip.x() - x) < 1e-4);
        BOOST_TEST(std::abs(clip.y() - y) < 1e-4);
        BOOST_TEST(std::abs(clip.z()) < 1); // neither too near nor too far
    }
}

BOOST_AUTO_TEST_CASE(what_one_turns_around_stays_in_its_place)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 400; ++i) {
        const Camera camera = someCamera(random, projections[i % 2]);
        const Vec3d pivot = seenAt(camera, 1.5, unit(random), unit(random), 0.5 * unit(random));
        const Camera turned = orbited(camera, 500 * unit(random), 20 * unit(random), pivot);
        const Vec3d before = project(eyeOf(camera, 1.5, {}), pivot);
        const Vec3d after = project(eyeOf(turned, 1.5, {}), pivot);
        BOOST_TEST((before - after).length() < 1e-9 * camera.distance + 1e-9);
        BOOST_TEST(std::abs(turned.view.azimuthDegrees) < 360);
        BOOST_TEST(turned.distance == camera.distance);
    }
    const Camera top = orbited({}, 0, 1000, Vec3d(0));
    BOOST_TEST(top.view.elevationDegrees == 90);
}

BOOST_AUTO_TEST_CASE(what_is_dragged_and_what_is_zoomed_at_stays_under_the_cursor)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 400; ++i) {
        const Camera camera = someCamera(random, projections[i % 2]);
        const double aspect = std::exp(unit(random));
        const double x = unit(random);
        const double y = unit(random);
        const Vec3d point = seenAt(camera, aspect, x, y, 0); // at the target's depth
        const double dx = unit(random);
        const double dy = unit(random);
        const Vec3d moved = project(eyeOf(panned(camera, aspect, dx, dy), aspect, {}), point);
        BOOST_TEST(std::abs(moved.x() - (x + dx)) < 1e-9);
        BOOST_TEST(std::abs(moved.y() - (y + dy)) < 1e-9);

        const double factor = std::exp(unit(random));
        const Camera nearer = zoomed(camera, aspect, factor, x, y);
        const Vec3d kept = project(eyeOf(nearer, aspect, {}), point);
        BOOST_TEST(std::abs(kept.x() - x) < 1e-9);
        BOOST_TEST(std::abs(kept.y() - y) < 1e-9);
        BOOST_TEST(std::abs(nearer.distance - camera.distance / factor) < 1e-12 * camera.distance);
    }
    BOOST_TEST(zoomed({}, 1, 1e30, 0, 0).distance == leastDistance);
    BOOST_TEST(zoomed({}, 1, 1e-30, 0, 0).distance == mostDistance);
}

BOOST_AUTO_TEST_CASE(close_ups_keep_a_hundredth_of_a_pixel)
{
    // From the least distance allowed the panel is 1000 pixels wide; single precision alone would miss by many.
    for (const Projection projection : projections) {
        Camera camera;
        camera.projection = projection;
        camera.target = {0.123456789, -0.3, 0.7};
        camera.distance = leastDistance;
        const Vec3d point = seenAt(camera, 1, 0.5, -0.25, 0);
        const Eye eye = eyeOf(camera, 1, {});
        const Matrix toClip = clipMatrix(eye, {});
        const Vec3d fromOrigin = point - eye.origin; // as the shader takes it, from floats near each other
        const Vec3d place = clipped(toClip, fromOrigin);
        BOOST_TEST(std::abs(place.x() - 0.5) < 2e-5);
        BOOST_TEST(std::abs(place.y() + 0.25) < 2e-5);
    }
}

BOOST_AUTO_TEST_SUITE_END()
