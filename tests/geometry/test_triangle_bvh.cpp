#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <support/triangle_soup.h>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/triangle_bvh.h>
#include <vdbcage/geometry/triangle_distance.h>

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

struct Soup : test::TriangleSoup {
    TriangleBvh tree() const { return {points, triangles}; }
};

// Sizes over many scales, some degenerate, some on a lattice, some the same.
Soup randomSoup(unsigned seed, std::size_t count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = std::pow(10, -2 + 2 * unit(random));
        const Vec3d centre(unit(random), unit(random), unit(random));
        const auto kind = random() % 8;
        for (int corner = 0; corner < 3; ++corner) {
            Vec3d p = centre + size * Vec3d(unit(random), unit(random), unit(random));
            if (kind == 0 && corner == 2) p = soup.points.back();
            if (kind == 1) p = Vec3d(std::round(4 * p[0]), std::round(4 * p[1]), std::round(4 * p[2])) / 4.0;
            if (kind == 2) p = Vec3d(0.5, 0.25, 0.125);
            soup.points.push_back(p);
        }
        const auto first = static_cast<unsigned>(3 * i);
        soup.triangles.emplace_back(first, first + 1, first + 2);
    }
    return soup;
}

// Both splits of quads, most nearly flat, and triangles alone among them: so many that leaves hold up to four.
Soup manyQuads()
{
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(-1, 1);
    const auto anyPoint = [&] { return Vec3d(unit(random), unit(random), unit(random)); };
    Soup soup;
    while (soup.triangles.size() < (1U << 19) + 1000U) {
        const auto kind = random() % 8;
        const Vec3d corner = anyPoint(), u = 0.02 * anyPoint(), v = kind == 0 ? u : 0.02 * anyPoint();
        const double bulge = kind == 1 ? 1 : 1e-3;
        const auto first = static_cast<unsigned>(soup.points.size());
        for (const Vec3d& p : {corner, corner + u, corner + u + v, corner + v}) {
            soup.points.push_back(p + 0.02 * bulge * anyPoint());
        }
        soup.triangles.emplace_back(first, first + 1, first + 2);
        if (kind == 2) continue;
        soup.triangles.emplace_back(first, first + 2, first + 3);
        soup.triangles.emplace_back(first, first + 1, first + 3);
        soup.triangles.emplace_back(first + 1, first + 2, first + 3);
    }
    return soup;
}

// Tubes of eight sides, much longer than wide, side by side: all along `direction`, or in any directions where it is 0.
// Some sides are so narrow that they are a line, and some there twice. Capped ends are there in every split.
Soup needles(std::size_t count, const Vec3d& direction, double length = 100, bool isCapped = false)
{
    std::mt19937 random(19);
    std::uniform_real_distribution<double> unit(-1, 1);
    Soup soup;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3d along = direction;
        if (direction.isZero()) along = Vec3d(unit(random), unit(random), 0.1 * unit(random));
        along.normalize();
        const Vec3d across = Vec3d(0, 0, 1).cross(along).unit(), up = along.cross(across);
        const Vec3d centre = 0.4 * unit(random) * across + 0.03 * unit(random) * up;
        const double width = i % 10 == 0 ? 0 : 0.012;
        const auto first = static_cast<unsigned>(soup.points.size());
        for (const double end : {-0.5, 0.5}) {
            for (int side = 0; side < 8; ++side) {
                const double angle = side * std::acos(-1) / 4;
                soup.points.push_back(centre + end * length * along +
                                      width * (std::cos(angle) * across + std::sin(angle) * up));
            }
        }
        for (unsigned side = 0; side < 8; ++side) {
            const unsigned a = first + side, b = first + (side + 1) % 8;
            soup.triangles.emplace_back(a, b, b + 8);
            soup.triangles.emplace_back(a, b + 8, a + 8);
        }
        if (i % 7 == 0) soup.triangles.push_back(Vec3I(soup.triangles.back()));
    }
    for (unsigned first = 0; isCapped && first < soup.points.size(); first += 8) {
        for (unsigned c = 2; c < 8; ++c) {
            for (unsigned b = 1; b < c; ++b) {
                for (unsigned a = 0; a < b; ++a) soup.triangles.emplace_back(first + c, first + b, first + a);
            }
        }
    }
    return soup;
}

using Numbers = std::multiset<std::uint32_t>;

} // namespace

BOOST_AUTO_TEST_SUITE(triangle_bvh)

BOOST_AUTO_TEST_CASE(every_triangle_is_found_once)
{
    for (const std::size_t count : {0U, 1U, 2U, 4U, 5U, 6U, 9U, 1000U, 20000U}) {
        const TriangleBvh tree = randomSoup(1, count).tree();
        Numbers found;
        const double infinity = std::numeric_limits<double>::infinity();
        const Box everywhere{Vec3d(-infinity), Vec3d(infinity)};
        tree.traverse(tree.inBox(everywhere),
                      [&](const TriangleBvh::Item& item) { return found.insert(item.triangle), true; });
        BOOST_TEST(found.size() == count);
        BOOST_TEST(tree.items().size() == count);
        std::uint32_t expected = 0;
        BOOST_TEST(std::all_of(found.begin(), found.end(), [&](std::uint32_t t) { return t == expected++; }));
    }
}

BOOST_AUTO_TEST_CASE(box_overlaps_equal_brute_force, *boost::unit_test::label("property"))
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.2, 1.2);
    const Soup soup = randomSoup(2, 3000);
    const TriangleBvh tree = soup.tree();
    for (int i = 0; i < 200; ++i) {
        Box box = Box::of(Vec3d(unit(random), unit(random), unit(random)));
        if (i % 4 == 1) box.expand(Box::of(box.lo + 0.1 * Vec3d(unit(random), unit(random), unit(random))));
        if (i % 4 == 2) box = Box::of(soup.points[random() % soup.points.size()]); // exactly on a corner
        if (i % 4 == 3) box.hi[0] = std::numeric_limits<double>::infinity();       // a ray
        Numbers expected, found;
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            if (box.meets(Box::of(soup.corners(t)))) expected.insert(t);
        }
        tree.forEachOverlap(box, [&](const TriangleBvh::Item& item) { return found.insert(item.triangle), true; });
        BOOST_TEST((found == expected));
    }
}

BOOST_AUTO_TEST_CASE(a_visitor_can_stop)
{
    const TriangleBvh tree = randomSoup(6, 100).tree();
    int calls = 0;
    const auto thrice = [&](const auto&...) { return ++calls < 3; };
    BOOST_TEST(!tree.forEachOverlap(tree.box(), thrice));
    BOOST_TEST(calls == 3);
    calls = 0;
    BOOST_TEST(!tree.traverse(tree.inBox(tree.box()), thrice));
    BOOST_TEST(calls == 3);
}

BOOST_AUTO_TEST_CASE(closest_equals_brute_force, *boost::unit_test::label("property"))
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-2, 2);
    const Soup soup = randomSoup(8, 3000);
    const TriangleBvh tree = soup.tree();
    std::uint32_t seed = TriangleBvh::none;
    int rougher = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3d p(unit(random), unit(random), unit(random));
        double expected = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
            expected = std::min(expected, (closestPointOnTriangle(p, soup.corners(t)) - p).lengthSqr());
        }
        const TriangleBvh::Closest closest = tree.closest(p, seed);
        seed = closest.item;
        BOOST_TEST(closest.squaredDistance == expected, boost::test_tools::tolerance(1e-12));
        BOOST_TEST((closest.point - p).lengthSqr() == closest.squaredDistance);
        const double slack = 0.3, atMost = (1 + slack) * (1 + slack) * expected;
        const TriangleBvh::Closest rough = tree.closest(p, TriangleBvh::none, slack);
        BOOST_TEST(rough.squaredDistance <= atMost * (1 + 1e-9));
        BOOST_TEST((rough.point - p).lengthSqr() == rough.squaredDistance);
        rougher += rough.squaredDistance > expected;
    }
    BOOST_TEST(rougher > 0);
    BOOST_TEST(TriangleBvh().closest(Vec3d(0)).item == TriangleBvh::none);
}

BOOST_AUTO_TEST_CASE(the_closest_point_of_a_triangle_beats_all_others, *boost::unit_test::label("property"))
{
    const Soup soup = randomSoup(9, 500);
    std::mt19937 random(10);
    std::uniform_real_distribution<double> unit(-2, 2);
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
        const Corners corners = soup.corners(t);
        const Vec3d p(unit(random), unit(random), unit(random));
        const double distance = (closestPointOnTriangle(p, corners) - p).length();
        double least = 1e9; // over a fine net of the triangle
        constexpr int n = 60;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; i + j <= n; ++j) {
                const Vec3d q = (corners[0] * (n - i - j) + corners[1] * i + corners[2] * j) / double(n);
                least = std::min(least, (q - p).length());
            }
        }
        const double size = (corners[1] - corners[0]).length() + (corners[2] - corners[0]).length();
        BOOST_TEST(distance <= least + 1e-9);
        BOOST_TEST(distance >= least - 2 * size / n - 1e-9); // hence it is a point of the triangle, or next to one
    }
}

// Regions are asked for in the place and size of the query, which may be far from the tree's.
BOOST_AUTO_TEST_CASE(queries_miss_no_triangle, *boost::unit_test::label("property"))
{
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1, 1);
    const Soup soup = randomSoup(12, 1500);
    const TriangleBvh tree = soup.tree();
    std::size_t visits = 0, asked = 0;
    for (int i = 0; i < 300; ++i) {
        const double size = std::pow(10, -3 + 5 * std::abs(unit(random)));
        const Vec3d centre(unit(random), unit(random), unit(random));
        const auto point = [&] { return centre + size * Vec3d(unit(random), unit(random), unit(random)); };
        Corners t{point(), point(), point()};
        if (i % 10 == 1) t[2] = t[1];
        if (i % 10 == 2) t[2] = t[0] + (t[1] - t[0]) * (1 + 1e-9); // a sliver
        if (i % 10 == 3) t[0] = soup.points[random() % soup.points.size()];
        const double maxDistance = i % 3 == 0 ? 0 : 0.1 * std::abs(unit(random));
        std::set<std::uint32_t> near, inside;
        tree.traverse(tree.near(t, maxDistance),
                      [&](const TriangleBvh::Item& item) { return near.insert(item.triangle).second; });
        const std::array<Vec3d, 4> corners{t[0], t[1], t[2], i % 7 ? point() : t[0]};
        tree.traverse(tree.inTetrahedron(corners),
                      [&](const TriangleBvh::Item& item) { return inside.insert(item.triangle).second; });
        visits += near.size();
        ++asked;
        const auto mixed = [&](const std::array<double, 4>& weights) {
            const double sum = weights[0] + weights[1] + weights[2] + weights[3];
            return (corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2] +
                    corners[3] * weights[3]) /
                   sum;
        };
        for (std::uint32_t s = 0; s < soup.triangles.size(); ++s) {
            const Corners other = soup.corners(s);
            double distance = 1e9;
            bool within = false;
            for (int k = 0; k < 60; ++k) {
                // Points of the query: a triangle whose box holds one of them has to be found.
                const auto weight = [&] { return std::abs(unit(random)); };
                const double a = weight(), b = weight(), c = weight(), d = weight();
                const Vec3d onTriangle = mixed({a, b, c, 0});
                distance = std::min(distance, (closestPointOnTriangle(onTriangle, other) - onTriangle).length());
                within = within || Box::of(mixed({a, b, c, d})).meets(Box::of(other));
            }
            if (distance <= maxDistance) BOOST_TEST(near.count(s) == 1);
            if (within) BOOST_TEST(inside.count(s) == 1);
        }
    }
    BOOST_TEST(visits < asked * soup.triangles.size() / 2); // they are of some use
}

BOOST_AUTO_TEST_CASE(a_query_may_get_narrower_on_the_way, *boost::unit_test::label("property"))
{
    const Soup soup = randomSoup(15, 2000);
    const TriangleBvh tree = soup.tree();
    std::mt19937 random(16);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::size_t whole = 0, visits = 0, within = 0;
    for (int i = 0; i < 200; ++i) {
        const auto point = [&] { return Vec3d(unit(random), unit(random), unit(random)); };
        std::array<Vec3d, 4> left{point(), point(), point(), point()};
        TriangleBvh::Query query = tree.inTetrahedron(left);
        tree.traverse(query, [&](const TriangleBvh::Item&) {
            ++whole;
            return true;
        });
        std::set<std::uint32_t> seen;
        tree.traverse(query, [&](const TriangleBvh::Item& item) {
            BOOST_TEST(seen.insert(item.triangle).second);
            if (seen.size() % 10 == 0) {
                left[1] = left[0] + 0.8 * (left[1] - left[0]);
                query = tree.inTetrahedron(left);
            }
            return true;
        });
        visits += seen.size();
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            for (int k = 0; k < 20; ++k) {
                Vec3d p(0.0);
                double sum = 0;
                for (const Vec3d& corner : left) {
                    const double weight = std::abs(unit(random));
                    p += weight * corner;
                    sum += weight;
                }
                if (!Box::of(p / sum).meets(Box::of(soup.corners(t)))) continue;
                ++within;
                BOOST_TEST(seen.count(t) == 1);
            }
        }
    }
    BOOST_TEST(within > 1000);
    BOOST_TEST(visits < 3 * whole / 4);
}

BOOST_AUTO_TEST_CASE(a_triangle_finds_what_it_touches_in_a_corner, *boost::unit_test::label("property"))
{
    for (const double scale : {1.0, 1e-12, 1e12, 1e-90, 1e-150, 1e150, 1e-308}) {
        Soup soup = randomSoup(13, 500);
        for (Vec3d& p : soup.points) p *= scale;
        const TriangleBvh tree = soup.tree();
        std::mt19937 random(14);
        std::uniform_real_distribution<double> unit(-1, 1);
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            const auto away = [&] { return scale * Vec3d(unit(random), unit(random), unit(random)); };
            const Corners query{away(), soup.corners(t)[t % 3], away()};
            bool found = false;
            tree.traverse(tree.near(query), [&](const TriangleBvh::Item& item) {
                found = found || item.triangle == t;
                return true;
            });
            BOOST_TEST(found);
        }
    }
}

BOOST_AUTO_TEST_CASE(any_size_and_place_of_the_coordinates)
{
    for (const double scale : {1e-300, 1e-30, 1e30, 1e300, 1e307}) {
        Soup soup = randomSoup(14, 500);
        for (Vec3d& p : soup.points) p *= scale;
        const TriangleBvh tree = soup.tree();
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            bool found = false;
            const Corners corners = soup.corners(t);
            tree.traverse(tree.near(corners), [&](const TriangleBvh::Item& item) {
                found = found || item.triangle == t;
                return true;
            });
            BOOST_TEST(found);
        }
    }
    // Geometric distances: the worst for equal bins. Still found, and the stack of a traversal is long enough.
    Soup soup;
    for (unsigned i = 0; i < 6000; ++i) {
        const double x = std::ldexp(1.0, 1000 - static_cast<int>(i % 2000));
        for (int k = 0; k < 3; ++k) soup.points.emplace_back(k == 0 ? x : 0, k == 1 ? x : 0, i < 3000 ? x : -x);
        soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    const TriangleBvh tree = soup.tree();
    std::size_t found = 0;
    tree.forEachOverlap(tree.box(), [&](const auto&) { return ++found, true; });
    BOOST_TEST(found == soup.triangles.size());
}

// Long thin triangles at an angle to the axes are in boxes along themselves.
BOOST_AUTO_TEST_CASE(needles_answer_as_brute_force_does, *boost::unit_test::label("property"))
{
    std::mt19937 random(20);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Soup> soups{needles(60, {0.6, 0.75, 0.27}), needles(60, {-1, 1, 1e-3}, 1e4),
                            needles(60, Vec3d(0.0), 10)};
    soups.push_back(randomSoup(21, 300)); // needles among others
    const Soup among = needles(40, {1, 1, 1});
    for (const Vec3I& t : among.triangles) {
        const auto first = static_cast<unsigned>(soups.back().points.size());
        for (int i = 0; i < 3; ++i) soups.back().points.push_back(0.01 * among.points[t[i]]);
        soups.back().triangles.emplace_back(first, first + 1, first + 2);
    }
    for (const Soup& soup : soups) {
        const TriangleBvh tree = soup.tree();
        std::uint32_t seed = TriangleBvh::none;
        for (int i = 0; i < 60; ++i) {
            // Near a triangle, or anywhere, also far away.
            const Corners any = soup.corners(random() % soup.triangles.size());
            const double place = std::abs(unit(random)), size = std::pow(10, -3 + 3 * std::abs(unit(random)));
            const auto near = [&](const Vec3d& p) {
                return p + size * Vec3d(unit(random), unit(random), unit(random));
            };
            const Vec3d p = i % 20 == 0 ? 1e5 * near(any[0]) : near(place * any[0] + (1 - place) * any[1]);
            const Corners query{p, near(p), i % 5 == 0 ? p : near(p)};
            const std::array<Vec3d, 4> corners{p, near(p), near(p), near(p)};
            const double maxDistance = i % 2 == 0 ? 0 : 0.1 * size;
            Box box = Box::of(p);
            box.expand(Box::of(query[1]));
            if (i % 3 == 0) box.hi[0] = std::numeric_limits<double>::infinity();
            Numbers nearby, inside, overlapping;
            const auto takeInto = [](Numbers& numbers) {
                return [&numbers](const TriangleBvh::Item& item) { return numbers.insert(item.triangle), true; };
            };
            tree.traverse(tree.near(query, maxDistance), takeInto(nearby));
            tree.traverse(tree.inTetrahedron(corners), takeInto(inside));
            tree.forEachOverlap(box, takeInto(overlapping));
            double nearest = std::numeric_limits<double>::infinity();
            for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
                const Corners triangle = soup.corners(t);
                nearest = std::min(nearest, (closestPointOnTriangle(p, triangle) - p).lengthSqr());
                const bool isNear = nearness(query, triangle).squaredDistance <= maxDistance * maxDistance;
                BOOST_REQUIRE_LE(nearby.count(t), 1U);
                BOOST_REQUIRE_GE(nearby.count(t), isNear ? 1U : 0U);
                // Points of the triangle that are in the tetrahedron or in the box.
                bool isInside = false, isInBox = false;
                for (const Vec3d& centre : {corners[0], box.lo, box.hi}) {
                    if (!centre.isFinite()) continue;
                    const Vec3d q = closestPointOnTriangle(centre, triangle);
                    isInBox = isInBox || box.meets(Box::of(q));
                    openvdb::Mat3d edges;
                    for (int k = 0; k < 3; ++k) edges.setCol(k, corners[static_cast<std::size_t>(k) + 1] - corners[0]);
                    const Vec3d weights = std::abs(edges.det()) > 1e-12 * size * size * size
                                              ? edges.inverse(0.0) * (q - corners[0])
                                              : Vec3d(-1);
                    isInside = isInside || (weights[0] >= 0 && weights[1] >= 0 && weights[2] >= 0 &&
                                            weights[0] + weights[1] + weights[2] <= 1);
                }
                BOOST_REQUIRE_LE(inside.count(t), 1U);
                BOOST_REQUIRE_GE(inside.count(t), isInside ? 1U : 0U);
                BOOST_REQUIRE_GE(overlapping.count(t), isInBox ? 1U : 0U);
                BOOST_REQUIRE_LE(overlapping.count(t), box.meets(Box::of(triangle)) ? 1U : 0U);
            }
            const TriangleBvh::Closest closest = tree.closest(p, seed);
            seed = closest.item;
            BOOST_TEST((closest.point - p).lengthSqr() == closest.squaredDistance);
            BOOST_TEST(std::sqrt(closest.squaredDistance) == std::sqrt(nearest), boost::test_tools::tolerance(1e-9));
            const TriangleBvh::Closest rough = tree.closest(p, TriangleBvh::none, 0.3);
            BOOST_TEST(rough.squaredDistance <= 1.3 * 1.3 * nearest * (1 + 1e-9));
        }
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
        const TriangleBvh one = soup.tree();
        BOOST_TEST(std::equal(tree.items().begin(), tree.items().end(), one.items().begin(), one.items().end(),
                              [](const auto& a, const auto& b) { return a.triangle == b.triangle; }));
    }
}

BOOST_AUTO_TEST_CASE(needles_at_an_angle_are_told_apart_as_others_are)
{
    const auto visits = [](const Vec3d& direction, bool isCapped, bool isAbove) {
        const Soup soup = needles(300, direction, 100, isCapped);
        const TriangleBvh tree(soup.points, soup.triangles, nullptr, TriangleBvh::Copies::drop);
        const Vec3d along = direction.unit(), across = Vec3d(0, 0, 1).cross(along).unit(), up = along.cross(across);
        std::mt19937 random(22);
        std::uniform_real_distribution<double> unit(-1, 1);
        std::size_t count = 0;
        for (int i = 0; i < 200; ++i) {
            const Vec3d middle = 45 * unit(random) * along + 0.4 * unit(random) * across;
            const auto corner = [&] {
                const double height = isAbove ? 0.1 + 0.04 * unit(random) : 0.05 * unit(random);
                return middle + unit(random) * along + 0.4 * unit(random) * across + height * up;
            };
            tree.traverse(tree.near({corner(), corner(), corner()}), [&](const auto&) { return ++count, true; });
        }
        return count;
    };
    for (const bool isCapped : {false, true}) {
        for (const bool isAbove : {false, true}) {
            const std::size_t along = visits({1, 0, 0}, isCapped, isAbove);
            for (const Vec3d& direction : {Vec3d(0.6, 0.75, 0.27), Vec3d(1, -1, 0), Vec3d(0.3, -0.2, 0.9)}) {
                BOOST_TEST(visits(direction, isCapped, isAbove) <= 2 * along);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    const Soup soup = randomSoup(15, 300000);
    const TriangleBvh many = soup.tree();
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const TriangleBvh one = soup.tree();
    const auto same = [](const TriangleBvh::Item& a, const TriangleBvh::Item& b) {
        return a.triangle == b.triangle && a.corners == b.corners;
    };
    BOOST_TEST(std::equal(many.items().begin(), many.items().end(), one.items().begin(), same));
    BOOST_TEST(many.closest(Vec3d(3, 1, 2)).item == one.closest(Vec3d(3, 1, 2)).item);
}

BOOST_AUTO_TEST_CASE(many_quads_answer_as_brute_force_does, *boost::unit_test::label("property"))
{
    std::mt19937 random(18);
    std::uniform_real_distribution<double> unit(-1.2, 1.2);
    const Soup soup = manyQuads();
    const TriangleBvh tree = soup.tree();
    Numbers all;
    tree.traverse(tree.inBox(tree.box()),
                  [&](const TriangleBvh::Item& item) { return all.insert(item.triangle), true; });
    std::uint32_t next = 0;
    BOOST_TEST(std::all_of(all.begin(), all.end(), [&](std::uint32_t t) { return t == next++; }));
    BOOST_TEST(next == soup.triangles.size());
    std::uint32_t seed = TriangleBvh::none;
    for (int i = 0; i < 20; ++i) {
        const Vec3d p(unit(random), unit(random), unit(random));
        Box box = Box::of(p);
        box.expand(Box::of(p + 0.1 * Vec3d(unit(random), unit(random), unit(random))));
        Numbers expected, found;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
            if (box.meets(Box::of(soup.corners(t)))) expected.insert(t);
            nearest = std::min(nearest, (closestPointOnTriangle(p, soup.corners(t)) - p).lengthSqr());
        }
        tree.forEachOverlap(box, [&](const TriangleBvh::Item& item) { return found.insert(item.triangle), true; });
        BOOST_TEST((found == expected));
        const TriangleBvh::Closest closest = tree.closest(p, seed);
        seed = closest.item;
        BOOST_TEST(closest.squaredDistance == nearest, boost::test_tools::tolerance(1e-12));
        const Corners nearestTriangle = tree.corners(tree.items()[closest.item]);
        BOOST_TEST((closestPointOnTriangle(p, nearestTriangle) - p).lengthSqr() == closest.squaredDistance);
        BOOST_TEST(tree.closest(p, seed).item == seed);
    }
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const TriangleBvh one = soup.tree();
    const auto same = [](const TriangleBvh::Item& a, const TriangleBvh::Item& b) {
        return a.triangle == b.triangle && a.corners == b.corners;
    };
    BOOST_TEST(std::equal(tree.items().begin(), tree.items().end(), one.items().begin(), same));
}

BOOST_AUTO_TEST_CASE(building_can_be_cancelled)
{
    const Soup soup = randomSoup(16, 50000);
    test::StopAt never(1000000);
    const TriangleBvh tree(soup.points, soup.triangles, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 20); // at each split of thousands
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(TriangleBvh(soup.points, soup.triangles, &stop), Cancelled);
    }
}

namespace {

/// Triangle t of the soup `times` times, in any order of corners, every second time with points of its own.
void addCopies(Soup& soup, std::size_t t, std::size_t times)
{
    const Vec3I corners = soup.triangles[t];
    for (std::size_t i = 0; i < times; ++i) {
        Vec3I copy(corners[static_cast<int>(i % 3)], corners[static_cast<int>((i + 1 + i / 3 % 2) % 3)],
                   corners[static_cast<int>((i + 2 - i / 3 % 2) % 3)]);
        if (i % 2 == 0) {
            for (int corner = 0; corner < 3; ++corner) {
                soup.points.push_back(Vec3d(soup.points[copy[corner]]));
                copy[corner] = static_cast<unsigned>(soup.points.size() - 1);
            }
        }
        soup.triangles.push_back(copy);
    }
}

void expectSameAnswers(const TriangleBvh& tree, const TriangleBvh& all)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (int i = 0; i < 300; ++i) {
        const Vec3d p(unit(random), unit(random), unit(random));
        // Corners in another order round another way.
        BOOST_TEST(tree.closest(p).squaredDistance == all.closest(p).squaredDistance,
                   boost::test_tools::tolerance(1e-12));
        const Box box{p - Vec3d(0.01), p + Vec3d(0.01)};
        const auto none = [](const TriangleBvh::Item&) { return false; };
        BOOST_TEST(tree.forEachOverlap(box, none) == all.forEachOverlap(box, none));
    }
}

} // namespace

BOOST_AUTO_TEST_CASE(copies_are_dropped_if_asked_for)
{
    for (const std::size_t times : {std::size_t(3000), std::size_t(200000)}) { // below and above many triangles
        Soup soup = randomSoup(8, 500);
        for (const std::size_t t : {3U, 40U, 41U}) addCopies(soup, t, times);
        const TriangleBvh all = soup.tree();
        BOOST_TEST(all.items().size() == 500 + 3 * times);
        const TriangleBvh tree(soup.points, soup.triangles, nullptr, TriangleBvh::Copies::drop);
        BOOST_TEST(tree.items().size() >= 400U); // some of the soup are the same
        BOOST_TEST(tree.items().size() < 1500U);
        expectSameAnswers(tree, all);
    }
    Soup one = randomSoup(1, 1);
    addCopies(one, 0, 10000);
    const TriangleBvh tree(one.points, one.triangles, nullptr, TriangleBvh::Copies::drop);
    BOOST_TEST(tree.items().size() <= 4U);
    expectSameAnswers(tree, one.tree());
}

BOOST_AUTO_TEST_CASE(what_is_no_copy_stays)
{
    // One box, but other corners: the four triangles of squares, and zeros of either sign.
    Soup soup;
    for (int i = 0; i < 50; ++i) {
        const auto first = static_cast<unsigned>(soup.points.size());
        for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 1, 0), Vec3d(0, 1, 0)}) {
            soup.points.push_back(i % 2 == 0 ? p : Vec3d(p[0] > 0 ? 1 : -0.0, p[1] > 0 ? 1 : -0.0, -0.0));
        }
        for (unsigned without = 0; without < 4; ++without) {
            soup.triangles.emplace_back(first + (without == 0 ? 1 : 0), first + (without < 2 ? 2 : 1),
                                        first + (without < 3 ? 3 : 2));
        }
    }
    const TriangleBvh tree(soup.points, soup.triangles, nullptr, TriangleBvh::Copies::drop);
    BOOST_TEST(tree.items().size() == 4U);
    std::set<std::uint32_t> first;
    for (const TriangleBvh::Item& item : tree.items()) first.insert(item.triangle % 4);
    BOOST_TEST(first.size() == 4U);

    const Soup quads = manyQuads();
    const TriangleBvh many(quads.points, quads.triangles, nullptr, TriangleBvh::Copies::drop);
    BOOST_TEST(many.items().size() == quads.triangles.size());
}

BOOST_AUTO_TEST_SUITE_END()
