#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <tools/edit/mirror.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec3d;

namespace {

Vec3d imageOf(Vec3d p, int axis, double place)
{
    p[axis] = 2 * place - p[axis];
    return p;
}

/// Points in pairs and on the plane, with floats' coordinates as cages have, some without a partner; shuffled.
struct Cloud {
    explicit Cloud(unsigned seed) : random(seed), axis(static_cast<int>(seed % 3))
    {
        place = seed % 4 == 0 ? 0 : double(float(real(random)));
        for (int i = 0; i < 40; ++i) {
            Vec3d p(float(real(random)), float(real(random)), float(real(random)));
            if (i % 5 == 0) p[axis] = place;
            points.push_back(p);
            if (i % 5 != 0 && i % 7 != 0) points.push_back(imageOf(p, axis, place));
        }
        std::shuffle(points.begin(), points.end(), random);
    }

    std::mt19937 random;
    std::uniform_real_distribution<double> real{-1, 1};
    int axis;
    double place = 0;
    std::vector<Vec3d> points;
};

} // namespace

BOOST_AUTO_TEST_SUITE(mirror)

BOOST_AUTO_TEST_CASE(partners_are_those_that_a_search_finds)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        const Cloud cloud(seed);
        const auto partners = mirrorPartners(cloud.points, cloud.axis, cloud.place);
        std::size_t pairs = 0;
        for (Index i = 0; i < cloud.points.size(); ++i) {
            Index expected = none;
            for (Index j = 0; j < cloud.points.size(); ++j) {
                if (imageOf(cloud.points[i], cloud.axis, cloud.place) == cloud.points[j] &&
                    imageOf(cloud.points[j], cloud.axis, cloud.place) == cloud.points[i]) {
                    expected = j;
                }
            }
            BOOST_TEST(partners[i] == expected);
            pairs += expected != none;
        }
        BOOST_TEST(pairs > 50U);
    }
}

BOOST_AUTO_TEST_CASE(partners_are_mutual_and_in_order_where_several_are_at_one_place)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3d> points{{1, 5, 0}, {3, 5, 0}, {2, 5, 0},   {1, 5, 0}, {2, 5, 0},
                                    {3, 5, 0}, {1, 5, 0}, {nan, 5, 0}, {1, 6, 0}, {2, -0.0, 0}};
    const std::vector<Index> expected{1, 0, 2, 5, 4, 3, none, none, none, 9};
    BOOST_TEST(mirrorPartners(points, 0, 2) == expected, boost::test_tools::per_element());
    // Rounding takes the first one to the second one's place, but that one to 0.
    BOOST_TEST(mirrorPartners({{1e-17, 0, 0}, {2, 0, 0}}, 0, 1) == (std::vector<Index>{none, none}),
               boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(touched_pairs_become_exactly_symmetric_and_nothing_else_moves)
{
    for (unsigned seed = 0; seed < 300; ++seed) {
        Cloud cloud(seed);
        const auto partners = mirrorPartners(cloud.points, cloud.axis, cloud.place);
        const double size = seed % 2 == 0 ? 1 : 1e3;
        std::vector<Vec3d> before = cloud.points;
        if (seed % 3 == 0) { // a pose that is not symmetric yet
            for (Vec3d& p : before) p += 0.1 * Vec3d(cloud.real(cloud.random), 0, cloud.real(cloud.random));
        }
        std::vector<Vec3d> after = before;
        std::vector<Index> touched;
        for (Index i = 0; i < after.size(); ++i) {
            if (cloud.random() % 3 != 0) continue;
            touched.push_back(i);
            for (int k = 0; k < 3; ++k) after[i][k] += size * cloud.real(cloud.random);
        }
        const auto result = mirrored(before, after, touched, partners, cloud.axis, cloud.place);
        std::set<Index> pairs(touched.begin(), touched.end());
        for (const Index i : touched) {
            if (partners[i] != none) pairs.insert(partners[i]);
        }
        const double bit = 1e-15 * std::max(size, 1.0);
        for (Index i = 0; i < result.size(); ++i) {
            if (pairs.count(i) == 0 || partners[i] == none) {
                BOOST_CHECK(result[i] == after[i]);
                continue;
            }
            const Index j = partners[i];
            BOOST_CHECK(result[j] == imageOf(result[i], cloud.axis, cloud.place));
            if (i == j) {
                BOOST_TEST(result[i][cloud.axis] == cloud.place);
                continue;
            }
            const bool one = std::count(touched.begin(), touched.end(), i) > 0;
            const bool other = std::count(touched.begin(), touched.end(), j) > 0;
            const double mine = before[i][cloud.axis], its = before[j][cloud.axis];
            const bool leads = one && (!other || mine > its || (mine == its && i < j));
            if (leads) BOOST_TEST((result[i] - after[i]).length() <= bit);
        }
        // The same once more changes nothing.
        BOOST_CHECK(mirrored(before, result, touched, partners, cloud.axis, cloud.place) == result);
    }
}

BOOST_AUTO_TEST_CASE(images_of_all_sizes_are_mutual)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> real(-1, 1), exponent(-60, 60);
    const std::vector<Index> partners{1, 0};
    for (int i = 0; i < 100000; ++i) {
        const double place = std::ldexp(real(random), static_cast<int>(exponent(random)));
        const Vec3d p(std::ldexp(real(random), static_cast<int>(exponent(random))), 0, 0);
        const auto result = mirrored({{1, 0, 0}, {0, 0, 0}}, {p, p}, {0}, partners, 0, place);
        BOOST_REQUIRE(result[1].x() == 2 * place - result[0].x());
        BOOST_REQUIRE(result[0].x() == 2 * place - result[1].x());
        const double size = std::max(std::abs(p.x()), std::abs(place));
        BOOST_REQUIRE(std::abs(result[0].x() - p.x()) <= 1e-15 * size);
    }
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_refused)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<Vec3d> two(2, Vec3d(0));
    const std::vector<Index> partners{0, 1};
    for (const int axis : {-1, 3}) {
        BOOST_CHECK_THROW(mirrorPartners(two, axis, 0), InputError);
        BOOST_CHECK_THROW(mirrored(two, two, {}, partners, axis, 0), InputError);
    }
    BOOST_CHECK_THROW(mirrorPartners(two, 0, nan), InputError);
    BOOST_CHECK_THROW(mirrored(two, two, {}, partners, 0, nan), InputError);
    BOOST_CHECK_THROW(mirrored(two, {}, {}, partners, 0, 0), InputError);
    BOOST_CHECK_THROW(mirrored(two, two, {}, {}, 0, 0), InputError);
    BOOST_CHECK(mirrored(two, two, {}, partners, 0, 0) == two);
}

BOOST_AUTO_TEST_SUITE_END()
