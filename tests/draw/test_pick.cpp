#include <boost/test/unit_test.hpp>

#include <random>

#include "meshes.h"
#include <tools/draw/pick.h>
#include <tools/draw/stand_in.h>

using namespace vdbcage;
using namespace vdbcage::draw;
using openvdb::Vec3d;

BOOST_AUTO_TEST_SUITE(pick)

BOOST_AUTO_TEST_CASE(what_is_projected_to_a_place_is_picked_there)
{
    const Mesh mesh = test::sphere(8);
    const Frame frame(boundingBox(mesh));
    const Geometry geometry(mesh, frame, 0);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> real(0.05, 0.3);
    for (const Projection projection : {Projection::perspective, Projection::orthographic}) {
        for (int run = 0; run < 200; ++run) {
            View view;
            view.azimuthDegrees = 360 * real(random);
            view.elevationDegrees = 100 * real(random);
            const PointSets seen{&geometry.positions()};
            const Eye eye = eyeOf(fit(view, projection, seen, 1.5), 1.5, seen);
            const std::size_t face = random() % mesh.quads.size();
            // A place within the first triangle of the quad.
            const double a = real(random), b = real(random);
            const auto corner = [&](int k) { return frame.toDrawing(mesh.points[mesh.quads[face][k]]); };
            const Vec3d point = (1 - a - b) * corner(0) + a * corner(1) + b * corner(2);
            const Vec3d place = project(eye, point);
            const auto hit = nearestHit(rayThrough(eye, place.x(), place.y()), geometry);
            BOOST_TEST_REQUIRE(hit.has_value());
            const Vec3d outward = point; // of a ball around the origin
            const double facing = outward.dot((eye.viewpoint - point).unit());
            const bool isFront = facing > 0.15;
            const bool isBack = facing < -0.15;
            if (isFront) {
                BOOST_TEST(hit->face == face);
                BOOST_TEST((hit->point - point).length() < 1e-5);
            }
            if (isBack) BOOST_TEST(hit->face != face);
        }
    }
}

BOOST_AUTO_TEST_CASE(no_ray_passes_between_two_faces)
{
    const Mesh mesh = test::sphere(4);
    const Frame frame(boundingBox(mesh));
    const Geometry geometry(mesh, frame, 0);
    const auto check = [&](const Vec3d& place, const Vec3d& from) {
        BOOST_TEST(nearestHit({from, (place - from).unit()}, geometry).has_value());
    };
    std::mt19937 random(2);
    std::uniform_real_distribution<double> real(-1, 1);
    for (const auto& edge : geometry.edges()) {
        const auto at = [&](Geometry::Index i) {
            const auto& p = geometry.positions()[i];
            return Vec3d(double{p[0]}, double{p[1]}, double{p[2]});
        };
        const Vec3d a = at(edge[0]), b = at(edge[1]);
        check(a, {0, 0, 0});
        check(0.5 * (a + b), {0, 0, 0});
        check(a, 5 * a);
        check(0.3 * a + 0.7 * b, {0.1 * real(random), 0.1 * real(random), 0.1 * real(random)});
    }
}

BOOST_AUTO_TEST_CASE(what_a_section_cuts_off_is_not_picked)
{
    const Mesh mesh = test::cube();
    const Geometry geometry(mesh, Frame(boundingBox(mesh)), 0);
    const Ray ray{{0, 0, 5}, {0, 0, -1}};
    const double side = 1 / std::sqrt(3.0);
    BOOST_TEST(nearestHit(ray, geometry)->distance == 5 - side, boost::test_tools::tolerance(1e-6));
    BOOST_TEST(nearestHit(ray, geometry, Section{{0, 0, -1}, 0})->distance == 5 + side,
               boost::test_tools::tolerance(1e-6));
    BOOST_TEST(!nearestHit(ray, geometry, Section{{0, 0, 1}, 2}));
    BOOST_TEST(!nearestHit({{0, 0, 5}, {0, 0, 1}}, geometry));
    BOOST_TEST(!nearestHit({{3, 0, 5}, {0, 0, -1}}, geometry));
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_AUTO_TEST_SUITE(stand_in)

BOOST_AUTO_TEST_CASE(it_is_small_and_near_to_the_mesh)
{
    for (const double scale : {1.0, 1e-200, 1e200}) {
        Mesh mesh = test::sphere(60); // 43,200 triangles
        for (Vec3d& point : mesh.points) point *= scale;
        for (const std::size_t most : {100, 1000, 12000}) {
            const StandIn made = standIn(mesh, most);
            const Mesh& coarse = made.mesh;
            BOOST_REQUIRE(made.points.size() == coarse.points.size());
            for (std::size_t i = 0; i < coarse.points.size(); ++i) {
                const double distance = (mesh.points[made.points[i]] / scale - coarse.points[i] / scale).length();
                BOOST_TEST(distance < (most == 100 ? 0.5 : 0.15));
            }
            BOOST_TEST(coarse.triangles.size() <= most);
            BOOST_TEST(coarse.triangles.size() > most / 8);
            BOOST_TEST(coarse.quads.empty());
            double volume = 0;
            for (const openvdb::Vec3I& t : coarse.triangles) {
                const Vec3d a = coarse.points[t[0]] / scale, b = coarse.points[t[1]] / scale,
                            c = coarse.points[t[2]] / scale;
                volume += a.dot(b.cross(c)) / 6;
                BOOST_TEST(a.length() < 1.0001);
                BOOST_TEST(a.length() > (most == 100 ? 0.6 : 0.9));
            }
            BOOST_TEST(volume > (most == 100 ? 2.0 : 3.6)); // faces outward
        }
        const StandIn itself = standIn(mesh, 43200);
        BOOST_TEST(itself.mesh.quads == mesh.quads, boost::test_tools::per_element());
        for (std::size_t i = 0; i < itself.points.size(); ++i) BOOST_REQUIRE(itself.points[i] == i);
    }
}

BOOST_AUTO_TEST_CASE(any_soup_has_one)
{
    Mesh needle;
    for (int i = 0; i < 1000; ++i) {
        const double x = i * 1e-3;
        needle.points.insert(needle.points.end(), {{x, 0, 0}, {x + 1e-3, 0, 0}, {x, 1e-12, 0}});
        const auto first = static_cast<openvdb::Index32>(3 * i);
        needle.triangles.emplace_back(first, first + 1, first + 2);
    }
    BOOST_TEST(!standIn(needle, 100).mesh.triangles.empty());
}

BOOST_AUTO_TEST_SUITE_END()
