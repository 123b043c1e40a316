#include <boost/test/unit_test.hpp>

#include <cmath>

#include <openvdb/math/Mat3.h>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/symmetry.h>

#include "support/shapes.h"
#include "support/stop_at.h"

using namespace vdbcage;
using openvdb::Vec3d;

namespace {

/// Symmetric across `axis` alone, in the plane through the origin.
Mesh wedge(int axis)
{
    Mesh mesh = test::box({-1, -0.5, -0.3}, {1, 0.5, 0.3});
    for (Vec3d& p : mesh.points) {
        if (p[1] > 0 && p[2] > 0) p *= 1.5;
        if (p[1] < 0 && p[2] > 0) p[2] *= 0.5;
        for (int i = 0; i < axis; ++i) p = Vec3d(p[2], p[0], p[1]);
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(symmetry)

BOOST_AUTO_TEST_CASE(the_plane_is_found_wherever_it_is)
{
    for (const int axis : {0, 1, 2}) {
        for (const double scale : {1e-90, 1.0, 1e90}) {
            for (const double far : {0.0, -7.25, 1e4}) {
                const Mesh model = test::transformed(wedge(axis), scale, scale * Vec3d(far));
                const auto found = findSymmetry(model, 1e-6);
                BOOST_REQUIRE(found);
                BOOST_TEST(found->plane.axis == axis);
                BOOST_TEST(std::abs(found->plane.offset - scale * far) < 1e-9 * scale * (1 + std::abs(far)));
                BOOST_TEST(found->deviation < 1e-9);
                for (const int other : {0, 1, 2}) {
                    BOOST_TEST((other == axis || bestSymmetry(model, other).deviation > 0.01));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(what_is_not_symmetric_has_no_plane)
{
    BOOST_CHECK(!findSymmetry(test::turnedAboutZ(wedge(0), 20), 0.01));
    BOOST_TEST(findSymmetry(test::turnedAboutZ(wedge(0), 20), 0.5).has_value());
    BOOST_TEST(findSymmetry(test::turnedAboutZ(wedge(2), 20), 1e-6).has_value()); // in its plane
    // The deviation grows as it is turned out of the plane.
    double last = -1;
    for (const double degrees : {0.0, 0.5, 1.0, 2.0, 4.0}) {
        const double deviation = bestSymmetry(test::turnedAboutZ(wedge(0), degrees), 0).deviation;
        BOOST_TEST(deviation > last);
        last = deviation;
    }
}

BOOST_AUTO_TEST_CASE(a_part_without_a_counterpart_does_not_move_the_plane)
{
    const double size = 0.4;
    const Mesh model = test::joined(wedge(0), test::box({1.4, 0.2, 0.2}, {1.4 + size, 0.3, 0.3}));
    const Symmetry best = bestSymmetry(model, 0);
    BOOST_TEST(std::abs(best.plane.offset) < 0.02); // the middle of the box is at 0.15
    BOOST_TEST(best.deviation > 0.05);
}

BOOST_AUTO_TEST_CASE(a_plane_that_the_model_does_not_tell_from_that_through_the_origin_is_that)
{
    for (const int axis : {0, 1, 2}) {
        for (const double scale : {1e-3, 1.0, 317.0}) {
            const auto offset = [&](double far) {
                Vec3d along(0.0);
                along[axis] = scale * far;
                return bestSymmetry(test::transformed(wedge(axis), scale, along), axis).plane.offset / scale;
            };
            for (const double far : {3e-7, -2e-6, 7e-6}) BOOST_TEST(offset(far) == 0); // it is three across
            for (const double far : {8e-6, -1e-3}) BOOST_TEST(std::abs(offset(far) - far) < 1e-7);
        }
    }
}

BOOST_AUTO_TEST_CASE(of_equally_good_planes_the_first)
{
    const auto found = findSymmetry(test::box({-1, -1, -1}, {1, 1, 1}), 1e-6);
    BOOST_REQUIRE(found);
    BOOST_TEST(found->plane.axis == 0);
}

BOOST_AUTO_TEST_CASE(a_plane_of_any_direction_is_found)
{
    for (int i = 0; i < 12; ++i) {
        const Vec3d axis = Vec3d(std::cos(2.0 * i), std::sin(1.0 + 3 * i), std::cos(5.0 * i + 2)).unit();
        const auto turn = openvdb::math::rotation<openvdb::Mat3d>(axis, 1.0 + 0.7 * i);
        const Vec3d normal = turn * Vec3d(1, 0, 0);
        Mesh model = wedge(0);
        const double scale = std::pow(10.0, 3 * (i % 3) - 3);
        for (Vec3d& p : model.points) p = scale * (turn * p + Vec3d(4, -2, i));
        const TiltedSymmetry found = bestTiltedSymmetry(model);
        BOOST_TEST(std::abs(found.normal.dot(normal)) > 1 - 1e-12);
        BOOST_TEST(found.normal.length() == 1, boost::test_tools::tolerance(1e-12));
        const int largest = static_cast<int>(openvdb::math::MaxIndex(openvdb::math::Abs(found.normal)));
        BOOST_TEST(found.normal[largest] > 0);
        BOOST_TEST(std::abs(found.offset - scale * found.normal.dot(Vec3d(4, -2, i))) < 1e-6 * scale);
        BOOST_TEST(found.deviation < 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(no_plane_of_another_direction_is_worse_than_those_of_the_axes)
{
    const Mesh twisted = test::joined(test::turnedAboutZ(wedge(0), 20), test::box({1.4, 0.2, 0.2}, {1.9, 0.5, 0.3}));
    for (const Mesh& model : {wedge(1), twisted, test::turnedAboutZ(wedge(0), 37), test::torus(1, 0.3, 40, 16)}) {
        const TiltedSymmetry found = bestTiltedSymmetry(model);
        for (const int axis : {0, 1, 2}) BOOST_TEST(found.deviation <= bestSymmetry(model, axis).deviation + 1e-6);
    }
}

BOOST_AUTO_TEST_CASE(any_soup_will_do)
{
    Mesh triangle;
    triangle.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    const auto found = findSymmetry(triangle, 1e-6);
    BOOST_REQUIRE(found);
    BOOST_TEST(found->deviation < 1e-6);
    Mesh thin = triangle; // its area is no double
    thin.points[2] = {0.5, 1e-320, 0};
    BOOST_TEST(bestSymmetry(thin, 1).deviation < 1e-6);
    BOOST_CHECK_THROW(findSymmetry(Mesh(), 0.1), InputError);
    BOOST_TEST(bestTiltedSymmetry(triangle).deviation < 1e-6);
    BOOST_TEST(bestTiltedSymmetry(thin).deviation < 1e-6);
    BOOST_CHECK_THROW(bestTiltedSymmetry(Mesh()), InputError);
    for (const int axis : {-1, 3}) BOOST_CHECK_THROW(bestSymmetry(triangle, axis), InputError);
    test::StopAt stop(0);
    BOOST_CHECK_THROW(findSymmetry(triangle, 0.1, &stop), Cancelled);
    BOOST_CHECK_THROW(bestTiltedSymmetry(triangle, &stop), Cancelled);
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = test::turnedAboutZ(wedge(0), 3);
    const auto many = findSymmetry(model, 1);
    const TiltedSymmetry manyTilted = bestTiltedSymmetry(model);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = findSymmetry(model, 1);
    BOOST_TEST(bestTiltedSymmetry(model).normal == manyTilted.normal);
    BOOST_REQUIRE((many && single));
    BOOST_TEST(many->plane.offset == single->plane.offset);
    BOOST_TEST(many->deviation == single->deviation);
}

BOOST_AUTO_TEST_SUITE_END()
