#include <boost/test/unit_test.hpp>

#include <array>
#include <random>

#include <vdbcage/geometry/quadric.h>

using openvdb::Vec3d;
using vdbcage::detail::Quadric;

namespace {

constexpr double stiffness = 1e-3;

Vec3d randomPoint(std::mt19937& random)
{
    std::uniform_real_distribution<double> coordinate(-1, 1);
    return {coordinate(random), coordinate(random), coordinate(random)};
}

/// Of planes through `point`, with the area's middle at `middle`.
Quadric through(const Vec3d& point, const Vec3d& middle, std::initializer_list<Vec3d> normals)
{
    Quadric q;
    for (const Vec3d& normal : normals) {
        q.addPlane(normal / normal.length(), point, 1);
        q.addSpread(middle, 1);
    }
    return q;
}

Vec3d bestPlace(const Quadric& q)
{
    Vec3d place;
    BOOST_REQUIRE(q.bestPlace(stiffness, place));
    return place;
}

void checkNear(const Vec3d& a, const Vec3d& b)
{
    BOOST_TEST((a - b).length() < 1e-9, a << " is not " << b);
}

} // namespace

BOOST_AUTO_TEST_SUITE(quadrics)

BOOST_AUTO_TEST_CASE(the_best_place_is_on_the_planes_and_near_the_middle)
{
    const Vec3d corner(0.3, -0.2, 0.5), middle(0.7, 0.1, 0.2);
    const Vec3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    checkNear(bestPlace(through(corner, middle, {x, y, z})), corner);
    checkNear(bestPlace(through(corner, middle, {x, y})), {corner[0], corner[1], middle[2]});
    checkNear(bestPlace(through(corner, middle, {z})), {middle[0], middle[1], corner[2]});
    checkNear(bestPlace(through(corner, middle, {x + y + z, x - y, y + 2.0 * z})), corner);
    Vec3d place;
    BOOST_TEST(!Quadric().bestPlace(stiffness, place));
}

BOOST_AUTO_TEST_CASE(four_side_by_side_are_found_as_one_by_one)
{
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i) {
        std::array<Quadric, 4> quadrics;
        for (Quadric& q : quadrics) {
            const auto planes = random() % 5; // none, one: flat, two: an edge, more: not through one point
            for (unsigned k = 0; k < planes; ++k) {
                q.addPlane(randomPoint(random).unit(), randomPoint(random), 0.1);
                q.addSpread(randomPoint(random), 0.1);
            }
        }
        std::array<Vec3d, 4> places;
        const std::array<bool, 4> found = Quadric::bestPlaces(quadrics, stiffness, places);
        for (std::size_t k = 0; k < 4; ++k) {
            Vec3d place;
            BOOST_REQUIRE(quadrics[k].bestPlace(stiffness, place) == found[k]);
            if (found[k]) BOOST_REQUIRE(place == places[k]);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
