// Loops that collapse, all rungs or none, against surfaces without them by their numbers.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <vector>

#include <vdbcage/bounding/detail/loops/loop_collapse.h>
#include <vdbcage/check/check.h>

#include "bounding/support/lump.h"
#include "bounding/support/quad_surface.h"

using namespace vdbcage;
using namespace vdbcage::detail;

BOOST_AUTO_TEST_SUITE(loop_collapse)

BOOST_AUTO_TEST_CASE(what_is_collapsed_is_what_the_rungs_join)
{
    int collapsed = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const test::Working before(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            test::Working now(lump.surface, lump.guard);
            if (!collapseLoop(now.surface, now.table, now.quadrics, loop, [](const auto&) { return true; })) continue;
            ++collapsed;
            BOOST_TEST(now.table.count() == before.table.count() - loop.quads.size());
            BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
            BOOST_TEST(checkCage(now.surface.mesh(), lump.model).bounding());
            BOOST_TEST(test::treeIsRight(now.surface));
            BOOST_TEST(test::twoFacesMakeEach(now));
        }
    }
    BOOST_TEST(collapsed > 30);
}

BOOST_AUTO_TEST_CASE(a_collapse_that_is_not_accepted_leaves_no_trace)
{
    int refused = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const test::Working before(lump.surface, lump.guard);
        test::Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            const bool done = collapseLoop(now.surface, now.table, now.quadrics, loop, [&](const auto&) {
                ++refused;
                return false;
            });
            BOOST_TEST(!done);
            BOOST_CHECK(test::same(before, now));
            BOOST_TEST(test::treeIsRight(now.surface));
        }
    }
    BOOST_TEST(refused > 30);
}

BOOST_AUTO_TEST_CASE(a_collapse_that_the_guard_stops_leaves_no_trace)
{
    // Specks in the corners of the voxels hold the surface: some rungs may go, others not.
    int stopped = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const BoundingGuard guard(test::speckled(seed, 6), test::Lump::close());
        if (!guard.facesTooNear(lump.surface).empty()) continue;
        const test::Working before(lump.surface, guard);
        test::Working now(lump.surface, guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            bool wasAsked = false;
            collapseLoop(now.surface, now.table, now.quadrics, loop, [&](const auto&) {
                wasAsked = true;
                return false;
            });
            stopped += !wasAsked;
            BOOST_CHECK(test::same(before, now));
        }
    }
    BOOST_TEST(stopped > 10);
}

BOOST_AUTO_TEST_CASE(a_collapse_costs_what_its_rungs_do_at_their_best_places)
{
    int loops = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(now.table)) {
            double sum = 0;
            for (const Rung& rung : loop.rungs) {
                Quadric both = now.quadrics.of(rung[0]);
                both += now.quadrics.of(rung[1]);
                sum += now.quadrics.cost(both, now.quadrics.optimum(both, rung[0], rung[1]));
            }
            BOOST_TEST(collapseCost(now.quadrics, loop) == sum, boost::test_tools::tolerance(1e-9));
            ++loops;
        }
    }
    BOOST_TEST(loops > 20);
}

BOOST_AUTO_TEST_CASE(what_settles_is_told_the_vertices_that_the_rungs_became)
{
    int told = 0, moved = 0;
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const test::Lump lump(seed);
        const test::Working before(lump.surface, lump.guard);
        std::vector<QuadLoop> loops = straightLoops(before.table);
        const std::vector<QuadLoop> turning = turningLoops(before.surface, before.table);
        loops.insert(loops.end(), turning.begin(), turning.end());
        for (const QuadLoop& loop : loops) {
            if (!leavesQuads(before.surface, before.table, loop)) continue;
            const auto groups = test::mergedGroups(loop);
            for (const bool isAccepted : {true, false}) {
                test::Working now(lump.surface, lump.guard);
                std::vector<std::uint32_t> given;
                collapseLoop(now.surface, now.table, now.quadrics, loop, [&](const std::vector<std::uint32_t>& kept) {
                    given = kept;
                    for (const std::uint32_t v : kept) { // they may move
                        const StarChange star = starOf(now.surface, v);
                        const Vec3d place =
                            rounded(now.surface, star, now.surface.point(v) + 0.3 * outward(now.surface, star));
                        if (!allows(now.surface, star, place)) continue;
                        now.surface.apply(star, place);
                        ++moved;
                    }
                    return isAccepted;
                });
                if (given.empty()) continue;
                ++told;
                BOOST_TEST(std::is_sorted(given.begin(), given.end()));
                BOOST_TEST(given.size() == groups.size());
                for (const auto& group : groups) {
                    BOOST_TEST(std::count_if(given.begin(), given.end(),
                                             [&](std::uint32_t v) { return group.count(v) > 0; }) == 1);
                    std::size_t left = 0;
                    for (const std::uint32_t v : group) left += now.surface.isVertex(v);
                    BOOST_TEST(left == (isAccepted ? 1 : group.size()));
                }
                if (!isAccepted) BOOST_CHECK(test::same(before, now));
                if (isAccepted) BOOST_TEST(test::twoFacesMakeEach(now));
            }
        }
    }
    BOOST_TEST(told > 50);
    BOOST_TEST(moved > 100);
}

BOOST_AUTO_TEST_SUITE_END()
