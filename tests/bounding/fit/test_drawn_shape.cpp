#include <boost/test/unit_test.hpp>

#include <random>
#include <vector>

#include <vdbcage/bounding/detail/fit/drawn_shape.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"

using namespace vdbcage;
using namespace vdbcage::detail;

BOOST_AUTO_TEST_SUITE(drawn_shapes)

BOOST_AUTO_TEST_CASE(vertices_go_back_all_the_way_or_as_far_as_they_may)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.4, 10), {}, nullptr);
    const Mesh ball = test::sphere({0, 0, 0}, 0.5, 7), far = test::sphere({0, 0, 0}, 0.7, 7);
    GuardedMesh surface(far, guard, GuardedMesh::Quads::keep);
    std::vector<Vec3d> drawn;
    for (const Vec3d& p : ball.points) drawn.push_back(guard.rounded(guard.scaled(p)));
    moveBack(surface, drawn, nullptr);
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) BOOST_TEST((surface.point(v) == drawn[v]));

    for (Vec3d& p : drawn) p *= 0.5; // now inside of the model
    const double before = (surface.point(5) - drawn[5]).length();
    moveBack(surface, drawn, nullptr);
    for (const std::uint32_t f : test::facesAndAlternates(surface))
        BOOST_TEST(guard.clear(surface.corners(f), TriangleBvh::none, nullptr));
    BOOST_TEST((surface.point(5) - drawn[5]).length() < 0.9 * before);
}

BOOST_AUTO_TEST_CASE(the_change_of_the_term_is_that_of_its_sum)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.2, 6), {}, nullptr);
    const GuardedMesh surface(test::sphere({0, 0, 0}, 0.5, 6), guard, GuardedMesh::Quads::keep);
    std::mt19937 random(7);
    std::vector<Vec3d> drawn;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v)
        drawn.push_back(surface.point(v) + test::randomVector(random, 0.05));
    const DrawnShapeTerm term(surface, drawn, 1.5);
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        const StarChange star = starOf(surface, v);
        const Vec3d p = surface.point(v);
        Quadratic change;
        const double sum = term.add(surface, star, p, change);
        BOOST_TEST(sum > 0);
        const Vec3d d = test::randomVector(random, 0.1);
        Quadratic ignored;
        const double expected = 0.5 * d.dot(change.curvature * d) + change.slope.dot(d);
        BOOST_TEST(std::abs(term.add(surface, star, p + d, ignored) - sum - expected) < 1e-12);
        BOOST_TEST(term.keepsFit(surface, star, p + d));
    }
    // As it was drawn nothing is to pay.
    std::vector<Vec3d> same;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) same.push_back(surface.point(v));
    Quadratic change;
    BOOST_TEST(DrawnShapeTerm(surface, same, 1).add(surface, starOf(surface, 3), surface.point(3), change) == 0);
    BOOST_TEST((change.slope == Vec3d(0.0)));
}

BOOST_AUTO_TEST_CASE(pinned_vertices_stay_and_faces_may_cut_only_where_they_are_let)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.4, 10), {}, nullptr);
    GuardedMesh surface(test::sphere({0, 0, 0}, 0.5, 7), guard, GuardedMesh::Quads::keep);
    const std::uint32_t v = 20;
    const Vec3d out = 1.05 * surface.point(v), in = 0.7 * surface.point(v);
    BOOST_TEST(allows(surface, starOf(surface, v), out));
    BOOST_TEST(!allows(surface, starOf(surface, v), in));
    GuardedMesh cutting = surface;
    for (const std::uint32_t f : test::facesAndAlternates(cutting)) cutting.letCut(f, true);
    BOOST_TEST(allows(cutting, starOf(cutting, v), in));
    for (const std::uint32_t f : test::facesAndAlternates(cutting)) cutting.letCut(f, false);
    BOOST_TEST(!allows(cutting, starOf(cutting, v), in));
    surface.limit(v, {surface.point(v), {false, false, false}});
    BOOST_TEST(!allows(surface, starOf(surface, v), out));
    BOOST_TEST(allows(surface, starOf(surface, v + 1), 1.05 * surface.point(v + 1)));
}

BOOST_AUTO_TEST_SUITE_END()
