#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/mesh/io/polygon_splitter.h>

using namespace vdbcage;
using openvdb::Vec3d;
using Loop = std::vector<Vec3d>;

namespace {

struct Split {
    std::vector<openvdb::Vec3I> triangles;
    std::vector<openvdb::Vec4I> quads;
};

Split split(const Loop& loop)
{
    std::vector<openvdb::Index32> face(loop.size());
    std::iota(face.begin(), face.end(), 0U);
    Split result;
    detail::PolygonSplitter(loop).split(face.data(), face.size(), result.triangles, result.quads);
    return result;
}

Vec3d areaVector(const Loop& loop)
{
    Vec3d sum(0, 0, 0);
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += (loop[i] - loop[0]).cross(loop[(i + 1) % loop.size()] - loop[0]);
    return sum;
}

/// Each triangle keeps the orientation; together they have the polygon's area, so that none overlaps another or leaves
/// it.
void checkTriangles(const Loop& loop, const std::vector<openvdb::Vec3I>& triangles, double slack = 1e-9)
{
    BOOST_TEST_REQUIRE(triangles.size() == loop.size() - 2);
    const Vec3d whole = areaVector(loop);
    double sum = 0;
    for (const openvdb::Vec3I& t : triangles) {
        const Vec3d area = (loop[t[1]] - loop[t[0]]).cross(loop[t[2]] - loop[t[0]]);
        BOOST_TEST(area.dot(whole) > -slack * whole.dot(whole));
        sum += area.length();
    }
    BOOST_TEST(sum == whole.length(), boost::test_tools::tolerance(slack));
}

/// The same division, given as numbers of corners and places.
std::set<std::set<openvdb::Index32>> cornerSets(const std::vector<openvdb::Vec3I>& triangles)
{
    std::set<std::set<openvdb::Index32>> sets;
    for (const openvdb::Vec3I& t : triangles) sets.insert({t[0], t[1], t[2]});
    return sets;
}

/// Places a polygon of the plane somewhere in space; the map keeps orientation.
Loop placed(const std::vector<std::pair<double, double>>& polygon, std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const Vec3d w = Vec3d(normal(random), normal(random), normal(random)).unit();
    const Vec3d u = w.cross(std::abs(w.x()) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)).unit();
    const Vec3d v = w.cross(u);
    const Vec3d origin(normal(random), normal(random), normal(random));
    Loop loop;
    for (const auto& [x, y] : polygon) loop.push_back(origin + x * u + y * v);
    return loop;
}

Loop flat(const std::vector<std::pair<double, double>>& polygon)
{
    Loop loop;
    for (const auto& [x, y] : polygon) loop.emplace_back(x, y, 0.0);
    return loop;
}

} // namespace

BOOST_AUTO_TEST_SUITE(polygon_splitter)

BOOST_AUTO_TEST_CASE(a_convex_quad_stays)
{
    const Split result = split(flat({{0, 0}, {2, 0}, {3, 1}, {0, 1}}));
    BOOST_TEST(result.triangles.empty());
    BOOST_REQUIRE(result.quads.size() == 1U);
    BOOST_CHECK(result.quads[0] == openvdb::Vec4I(0, 1, 2, 3));
}

BOOST_AUTO_TEST_CASE(a_concave_quad_is_split_at_its_inward_corner)
{
    Loop loop = flat({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}});
    for (unsigned inward = 3, turn = 0; turn < 4; ++turn, inward = (inward + 3) % 4) {
        const Split result = split(loop);
        BOOST_TEST(result.quads.empty());
        checkTriangles(loop, result.triangles);
        for (const auto& corners : cornerSets(result.triangles)) BOOST_TEST(corners.count(inward) == 1U);
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

BOOST_AUTO_TEST_CASE(a_quad_with_a_straight_angle_is_split_so_that_both_halves_have_an_area)
{
    Loop loop = flat({{0, 0}, {1, 0}, {2, 0}, {0, 2}});
    for (int turn = 0; turn < 4; ++turn) {
        const Split result = split(loop);
        checkTriangles(loop, result.triangles);
        for (const openvdb::Vec3I& t : result.triangles) {
            BOOST_TEST((loop[t[1]] - loop[t[0]]).cross(loop[t[2]] - loop[t[0]]).length() > 0.1);
        }
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

BOOST_AUTO_TEST_CASE(a_quad_that_no_diagonal_divides_stays)
{
    for (const Loop& loop : {flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), flat({{0, 0}, {1, 0}, {1, 1}, {1, 1}}),
                             flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}}), flat({{1, 1}, {1, 1}, {1, 1}, {1, 1}})}) {
        BOOST_TEST(split(loop).quads.size() == 1U);
    }
}

BOOST_AUTO_TEST_CASE(a_convex_polygon_becomes_a_fan)
{
    for (std::size_t n = 5; n < 200; n += 7) {
        std::vector<std::pair<double, double>> circle;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * detail::pi * double(i) / double(n);
            circle.emplace_back(3 * std::cos(angle), std::sin(angle));
        }
        const Split result = split(flat(circle));
        checkTriangles(flat(circle), result.triangles);
        for (const auto& corners : cornerSets(result.triangles)) BOOST_TEST(corners.count(0) == 1U);
    }
}

BOOST_AUTO_TEST_CASE(a_letter_v_becomes_a_fan_from_its_inward_corner)
{
    // Each other corner lies outside an arm that it would have to reach into.
    const Loop loop = flat({{-2, 12}, {-0.5, -1}, {0.5, -1}, {2, 12}, {0, 1}});
    const Split result = split(loop);
    checkTriangles(loop, result.triangles);
    for (const auto& corners : cornerSets(result.triangles)) BOOST_TEST(corners.count(4) == 1U);
}

// Polygons with corners at growing angles see them all from the origin, but hardly ever from one of them.
BOOST_DATA_TEST_CASE(ragged_stars_are_divided_without_overlap, boost::unit_test::data::xrange(300))
{
    std::mt19937 random(static_cast<unsigned>(sample));
    std::uniform_real_distribution<double> radius(0.2, 1.0);
    const int n = 5 + sample % 40 + (sample % 10 == 0 ? 200 : 0);
    std::vector<std::pair<double, double>> star;
    for (int i = 0; i < n; ++i) {
        const double r = radius(random);
        star.emplace_back(r * std::cos(2 * detail::pi * i / n), r * std::sin(2 * detail::pi * i / n));
    }
    const Loop loop = placed(star, random);
    checkTriangles(loop, split(loop).triangles);
    Loop doubled; // so that no corner has an area
    for (const Vec3d& p : loop) doubled.insert(doubled.end(), 2, p);
    checkTriangles(doubled, split(doubled).triangles);
}

BOOST_DATA_TEST_CASE(combs_and_spirals_are_divided_without_overlap, boost::unit_test::data::xrange(40))
{
    std::mt19937 random(static_cast<unsigned>(sample));
    std::vector<std::pair<double, double>> comb = {{sample + 2.0, 0}, {sample + 2.0, 1}};
    for (int i = sample + 1; i >= 0; --i) {
        comb.emplace_back(i + 0.6, 0.1);
        comb.emplace_back(i + 0.0, 1);
    }
    comb.emplace_back(0, 0);
    checkTriangles(flat(comb), split(flat(comb)).triangles);
    const Loop combInSpace = placed(comb, random);
    checkTriangles(combInSpace, split(combInSpace).triangles);

    std::vector<std::pair<double, double>> spiral;
    const int n = 20 + 5 * sample;
    for (int side = 0; side < 2; ++side) {
        for (int i = 0; i < n; ++i) {
            const int j = side == 0 ? i : n - 1 - i;
            const double angle = 0.2 * j;
            const double r = 1 + angle + (side == 0 ? 1.5 : 0);
            spiral.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
    }
    checkTriangles(flat(spiral), split(flat(spiral)).triangles);
    const Loop spiralInSpace = placed(spiral, random);
    checkTriangles(spiralInSpace, split(spiralInSpace).triangles);
}

BOOST_AUTO_TEST_CASE(straight_angles_do_not_make_flat_triangles)
{
    // A square with many corners on its sides: no fan has an area everywhere.
    std::vector<std::pair<double, double>> square;
    for (int i = 0; i < 10; ++i) square.emplace_back(i, 0);
    for (int i = 0; i < 10; ++i) square.emplace_back(10, i);
    for (int i = 0; i < 10; ++i) square.emplace_back(10 - i, 10);
    for (int i = 0; i < 10; ++i) square.emplace_back(0, 10 - i);
    const Loop loop = flat(square);
    const Split result = split(loop);
    checkTriangles(loop, result.triangles);
    for (const openvdb::Vec3I& t : result.triangles) {
        BOOST_TEST((loop[t[1]] - loop[t[0]]).cross(loop[t[2]] - loop[t[0]]).length() > 0);
    }
}

BOOST_AUTO_TEST_CASE(a_hole_joined_to_the_outline_by_a_cut_is_left_open)
{
    const Loop loop = flat({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}});
    const Split result = split(loop);
    checkTriangles(loop, result.triangles);
    const Vec3d inHole(4.5, 4.4, 0);
    for (const openvdb::Vec3I& t : result.triangles) {
        bool inside = true;
        for (int i = 0; i < 3; ++i) {
            inside = inside && (loop[t[(i + 1) % 3]] - loop[t[i]]).cross(inHole - loop[t[i]]).z() > 0;
        }
        BOOST_TEST(!inside);
    }
}

BOOST_AUTO_TEST_CASE(a_flat_corner_on_one_side_of_a_cut_is_in_nobodys_way)
{
    Loop loop = flat({{0, 0}, {9, 0}, {9, 9}, {0, 9}, {0, 0}, {1.5, 1.5}, {3, 3}, {3, 6}, {6, 6}, {6, 3}, {3, 3}});
    for (std::size_t turn = 0; turn < loop.size(); ++turn) {
        checkTriangles(loop, split(loop).triangles);
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

BOOST_AUTO_TEST_CASE(units_do_not_matter)
{
    const Loop letter = flat({{-2, 12}, {-0.5, -1}, {0.5, -1}, {2, 12}, {0, 1}});
    const Loop dart = flat({{0, 0}, {2, 1}, {0, 2}, {0.5, 1}});
    for (const Loop& loop : {letter, dart}) {
        const auto expected = cornerSets(split(loop).triangles);
        for (const int exponent : {-1070, -600, 600, 1020}) {
            Loop scaled = loop;
            for (Vec3d& p : scaled) {
                for (int axis = 0; axis < 3; ++axis) p[axis] = std::ldexp(p[axis], exponent);
            }
            BOOST_CHECK(cornerSets(split(scaled).triangles) == expected);
        }
    }
}

BOOST_AUTO_TEST_CASE(senseless_polygons_still_give_two_triangles_less_than_corners)
{
    std::mt19937 random(7);
    std::uniform_int_distribution<int> coordinate(-2, 2);
    for (std::size_t n = 5; n < 300; ++n) {
        Loop loop(n);
        for (Vec3d& p : loop) p = Vec3d(coordinate(random), coordinate(random), n % 3 == 0 ? coordinate(random) : 0);
        const Split result = split(loop);
        BOOST_TEST(result.triangles.size() == n - 2);
        for (const openvdb::Vec3I& t : result.triangles) BOOST_TEST((t[0] < n && t[1] < n && t[2] < n));
    }
}

BOOST_AUTO_TEST_CASE(alternatives_hold_every_triangle_of_every_fan)
{
    for (const std::size_t n : {4U, 5U, 8U, 9U, 20U, 64U}) {
        std::vector<openvdb::Index32> face(n);
        for (std::size_t i = 0; i < n; ++i) face[i] = static_cast<openvdb::Index32>(10 + i);
        std::vector<openvdb::Vec3I> triangles;
        detail::addAlternatives(face.data(), n, triangles);
        const auto found = cornerSets(triangles);
        for (std::size_t apex = 0; apex < n; ++apex) {
            for (std::size_t i = 1; i + 1 < n; ++i) {
                BOOST_TEST(found.count({face[apex], face[(apex + i) % n], face[(apex + i + 1) % n]}) == 1U);
            }
        }
    }
    std::vector<openvdb::Vec3I> none;
    detail::addAlternatives(std::vector<openvdb::Index32>(65).data(), 65, none);
    BOOST_TEST(none.empty());
}

BOOST_AUTO_TEST_CASE(there_are_as_many_alternatives_as_announced)
{
    for (std::size_t n = 4; n <= 66; ++n) {
        std::vector<openvdb::Index32> face(n);
        std::iota(face.begin(), face.end(), 0U);
        std::vector<openvdb::Vec3I> triangles;
        detail::addAlternatives(face.data(), n, triangles);
        BOOST_TEST(triangles.size() == detail::alternativesOf(n));
    }
}

namespace {

constexpr double turn = 2 * detail::pi;

Vec3d onCircle(double angle, double radius)
{
    return {radius * std::cos(angle), radius * std::sin(angle), 0};
}

/// Faces of n corners or a few less that do not cross themselves.
std::vector<Loop> largeFaces(std::size_t n)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Loop> faces(7);
    for (std::size_t i = 0; i < n; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(n);
        faces[0].push_back(onCircle(turn * part, 1));                                         // convex
        faces[1].push_back(onCircle(turn * part, i % 2 == 0 ? 0.5 : 1));                      // a star
        faces[2].emplace_back(1 - 2 * part, i % 2 == 0 ? -0.9 : 0.5 + 0.4 * unit(random), 0); // a comb
        faces[3].emplace_back(1 - 2 * part, i % 4 < 2 ? -0.9 : 1, 0);                         // with blunt teeth
        faces[4].push_back(onCircle(turn / 4 * (1 - part), i % 2 == 0 ? 1e-6 : 5e-7)); // all in one place but a corner
        faces[5].push_back(onCircle(turn * part, 1 + 0.2 * std::sin(50 * turn * part)));
    }
    for (const std::size_t comb : {2U, 3U}) {
        faces[comb].emplace_back(-1, -1, 0);
        faces[comb].emplace_back(1, -1, 0);
    }
    faces[4].emplace_back(-1, -1, 0);
    std::reverse(faces[4].begin(), faces[4].end());
    for (int side = 0; side < 2; ++side) { // a spiral
        for (std::size_t i = 0; i < n / 2; ++i) {
            const double part = static_cast<double>(side == 0 ? i : n / 2 - 1 - i) / static_cast<double>(n / 2);
            faces[6].push_back(onCircle(40 * turn * part, 0.05 + 0.9 * part + (side == 0 ? 0.01 : 0)));
        }
    }
    return faces;
}

/// Faces of n corners that have no right division.
std::vector<Loop> senselessFaces(std::size_t n)
{
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<Loop> faces(6);
    for (std::size_t i = 0; i < n; ++i) {
        faces[0].emplace_back(unit(random), 0, 0);
        const double t = unit(random);
        faces[1].emplace_back(t, t / 3, t / 7); // a line but for rounding
        faces[2].emplace_back(1, 2, 3);
        faces[3].push_back(onCircle(turn * static_cast<double>(random() % 5) / 5, 1));
        faces[4].emplace_back(unit(random), unit(random), unit(random));
        faces[5].emplace_back(static_cast<double>(random() % 300), static_cast<double>(random() % 300), 0);
    }
    return faces;
}

std::size_t workOf(const Loop& loop)
{
    std::vector<openvdb::Index32> face(loop.size());
    std::iota(face.begin(), face.end(), 0U);
    Split result;
    detail::PolygonSplitter splitter(loop);
    splitter.split(face.data(), face.size(), result.triangles, result.quads);
    BOOST_TEST(result.triangles.size() == loop.size() - 2);
    return splitter.work();
}

} // namespace

BOOST_AUTO_TEST_CASE(large_faces_are_divided_right)
{
    for (const Loop& loop : largeFaces(6000)) checkTriangles(loop, split(loop).triangles);
}

BOOST_AUTO_TEST_CASE(work_grows_as_the_corners_do)
{
    for (const Loop& loop : largeFaces(100000)) BOOST_TEST(workOf(loop) < 1000 * loop.size());
}

BOOST_AUTO_TEST_CASE(work_on_senseless_faces_is_bounded)
{
    for (const Loop& loop : senselessFaces(50000)) BOOST_TEST(workOf(loop) < 4096 * loop.size());
}

// A fan's triangles are as long as the face: nothing that looks them up is fast.
BOOST_AUTO_TEST_CASE(large_convex_faces_have_short_triangles)
{
    const Loop loop = largeFaces(20000)[0];
    double length = 0;
    for (const openvdb::Vec3I& t : split(loop).triangles) length += (loop[t[0]] - loop[t[2]]).length();
    BOOST_TEST(length < 20 * turn);
}

BOOST_AUTO_TEST_SUITE_END()
