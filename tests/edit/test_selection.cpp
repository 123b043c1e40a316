#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include "meshes.h"
#include <tools/edit/selection.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::edit;

namespace {

std::vector<Index> pointsOfOne(const Elements& elements, Element kind, Index id)
{
    if (kind == Element::point) return {id};
    if (kind == Element::edge) return {elements.edges()[id].first, elements.edges()[id].second};
    return {elements.pointsOfFace(id).begin(), elements.pointsOfFace(id).end()};
}

bool contains(const Selection& selection, Index id)
{
    return std::binary_search(selection.ids.begin(), selection.ids.end(), id);
}

bool includes(const Selection& large, const Selection& small)
{
    return std::includes(large.ids.begin(), large.ids.end(), small.ids.begin(), small.ids.end());
}

bool isAscending(const Selection& selection)
{
    return std::adjacent_find(selection.ids.begin(), selection.ids.end(), std::greater_equal<>()) ==
           selection.ids.end();
}

/// Whether two elements of a kind are neighbours, by their points.
bool areNeighbours(const Elements& elements, Element kind, Index a, Index b)
{
    if (kind == Element::point) return elements.edgeBetween(a, b) != none;
    for (const Index p : pointsOfOne(elements, kind, a)) {
        for (const Index q : pointsOfOne(elements, kind, b)) {
            if (p == q) return true;
        }
    }
    return false;
}

/// Calls `check(mesh's elements, a selection of it)` for selections of each kind of many soups.
template <typename Check>
void forManySelections(const Check& check)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        const Elements elements(test::randomFaces(seed));
        for (const Element kind : test::elementKinds) {
            check(elements, test::someOf(elements, kind, random, 1 + seed % 6));
        }
    }
}

} // namespace

BOOST_AUTO_TEST_SUITE(selection)

BOOST_AUTO_TEST_CASE(conversion_takes_what_has_all_its_points_selected)
{
    forManySelections([](const Elements& elements, const Selection& selection) {
        std::vector<Index> points;
        for (const Index id : selection.ids) {
            for (const Index point : pointsOfOne(elements, selection.kind, id)) points.push_back(point);
        }
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
        BOOST_TEST(pointsOf(elements, selection) == points, boost::test_tools::per_element());
        for (const Element kind : test::elementKinds) {
            const Selection result = converted(elements, selection, kind);
            BOOST_CHECK(result.kind == kind);
            BOOST_TEST(isAscending(result));
            if (kind == selection.kind) {
                BOOST_CHECK(result == selection);
                continue;
            }
            for (Index id = 0; id < elements.count(kind); ++id) {
                const auto own = pointsOfOne(elements, kind, id);
                const bool isWithin = std::all_of(own.begin(), own.end(), [&](Index point) {
                    return std::binary_search(points.begin(), points.end(), point);
                });
                BOOST_TEST(contains(result, id) == isWithin);
            }
        }
    });
}

BOOST_AUTO_TEST_CASE(all_and_inverted_leave_out_only_points_without_faces)
{
    forManySelections([](const Elements& elements, const Selection& selection) {
        const Selection everything = all(elements, selection.kind), rest = inverted(elements, selection);
        for (Index id = 0; id < elements.count(selection.kind); ++id) {
            const bool isThere = selection.kind != Element::point || elements.isUsed(id);
            BOOST_TEST(contains(everything, id) == isThere);
            BOOST_TEST(contains(rest, id) == (isThere && !contains(selection, id)));
        }
        BOOST_CHECK(inverted(elements, rest) == selection);
        BOOST_CHECK(added(selection, rest) == everything);
        BOOST_CHECK(removed(everything, rest) == selection);
        BOOST_TEST(inverted(elements, everything).ids.empty());
    });
}

BOOST_AUTO_TEST_CASE(grown_adds_the_neighbours_and_shrunk_takes_them_away)
{
    forManySelections([](const Elements& elements, const Selection& selection) {
        const Selection more = grown(elements, selection), fewer = shrunk(elements, selection);
        for (Index id = 0; id < elements.count(selection.kind); ++id) {
            bool touchesIn = contains(selection, id), touchesOut = false;
            for (Index other = 0; other < elements.count(selection.kind); ++other) {
                if (!areNeighbours(elements, selection.kind, id, other)) continue;
                if (contains(selection, other)) touchesIn = true;
                if (!contains(selection, other)) touchesOut = true;
            }
            BOOST_TEST(contains(more, id) == touchesIn);
            BOOST_TEST(contains(fewer, id) == (contains(selection, id) && !touchesOut));
        }
    });
}

BOOST_AUTO_TEST_CASE(linked_is_grown_until_nothing_is_new)
{
    forManySelections([](const Elements& elements, const Selection& selection) {
        Selection expected = selection;
        for (;;) { // faces with a common point are connected, also for points and edges
            const Selection faces = grown(elements, converted(elements, expected, Element::point));
            Selection touched{Element::face, {}};
            for (Index face = 0; face < elements.count(Element::face); ++face) {
                for (const Index point : elements.pointsOfFace(face)) {
                    if (!contains(faces, point) || contains(touched, face)) continue;
                    touched.ids.push_back(face);
                }
            }
            const Selection next =
                added(expected, converted(elements, converted(elements, touched, Element::point), selection.kind));
            if (next == expected) break;
            expected = next;
        }
        BOOST_CHECK(linked(elements, selection) == expected);
    });
    const Elements two(test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::sphere({5, 0, 0}, 1, 4)));
    BOOST_TEST(linked(two, {Element::face, {}}).ids.empty());
    // The sphere's triangles come first, then the box's quads, then the sphere's quads.
    BOOST_TEST(linked(two, {Element::face, {16}}).ids == (std::vector<Index>{16, 17, 18, 19, 20, 21}),
               boost::test_tools::per_element());
    BOOST_TEST(linked(two, {Element::face, {0}}).ids.size() == 32U);
}

BOOST_AUTO_TEST_CASE(loops_of_any_soup_end_and_keep_what_was_selected)
{
    forManySelections([](const Elements& elements, const Selection& selection) {
        const Selection result = loop(elements, selection);
        BOOST_TEST(isAscending(result));
        BOOST_TEST(includes(result, selection));
    });
}

BOOST_AUTO_TEST_CASE(loops_of_edges_go_around_a_torus)
{
    const int around = 9, across = 5;
    const Elements quads(test::torus(2, 0.5, around, across));
    const auto at = [&](int i, int j) {
        return static_cast<Index>((i + around) % around * across + (j + across) % across);
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            std::vector<Index> ring, length;
            for (int k = 0; k < across; ++k) ring.push_back(quads.edgeBetween(at(i, k), at(i, k + 1)));
            for (int k = 0; k < around; ++k) length.push_back(quads.edgeBetween(at(k, j), at(k + 1, j)));
            std::sort(ring.begin(), ring.end());
            std::sort(length.begin(), length.end());
            BOOST_TEST(loop(quads, {Element::edge, {quads.edgeBetween(at(i, j), at(i, j + 1))}}).ids == ring,
                       boost::test_tools::per_element());
            BOOST_TEST(loop(quads, {Element::edge, {quads.edgeBetween(at(i, j), at(i + 1, j))}}).ids == length,
                       boost::test_tools::per_element());
            // Two neighbouring points mean the edge between them.
            Selection pair{Element::point, {at(i, j), at(i, j + 1)}};
            std::sort(pair.ids.begin(), pair.ids.end());
            BOOST_CHECK(loop(quads, pair) == converted(quads, {Element::edge, ring}, Element::point));
            BOOST_TEST(loop(quads, {Element::point, {at(i, j)}}).ids.size() == 1U);
        }
    }
    // Straight on through the points of six edges: along the grid, and along the diagonals.
    const Elements triangles(test::triangulatedTorus(around, across));
    const auto size = [&](Index a, Index b) {
        return loop(triangles, {Element::edge, {triangles.edgeBetween(a, b)}}).ids.size();
    };
    BOOST_TEST(size(at(0, 0), at(0, 1)) == std::size_t(across));
    BOOST_TEST(size(at(0, 0), at(1, 0)) == std::size_t(around));
    BOOST_TEST(size(at(0, 0), at(1, 1)) == std::size_t(around * across)); // winds until both numbers are through
}

BOOST_AUTO_TEST_CASE(loops_of_edges_end_at_other_points)
{
    // The corners of a box have three edges.
    const Elements cube(test::box({0, 0, 0}, {1, 1, 1}));
    for (Index edge = 0; edge < 12; ++edge) BOOST_TEST(loop(cube, {Element::edge, {edge}}).ids.size() == 1U);
    // A meridian of a sphere goes on beyond the poles, which have 8 edges and triangles only.
    const Elements sphere(test::sphere({0, 0, 0}, 1, 4));
    BOOST_TEST(loop(sphere, {Element::edge, {sphere.edgeBetween(1, 9)}}).ids.size() == 8U);
    BOOST_TEST(loop(sphere, {Element::edge, {sphere.edgeBetween(1, 2)}}).ids.size() == 8U);
    const Elements finer(test::sphere({0, 0, 0}, 1, 5));
    BOOST_TEST(loop(finer, {Element::edge, {finer.edgeBetween(1, 11)}}).ids.size() == 10U);
    // Six edges, but a quad among the faces: there is no telling what goes straight on.
    Mesh mixed = test::torus(2, 0.5, 9, 5);
    mixed.triangles = triangulate(mixed);
    mixed.triangles.erase(mixed.triangles.begin(), mixed.triangles.begin() + 2);
    mixed.quads.resize(1); // of the points 0, 5, 6, 1
    const Elements oneQuad(mixed);
    BOOST_TEST(oneQuad.edgesOfPoint(5).size() == 6U);
    BOOST_TEST(loop(oneQuad, {Element::edge, {oneQuad.edgeBetween(0, 5)}}).ids.size() == 1U);
    BOOST_TEST(loop(oneQuad, {Element::edge, {oneQuad.edgeBetween(2, 7)}}).ids.size() == 9U);
    // Five edges at each pole of a bipyramid have no opposite ones, nor have the three at a tetrahedron's points.
    Mesh bipyramid;
    bipyramid.points.resize(7);
    for (Index i = 0; i < 5; ++i) {
        bipyramid.triangles.emplace_back(i, (i + 1) % 5, 5U);
        bipyramid.triangles.emplace_back((i + 1) % 5, i, 6U);
    }
    const Elements five(bipyramid);
    BOOST_TEST(loop(five, {Element::edge, {five.edgeBetween(0, 5)}}).ids.size() == 2U);
    BOOST_TEST(loop(five, {Element::edge, {five.edgeBetween(0, 1)}}).ids.size() == 5U);
    Mesh tetrahedron;
    tetrahedron.points.resize(4);
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    BOOST_TEST(loop(Elements(tetrahedron), {Element::edge, {0}}).ids.size() == 1U);
    // Without its cap the pole is gone: both ends of a meridian are at the boundary.
    Mesh open = test::sphere({0, 0, 0}, 1, 4);
    open.triangles.clear();
    const Elements cut(open);
    BOOST_TEST(loop(cut, {Element::edge, {cut.edgeBetween(1, 9)}}).ids.size() == 2U);
    BOOST_TEST(loop(cut, {Element::edge, {cut.edgeBetween(1, 2)}}).ids.size() == 1U);
}

BOOST_AUTO_TEST_CASE(strips_of_quads_go_around_and_end_at_triangles)
{
    const int around = 9, across = 5;
    const Elements quads(test::torus(2, 0.5, around, across));
    const auto quad = [&](int i, int j) { return static_cast<Index>(i % around * across + j % across); };
    const auto selected = [](std::vector<Index> ids) {
        std::sort(ids.begin(), ids.end());
        return Selection{Element::face, std::move(ids)};
    };
    for (int i = 0; i < around; ++i) {
        for (int j = 0; j < across; ++j) {
            std::vector<Index> ring, length;
            for (int k = 0; k < across; ++k) ring.push_back(quad(i, k));
            for (int k = 0; k < around; ++k) length.push_back(quad(k, j));
            const Selection both = added(selected(ring), selected(length));
            BOOST_CHECK(loop(quads, selected({quad(i, j)})) == both);
            BOOST_CHECK(loop(quads, selected({quad(i, j), quad(i, j + 1)})) == selected(ring));
            BOOST_CHECK(loop(quads, selected({quad(i, j), quad(i + 1, j)})) == selected(length));
        }
    }
    // On a sphere the strip along a meridian ends at the triangles of the poles, and these have none.
    const Elements sphere(test::sphere({0, 0, 0}, 1, 4)); // 16 triangles, 8 times 2 quads
    BOOST_TEST(loop(sphere, {Element::face, {16, 17}}).ids.size() == 2U);
    BOOST_TEST(loop(sphere, {Element::face, {16}}).ids.size() == 2U + 8 - 1);
    BOOST_TEST(loop(sphere, {Element::face, {0}}).ids.size() == 1U);
    // Selecting the triangle beside it means the strip across their common edge.
    BOOST_TEST(loop(sphere, {Element::face, {0, 16}}).ids.size() == 3U);
}

BOOST_AUTO_TEST_CASE(two_kinds_do_not_go_together)
{
    const Selection points{Element::point, {0}}, faces{Element::face, {0}};
    BOOST_CHECK_THROW(added(points, faces), InputError);
    BOOST_CHECK_THROW(removed(points, faces), InputError);
    BOOST_CHECK(points != faces);
}

BOOST_AUTO_TEST_SUITE_END()
