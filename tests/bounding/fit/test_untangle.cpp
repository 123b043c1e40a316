#include <boost/test/unit_test.hpp>

#include <random>
#include <vector>

#include <vdbcage/bounding/detail/fit/untangle.h>
#include <vdbcage/geometry/triangle_pair.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

const GuardModel& guard()
{
    static const GuardModel model(test::sphere({0, 0, 0}, 0.5, 4), {}, nullptr);
    return model;
}

struct Tangle {
    std::vector<Vec3d> points;
    std::vector<Vec3I> triangles;
};

Tangle tangle(unsigned seed, double size)
{
    const Mesh ball = test::sphere({0, 0, 0}, 0.5, 8);
    Tangle tangle{ball.points, triangulate(ball)};
    std::mt19937 random(seed);
    for (Vec3d& p : tangle.points) p += test::randomVector(random, size);
    return tangle;
}

} // namespace

BOOST_AUTO_TEST_SUITE(untangling)

BOOST_AUTO_TEST_CASE(crossing_triangles_are_those_of_all_pairs)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Tangle tangled = tangle(seed, 0.07 * seed);
        const auto& points = tangled.points;
        const auto& triangles = tangled.triangles;
        std::vector<char> crosses(triangles.size(), 0);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            for (std::size_t j = 0; j < triangles.size(); ++j) {
                const auto at = [&](const Vec3I& t) {
                    return SurfaceTriangle(t, {points[t[0]], points[t[1]], points[t[2]]});
                };
                if (i != j && tooNear(at(triangles[i]), at(triangles[j]), guard().spacing()))
                    crosses[i] = crosses[j] = 1;
            }
        }
        std::vector<std::uint32_t> expected;
        for (std::uint32_t i = 0; i < crosses.size(); ++i) {
            if (crosses[i]) expected.push_back(i);
        }
        const auto found = crossingTriangles(points, triangles, guard());
        BOOST_TEST(found == expected, boost::test_tools::per_element());
        BOOST_TEST(found.empty() == (seed == 0));
    }
}

BOOST_AUTO_TEST_CASE(tangles_open_and_the_rest_stays)
{
    for (unsigned seed = 0; seed < 6; ++seed) {
        auto [points, triangles] = tangle(seed, 0.07 * seed);
        const std::vector<Vec3d> before = points;
        BOOST_TEST(untangle(points, triangles, MoveLimits(points.size()), guard(), nullptr));
        BOOST_TEST(crossingTriangles(points, triangles, guard()).empty());
        if (seed == 0) BOOST_TEST((points == before));
    }
    // One point pulled through: those far from it stay.
    auto [points, triangles] = tangle(0, 0);
    points[0] = Vec3d(0, 0, -0.7);
    const std::vector<Vec3d> before = points;
    BOOST_TEST(!crossingTriangles(points, triangles, guard()).empty());
    BOOST_TEST(untangle(points, triangles, MoveLimits(points.size()), guard(), nullptr));
    const std::size_t equator = points.size() / 2;
    BOOST_TEST((points[equator] == before[equator]));
}

BOOST_AUTO_TEST_CASE(limbs_through_other_parts_are_drawn_back)
{
    // A long limb from the north pole, turned around, goes through the ball and out at the south pole.
    for (const double length : {0.9, 1.4, 2.0}) {
        const Mesh ball = test::sphere({0, 0, 0}, 0.5, 24);
        std::vector<Vec3d> points = ball.points;
        const std::vector<Vec3I> triangles = triangulate(ball);
        const double neck = 0.35;
        for (Vec3d& p : points) {
            const double up = (p[2] - neck) / (0.5 - neck);
            if (up > 0) p = Vec3d(p[0] * (1 - 0.5 * up), p[1] * (1 - 0.5 * up), neck - length * up);
        }
        const std::vector<Vec3d> before = points;
        BOOST_TEST(!crossingTriangles(points, triangles, guard()).empty());
        BOOST_TEST(untangle(points, triangles, MoveLimits(points.size()), guard(), nullptr));
        BOOST_TEST(crossingTriangles(points, triangles, guard()).empty());
        std::size_t stayed = 0;
        for (std::size_t v = 0; v < points.size(); ++v) stayed += points[v] == before[v];
        BOOST_TEST(stayed > points.size() / 3);
    }
}

BOOST_AUTO_TEST_CASE(kept_points_stay)
{
    auto [points, triangles] = tangle(0, 0);
    points[0] = Vec3d(0, 0, -0.7);
    MoveLimits limits(points.size());
    points[0] = guard().rounded(points[0]);
    limits[0] = MoveLimit{points[0], {false, false, false}};
    untangle(points, triangles, limits, guard(), nullptr);
    BOOST_TEST((points[0] == limits[0]->home));
}

BOOST_AUTO_TEST_SUITE_END()
