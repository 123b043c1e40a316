// Rows of collapses, against the cheapest of all edges and against being made anew.
#include <boost/test/unit_test.hpp>

#include <limits>
#include <random>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/triangles/collapse.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "bounding/support/manifold.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

Mesh start(const BoundingGuard& guard, int resolution)
{
    const Mesh ball = test::ball(resolution);
    return guard.symmetry() ? guard.symmetrized(ball, 0.25 / resolution) : ball;
}

/// Rough, so that hardly two collapses cost the same.
Mesh roughBall(int resolution, unsigned seed)
{
    std::mt19937 random(seed);
    Mesh ball = test::ball(resolution);
    for (Vec3d& p : ball.points) p += test::randomVector(random, 0.2 / resolution);
    return ball;
}

} // namespace

BOOST_AUTO_TEST_SUITE(collapse)

BOOST_AUTO_TEST_CASE(the_cheapest_edge_that_may_go_goes_first)
{
    int same = 0, all = 0;
    for (unsigned seed = 1; seed <= 24; ++seed) {
        const BoundingGuard guard(test::soup(seed, 20, 0.1));
        GuardedMesh before(roughBall(6, seed), modelOf(guard));
        // On the model many edges may not go where that costs least.
        if (seed % 2 == 0) tighten(before, 8, areaPerSample(before, before.liveFaces(), 4), nullptr);
        const VertexQuadrics quadrics(before);
        int blocked = 0;
        double least = std::numeric_limits<double>::infinity();
        StarChange best;
        Vec3d bestPlace(0.0);
        for (std::uint32_t u = 0; u < before.vertices(); ++u) {
            for (const std::uint32_t v : before.neighbours(u)) {
                StarChange star;
                if (v < u || !starOfCollapse(before, u, v, star)) continue;
                const Quadric q = quadrics.sum(u, v);
                const auto place = quadrics.findPlace(star, q, true);
                blocked += !allows(before, star, rounded(before, star, quadrics.optimum(q, u, v)));
                if (!place || quadrics.cost(q, *place) >= least) continue;
                least = quadrics.cost(q, *place);
                best = star;
                bestPlace = *place;
            }
        }
        if (seed % 2 == 0) BOOST_TEST(blocked > 50);
        GuardedMesh expected = before, surface = before;
        expected.apply(best, bestPlace);
        collapseByQuadrics(surface, before.liveFaces() - 2, nullptr);
        BOOST_TEST(surface.liveFaces() == before.liveFaces() - 2);
        same += test::sameSurface(surface, expected);
        ++all;
    }
    // An optimum that is too far away is taken for dearer than it is.
    BOOST_TEST(same >= all - 2);
}

BOOST_AUTO_TEST_CASE(as_many_faces_are_left_as_asked_and_the_surface_bounds)
{
    for (const bool isSymmetric : {false, true}) {
        const Mesh model = test::soup(3, 30, 0.1);
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const GuardedMesh before(start(guard, 10), modelOf(guard));
        for (const std::size_t faces : {200U, 90U, 50U}) {
            GuardedMesh exact = before, inBatches = before;
            collapseByQuadrics(exact, faces, nullptr);
            collapseInBatches(inBatches, faces, nullptr);
            BOOST_TEST(exact.liveFaces() <= faces);
            BOOST_TEST(exact.liveFaces() + 2 > faces);
            BOOST_TEST(inBatches.liveFaces() <= faces);
            BOOST_TEST(inBatches.liveFaces() + 16 > faces);
            for (const GuardedMesh* surface : {&exact, &inBatches}) {
                const Mesh mesh = surface->mesh();
                BOOST_TEST(test::isClosedManifold(mesh));
                BOOST_TEST(checkCage(mesh, model).bounding());
                BOOST_TEST(test::listsAreRight(*surface));
                BOOST_TEST(test::treeIsRight(*surface));
                if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
            }
        }
        GuardedMesh all = before; // as few as the model allows
        collapseByQuadrics(all, 0, nullptr);
        BOOST_TEST(all.liveFaces() < 50U);
        GuardedMesh none = before;
        collapseByQuadrics(none, before.liveFaces(), nullptr);
        BOOST_TEST(test::sameSurface(none, before));
    }
}

BOOST_AUTO_TEST_CASE(where_collapses_end_no_edge_may_go)
{
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const BoundingGuard guard(test::soup(seed, 30, 0.1));
        GuardedMesh surface(test::ball(6), modelOf(guard));
        collapseByQuadrics(surface, 0, nullptr);
        const GuardedMesh end = surface;
        collapseByQuadrics(surface, 0, nullptr); // with quadrics of what is left
        BOOST_TEST(surface.liveFaces() <= end.liveFaces());
        const VertexQuadrics quadrics(surface);
        std::size_t mayGo = 0;
        for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
            if (!surface.isVertex(u)) continue;
            for (const std::uint32_t v : surface.neighbours(u)) {
                StarChange star;
                if (u > v || !starOfCollapse(surface, u, v, star)) continue;
                mayGo += quadrics.findPlace(star, quadrics.sum(u, v), true).has_value();
            }
        }
        BOOST_TEST(mayGo == 0U);
    }
}

BOOST_AUTO_TEST_CASE(a_recorded_row_gives_what_collapses_made_anew_give)
{
    const BoundingGuard guard(test::soup(3, 30, 0.1));
    const GuardedMesh before(test::ball(9), modelOf(guard));
    std::mt19937 random(1);
    for (int round = 0; round < 3; ++round) {
        CollapseSequence sequence(before);
        for (int i = 0; i < 8; ++i) {
            const std::size_t faces = 20 + random() % before.liveFaces();
            GuardedMesh anew = before;
            collapseInBatches(anew, faces, nullptr);
            BOOST_TEST(test::sameSurface(sequence.at(faces, nullptr), anew));
        }
        GuardedMesh end = before;
        collapseInBatches(end, 0, nullptr);
        BOOST_TEST(test::sameSurface(sequence.at(0, nullptr), end));
        BOOST_TEST(test::sameSurface(sequence.at(before.liveFaces(), nullptr), before));
    }
}

BOOST_AUTO_TEST_CASE(a_recorded_row_goes_on_after_it_was_cancelled)
{
    const BoundingGuard guard(test::soup(3, 30, 0.1));
    const GuardedMesh before(test::ball(9), modelOf(guard));
    GuardedMesh expected = before;
    collapseInBatches(expected, 60, nullptr);
    test::StopAt never(1000000);
    CollapseSequence(before).at(60, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 10);
    for (int i = 0; i < asked; i += 5) {
        CollapseSequence sequence(before);
        test::StopAt stop(i);
        BOOST_CHECK_THROW(sequence.at(60, &stop), Cancelled);
        BOOST_TEST(test::sameSurface(sequence.at(60, nullptr), expected));
    }
    for (int i = 0; i < 3; ++i) {
        GuardedMesh surface = before;
        test::StopAt stop(i);
        BOOST_CHECK_THROW(collapseByQuadrics(surface, 20, &stop), Cancelled);
        BOOST_TEST(test::listsAreRight(surface));
        BOOST_TEST(test::isClosedManifold(surface.mesh()));
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const BoundingGuard guard(test::soup(3, 30, 0.1));
    const auto make = [&](auto collapses) {
        GuardedMesh surface(test::ball(12), modelOf(guard));
        collapses(surface, 70, nullptr);
        return surface;
    };
    const GuardedMesh many = make(collapseByQuadrics), manyInBatches = make(collapseInBatches);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST(test::sameSurface(many, make(collapseByQuadrics)));
    BOOST_TEST(test::sameSurface(manyInBatches, make(collapseInBatches)));
}

BOOST_AUTO_TEST_SUITE_END()
