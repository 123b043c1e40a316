// How near triangles of one surface come to each other, beside sampling.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/geometry/triangle_pair.h>

using namespace vdbcage::detail;

namespace {

constexpr double degree = pi / 180;

class RandomPoints {
public:
    explicit RandomPoints(unsigned seed) : random_(seed) {}
    Vec3d operator()(double size = 1)
    {
        std::uniform_real_distribution<double> coordinate(-size, size);
        return {coordinate(random_), coordinate(random_), coordinate(random_)};
    }

private:
    std::mt19937 random_;
};

double angle(const Vec3d& u, const Vec3d& v)
{
    return std::atan2(u.cross(v).length(), u.dot(v));
}

/// Of directions from the corner 0 of both into the triangles.
double sampledAngle(const Corners& a, const Corners& b)
{
    constexpr int steps = 150;
    double least = 4;
    for (int i = 0; i <= steps; ++i) {
        const Vec3d u = a[1] + (double(i) / steps) * (a[2] - a[1]) - a[0];
        for (int j = 0; j <= steps; ++j) {
            const Vec3d v = b[1] + (double(j) / steps) * (b[2] - b[1]) - b[0];
            least = std::min(least, angle(u, v));
        }
    }
    return least;
}

double sampledDistance(const Corners& a, const Corners& b)
{
    constexpr int steps = 40;
    double least = 1e9;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; i + j <= steps; ++j) {
            const Vec3d p = a[0] + (double(i) / steps) * (a[1] - a[0]) + (double(j) / steps) * (a[2] - a[0]);
            least = std::min(least, (closestPointOnTriangle(p, b) - p).length());
        }
    }
    return least;
}

/// Answers, and how often each was given.
struct Tally {
    int near = 0, far = 0;
    bool operator()(bool isNear)
    {
        ++(isNear ? near : far);
        return isNear;
    }
};

} // namespace

BOOST_AUTO_TEST_SUITE(triangle_pair)

BOOST_AUTO_TEST_CASE(triangles_without_a_common_corner_keep_a_distance)
{
    RandomPoints random(1);
    constexpr Spacing spacing{0.1, 0.5, 0};
    Tally tally;
    for (int round = 0; round < 4000; ++round) {
        const Vec3d at = random(0.5);
        const double size = round % 2 ? 0.5 : 0.08; // of small ones half the longest edge is less
        const Corners a{random(), random(), random()}, b{at + random(size), at + random(size), at + random(size)};
        const SurfaceTriangle one({0, 1, 2}, a), other({3, 4, 5}, b);
        BOOST_TEST_REQUIRE(one.longestEdge() ==
                               std::max({(a[1] - a[0]).length(), (a[2] - a[1]).length(), (a[0] - a[2]).length()}),
                           boost::test_tools::tolerance(1e-12));
        const double wanted = std::min(0.1, 0.5 * std::min(one.longestEdge(), other.longestEdge()));
        BOOST_REQUIRE_EQUAL(distanceBetween(one, other, spacing), wanted);
        // Samples of the smaller one are at most a 40th of its longest edge away from any of its points.
        const double sampled = std::min(sampledDistance(a, b), sampledDistance(b, a));
        const bool isNear = tally(tooNear(one, other, spacing));
        BOOST_REQUIRE_EQUAL(isNear, tooNear(other, one, spacing));
        if (sampled < wanted) BOOST_REQUIRE(isNear);
        if (sampled > wanted + 0.025 * std::min(one.longestEdge(), other.longestEdge())) BOOST_REQUIRE(!isNear);
    }
    BOOST_TEST(tally.near > 500);
    BOOST_TEST(tally.far > 500);
}

BOOST_AUTO_TEST_CASE(triangles_with_a_common_corner_keep_an_angle)
{
    RandomPoints random(2);
    constexpr double least = 8 * degree, step = 2.5 * degree;
    const Spacing spacing{0.5, 0.5, std::sin(least)};
    Tally tally;
    for (int round = 0; round < 3000; ++round) {
        const Vec3d tip = random();
        const Corners a{tip, tip + random(), tip + random()};
        Corners b{tip, tip + random(), tip + random()};
        if (round % 3 == 0) b[1] = 0.7 * a[1] + 0.3 * tip + random(0.1);                      // along an edge
        if (round % 3 == 1) b[1] = a[1] + 0.5 * (a[2] - a[1]) + random(0.1);                  // across the face
        if (angle(a[1] - tip, a[2] - tip) > 2 || angle(b[1] - tip, b[2] - tip) > 2) continue; // few samples
        const SurfaceTriangle one({7, 1, 2}, a), other({4, 7, 3}, {b[2], b[0], b[1]});
        const double sampled = sampledAngle(a, b);
        const bool isNear = tally(tooNear(one, other, spacing));
        BOOST_REQUIRE_EQUAL(isNear, tooNear(other, one, spacing));
        if (sampled < least) BOOST_REQUIRE(isNear);
        if (sampled > least + step) BOOST_REQUIRE(!isNear);
    }
    BOOST_TEST(tally.near > 500);
    BOOST_TEST(tally.far > 500);
}

BOOST_AUTO_TEST_CASE(triangles_with_a_common_edge_are_not_folded)
{
    const Spacing spacing{0.5, 0.5, std::sin(5 * degree)};
    const Vec3d u(0, 0, 0), v(1, 0, 0);
    const SurfaceTriangle flat({0, 1, 2}, {u, v, {0.3, 1, 0}});
    for (double at = -179.5; at <= 180; ++at) {
        const Vec3d w(0.6, 0.8 * std::cos(at * degree), 0.8 * std::sin(at * degree));
        BOOST_TEST(tooNear(flat, {{1, 0, 3}, {v, u, w}}, spacing) == (std::abs(at) < 5));
    }
    BOOST_CHECK(tooNear(flat, flat, spacing));
}

BOOST_AUTO_TEST_CASE(no_two_triangles_of_a_fan_that_is_spread_out_are_too_near)
{
    RandomPoints random(3);
    constexpr double minSine = 0.1;
    const Spacing spacing{0.5, 0.5, std::sin(4 * degree)};
    int spread = 0, near = 0;
    for (int round = 0; round < 20000; ++round) {
        const Vec3d centre = random(0.2);
        const int sides = 3 + round % 6, turns = round % 7 == 0 && sides > 4 ? 2 : 1;
        std::vector<Vec3d> rim;
        for (int i = 0; i < sides; ++i) {
            const double at = 360 * degree * turns * (i + (i % 3 == 1 ? -0.45 : 0) * (round % 2)) / sides; // or pleated
            rim.push_back(Vec3d(std::cos(at), std::sin(at), 0) + random(round % 4 * 0.1));
            rim.back()[2] *= std::pow(3.0, round % 5 - 1); // steep
        }
        SurfaceTriangles fan;
        double least = 1;
        for (int i = 0; i < sides; ++i) {
            const int next = (i + 1) % sides;
            const Corners t{centre, rim[std::size_t(i)], rim[std::size_t(next)]};
            least = std::min(least, vdbcage::detail::minSine(t));
            fan.emplace_back(Vec3I(100U, unsigned(i), unsigned(next)), t);
        }
        if (least < minSine) continue;
        bool isAnyNear = false;
        for (std::size_t i = 0; i < fan.size(); ++i) {
            for (std::size_t j = i + 1; j < fan.size(); ++j) isAnyNear |= tooNear(fan[i], fan[j], spacing);
        }
        const bool isSpread = spreadOut(fan, spacing, minSine);
        BOOST_REQUIRE(!(isSpread && isAnyNear));
        spread += isSpread;
        near += isAnyNear;
    }
    BOOST_TEST(spread > 2000);
    BOOST_TEST(near > 200);
}

BOOST_AUTO_TEST_SUITE_END()
