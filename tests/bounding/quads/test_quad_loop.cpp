// Loops of quads, against walks and unions of sides made on the mesh, and surfaces without a loop, by their numbers.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/quads/quad_loop.h>
#include <vdbcage/volume/extract.h>

#include "bounding/support/lump.h"
#include "bounding/support/quad_surface.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

/// How many quads there are around each point.
std::vector<std::size_t> valencesOf(const Mesh& mesh)
{
    std::vector<std::size_t> valences(mesh.points.size(), 0);
    for (const Vec4I& q : mesh.quads) {
        for (int i = 0; i < 4; ++i) ++valences[q[i]];
    }
    return valences;
}

/// Whether no two quads have both ends of a diagonal in common, and no edge joins the ends of one.
bool diagonalsAreAlone(const Mesh& mesh)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges, diagonals;
    for (const Vec4I& q : mesh.quads) {
        for (int i = 0; i < 4; ++i) edges.insert(std::minmax(q[i], q[(i + 1) % 4]));
    }
    for (const Vec4I& q : mesh.quads) {
        for (const int i : {0, 1}) {
            const std::pair<std::uint32_t, std::uint32_t> diagonal = std::minmax(q[i], q[i + 2]);
            if (edges.count(diagonal) > 0 || !diagonals.insert(diagonal).second) return false;
        }
    }
    return true;
}

/// The most vertices that become one where the rungs of a loop become points.
std::size_t mostMerged(const QuadLoop& loop)
{
    std::size_t most = 0;
    for (const auto& group : test::mergedGroups(loop)) most = std::max(most, group.size());
    return most;
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_loop)

BOOST_AUTO_TEST_CASE(loops_are_those_that_the_sides_join)
{
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        std::multiset<std::set<std::size_t>> expected, found;
        for (const auto& loop : test::loopsByUnion(lump.surface)) {
            if (!test::isSimple(loop)) continue;
            std::set<std::size_t> quads;
            for (const auto& pass : loop) quads.insert(pass.first);
            expected.insert(quads);
        }
        for (const QuadLoop& loop : straightLoops(now.table)) {
            BOOST_TEST(loop.isClosed());
            found.insert({loop.quads.begin(), loop.quads.end()});
            for (std::size_t i = 0; i < loop.quads.size();
                 ++i) { // each rung is a side of the quads before and after it
                const auto [a, b] = loop.rungs[i];
                BOOST_TEST(now.table.sideOf(loop.quads[i], a, b) < 4);
                BOOST_TEST(now.table.sideOf(loop.quads[(i + loop.quads.size() - 1) % loop.quads.size()], b, a) < 4);
            }
        }
        BOOST_TEST(!expected.empty());
        BOOST_CHECK(found == expected);
    }
}

BOOST_AUTO_TEST_CASE(a_loop_may_go_if_quads_are_left)
{
    int mayGo = 0, mayNot = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : straightLoops(now.table)) {
            const bool may = leavesQuads(now.surface, now.table, loop);
            (may ? mayGo : mayNot) += 1;
            if (may) BOOST_TEST(test::isOfQuads(test::contracted(now.table, loop, lump.surface.points.size())));
        }
    }
    BOOST_TEST(mayGo > 50);
    BOOST_TEST(mayNot > 50);
    int turning = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        for (const QuadLoop& loop : turningLoops(now.surface, now.table)) {
            if (!leavesQuads(now.surface, now.table, loop)) continue;
            ++turning;
            const Mesh left = test::contracted(now.table, loop, lump.surface.points.size());
            BOOST_TEST(test::isOfQuads(left));
            BOOST_TEST(left.quads.size() == now.table.count() - loop.quads.size());
        }
    }
    BOOST_TEST(turning > 50);
    // A bar of one voxel's width: rings of four quads. Without a loop along it two would be left, with two sides in
    // common.
    auto bar = openvdb::MaskGrid::create();
    for (int x = 0; x < 5; ++x) bar->tree().setValueOn(openvdb::Coord(x, 0, 0));
    const BoundingGuard guard(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}));
    const test::Working now(extractSurface(*bar), guard);
    int rings = 0;
    for (const QuadLoop& loop : straightLoops(now.table)) {
        const bool isRing = loop.quads.size() == 4;
        rings += isRing;
        BOOST_TEST(leavesQuads(now.surface, now.table, loop) == isRing);
    }
    BOOST_TEST(rings == 5);
}

BOOST_AUTO_TEST_CASE(every_loop_that_leaves_a_surface_of_quads_may_go)
{
    int mayGo = 0, mayNot = 0;
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        std::vector<QuadLoop> loops = straightLoops(now.table);
        const std::vector<QuadLoop> turning = turningLoops(now.surface, now.table);
        loops.insert(loops.end(), turning.begin(), turning.end());
        for (const QuadLoop& loop : loops) {
            if (mostMerged(loop) > 3) continue;
            const Mesh left = test::contracted(now.table, loop, lump.surface.points.size());
            const auto valences = valencesOf(left);
            const bool areFew = std::all_of(valences.begin(), valences.end(), [](std::size_t n) { return n <= 8; });
            const bool isGood = test::isOfQuads(left) && areFew && diagonalsAreAlone(left);
            if (isGood) BOOST_TEST(leavesQuads(now.surface, now.table, loop));
            ++(isGood ? mayGo : mayNot);
        }
    }
    BOOST_TEST(mayGo > 100);
    BOOST_TEST(mayNot > 100);
}

BOOST_AUTO_TEST_CASE(in_half_a_surface_loops_close_or_go_from_plane_to_plane)
{
    const BoundingGuard guard = test::guardOf(test::soup(1, 10, 0.1), true);
    for (const int resolution : {5, 8}) {
        const Mesh whole = guard.symmetrized(test::ball(resolution), 0.25 / resolution);
        const test::Working now(whole, guard);
        std::set<Rung> sides; // of quads, as they are entered or left
        std::size_t passes = 0;
        int open = 0;
        for (const QuadLoop& loop : straightLoops(now.table)) {
            open += !loop.isClosed();
            BOOST_TEST(loop.rungs.size() == loop.quads.size() + (loop.isClosed() ? 0 : 1));
            passes += loop.quads.size();
            for (std::size_t i = 0; i < loop.quads.size(); ++i) {
                // It enters across one side and leaves across the one that has no end of that.
                const Vec4I& q = now.table.corners(loop.quads[i]);
                const Rung in = loop.rungs[i], out = loop.rungs[(i + 1) % loop.rungs.size()];
                const int side = now.table.sideOf(loop.quads[i], in[0], in[1]);
                BOOST_REQUIRE(side < 4);
                BOOST_TEST((out == Rung{q[(side + 3) % 4], q[(side + 2) % 4]}));
                BOOST_TEST(sides.insert(in).second);
            }
            const auto isOnPlane = [&](const Rung& rung) {
                return now.surface.isOnPlane(rung[0]) && now.surface.isOnPlane(rung[1]);
            };
            BOOST_TEST(isOnPlane(loop.rungs.front()) == !loop.isClosed());
            BOOST_TEST(isOnPlane(loop.rungs.back()) == !loop.isClosed());
            for (std::size_t i = 1; i + 1 < loop.rungs.size(); ++i) BOOST_TEST(!isOnPlane(loop.rungs[i]));
        }
        BOOST_TEST(open > 3);
        BOOST_TEST(passes <= 2 * now.table.count()); // each quad twice, but where a loop meets itself
        BOOST_TEST(passes > now.table.count());
    }
}

BOOST_AUTO_TEST_CASE(a_turning_loop_turns_at_two_quads)
{
    int loops = 0;
    for (unsigned seed = 1; seed <= 15; ++seed) {
        const test::Lump lump(seed);
        const test::Working now(lump.surface, lump.guard);
        const auto valences = valencesOf(lump.surface);
        for (const QuadLoop& loop : turningLoops(now.surface, now.table)) {
            ++loops;
            BOOST_TEST(loop.isClosed());
            BOOST_TEST(std::set<std::uint32_t>(loop.quads.begin(), loop.quads.end()).size() == loop.quads.size());
            int turns = 0, growth = 0;
            const std::size_t n = loop.quads.size();
            for (std::size_t i = 0; i < n; ++i) {
                const auto sharing = [&](std::size_t quad, const Rung& rung) {
                    const std::uint32_t q = loop.quads[quad];
                    return now.table.sideOf(q, rung[0], rung[1]) < 4 || now.table.sideOf(q, rung[1], rung[0]) < 4;
                };
                const std::uint32_t q = loop.quads[i];
                std::vector<Rung> rungs; // that are sides of the quad
                for (const Rung& rung : loop.rungs) {
                    if (sharing(i, rung)) rungs.push_back(rung);
                }
                if (rungs.size() != 2) continue; // it lies beside itself
                std::map<std::uint32_t, int> ends;
                for (const Rung& rung : rungs) {
                    for (const std::uint32_t v : rung) ++ends[v];
                }
                if (ends.size() == 4) continue; // straight on
                ++turns;
                // Three corners become one: they lose seven edges between them, the fourth one.
                int merged = -7;
                const auto irregularity = [](int edges) { return std::abs(edges - 4); };
                for (int k = 0; k < 4; ++k) {
                    const std::uint32_t v = now.table.corners(q)[k];
                    const auto edges = static_cast<int>(valences[v]);
                    growth -= irregularity(edges);
                    if (ends.count(v) > 0) {
                        merged += edges;
                    } else {
                        growth += irregularity(edges - 1);
                    }
                }
                growth += irregularity(merged);
            }
            BOOST_TEST(turns <= 2);
            if (turns == 2) BOOST_TEST(growth <= 0);
        }
    }
    BOOST_TEST(loops > 100);
}

BOOST_AUTO_TEST_SUITE_END()
