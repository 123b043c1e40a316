// Loops that are split lengthwise.
#include <boost/test/unit_test.hpp>

#include <set>
#include <vector>

#include <vdbcage/bounding/detail/loops/loop_split.h>
#include <vdbcage/check/check.h>

#include "bounding/support/lump.h"
#include "bounding/support/quad_surface.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

BOOST_AUTO_TEST_SUITE(loop_split)

BOOST_AUTO_TEST_CASE(a_loop_that_is_split_is_two_loops)
{
    int split = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const test::Lump lump(seed);
        const test::Working before(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            test::Working now(lump.surface, lump.guard);
            const std::vector<std::uint32_t> middle = splitLoop(now.surface, now.table, loop);
            if (middle.empty()) continue;
            ++split;
            BOOST_TEST(middle.size() == loop.rungs.size());
            BOOST_TEST(now.table.count() == before.table.count() + loop.quads.size());
            BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
            Mesh quads;
            for (std::uint32_t v = 0; v < now.surface.vertices(); ++v) quads.points.push_back(now.surface.point(v));
            quads.quads = now.quads();
            BOOST_TEST(test::isOfQuads(quads));
            BOOST_TEST(test::loopsByUnion(quads).size() == test::loopsByUnion(lump.surface).size() + 1);
            BOOST_TEST(test::twoFacesMakeEach(now));
            BOOST_TEST(checkCage(now.surface.mesh(), lump.model).bounding());
        }
    }
    BOOST_TEST(split > 50);
}

BOOST_AUTO_TEST_CASE(a_loop_from_plane_to_plane_is_split_too)
{
    constexpr int resolution = 8;
    const Mesh model = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    const BoundingGuard guard = test::guardOf(model, true);
    const Mesh half = guard.symmetrized(test::ball(resolution), 0.25 / resolution);
    const test::Working before(half, guard);
    int split = 0;
    for (const QuadLoop& loop : straightLoops(before.table)) {
        if (loop.isClosed()) continue;
        BOOST_TEST(loop.rungs.size() == loop.quads.size() + 1);
        test::Working now(half, guard);
        if (splitLoop(now.surface, now.table, loop).empty()) continue;
        ++split;
        BOOST_TEST(now.surface.liveFaces() == 2 * now.table.count());
        BOOST_TEST(test::twoFacesMakeEach(now));
        BOOST_TEST(checkCage(now.surface.mesh(), model).bounding());
    }
    BOOST_TEST(split > 5);
}

BOOST_AUTO_TEST_CASE(new_vertices_are_at_the_middles_of_the_rungs_and_others_stay)
{
    int split = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const test::Lump lump(seed);
        const test::Working before(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            test::Working now(lump.surface, lump.guard);
            const std::vector<std::uint32_t> middle = splitLoop(now.surface, now.table, loop);
            if (middle.empty()) continue;
            ++split;
            for (std::uint32_t v = 0; v < before.surface.vertices(); ++v)
                BOOST_TEST(now.surface.point(v) == before.surface.point(v));
            BOOST_TEST(now.surface.vertices() == before.surface.vertices() + middle.size());
            for (std::size_t i = 0; i < middle.size(); ++i) {
                const Vec3d a = before.surface.point(loop.rungs[i][0]), b = before.surface.point(loop.rungs[i][1]);
                const double off = (now.surface.point(middle[i]) - 0.5 * (a + b)).length();
                BOOST_TEST(off <= 0.31 * (a - b).length()); // raised twice at most: when it comes, when it is joined
            }
            // Along each side of the old loop there is a quad from the rung's end to its middle.
            for (std::size_t i = 0; i < loop.quads.size(); ++i) {
                const std::size_t next = (i + 1) % loop.rungs.size();
                for (const std::size_t side : {0U, 1U}) {
                    const std::set<std::uint32_t> corners{loop.rungs[i][side], loop.rungs[next][side], middle[i],
                                                          middle[next]};
                    std::size_t found = 0;
                    for (const Vec4I& q : now.quads())
                        found += std::set<std::uint32_t>{q[0], q[1], q[2], q[3]} == corners;
                    BOOST_TEST(found == 1U);
                }
            }
        }
    }
    BOOST_TEST(split > 30);
}

BOOST_AUTO_TEST_CASE(what_the_guard_forbids_gives_no_vertices)
{
    // The rungs' middles have to keep an angle that halves do not.
    int refused = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        GuardOptions strict = test::Lump::close();
        strict.minAngleDegrees = 30;
        const test::Lump lump(seed);
        const BoundingGuard guard(lump.model, strict);
        const test::Working before(lump.surface, guard);
        for (const QuadLoop& loop : straightLoops(before.table)) {
            test::Working now(lump.surface, guard);
            refused += splitLoop(now.surface, now.table, loop).empty();
            BOOST_TEST(test::isClosedManifold(now.surface.mesh())); // if half changed
        }
    }
    BOOST_TEST(refused > 10);
}

BOOST_AUTO_TEST_SUITE_END()
