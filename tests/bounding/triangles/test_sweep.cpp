// Sweeps over vertices: groups, places on a way, and what is visited.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

using Numbers = std::vector<std::uint32_t>;

/// A way for each vertex, the same whenever it is asked for.
Vec3d wayOf(std::uint32_t v, double size)
{
    std::mt19937 random(v);
    return test::randomVector(random, size);
}

} // namespace

BOOST_AUTO_TEST_SUITE(sweeps)

BOOST_AUTO_TEST_CASE(groups_part_the_vertices_and_hold_no_neighbours)
{
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        const GuardedMesh surface(lump.surface, modelOf(lump.guard),
                                  seed % 2 == 0 ? GuardedMesh::Quads::keep : GuardedMesh::Quads::split);
        std::mt19937 random(seed);
        Numbers some = allVertices(surface);
        BOOST_TEST(some.size() == lump.surface.points.size());
        std::shuffle(some.begin(), some.end(), random);
        some.resize(some.size() / 2);
        for (const Numbers& vertices : {allVertices(surface), some}) {
            const auto groups = independentGroups(surface, vertices);
            std::map<std::uint32_t, std::size_t> groupOf;
            for (std::size_t g = 0; g < groups.size(); ++g) {
                BOOST_TEST(!groups[g].empty());
                for (const std::uint32_t v : groups[g]) BOOST_TEST(groupOf.emplace(v, g).second);
            }
            BOOST_TEST(groupOf.size() == vertices.size());
            for (const std::uint32_t v : vertices) {
                BOOST_REQUIRE(groupOf.count(v) == 1U);
                std::set<std::size_t> earlier; // groups of neighbours: it is in the first that has none
                for (const std::uint32_t w : test::neighboursByFaces(surface, v)) {
                    const auto found = groupOf.find(w);
                    if (found == groupOf.end()) continue;
                    BOOST_TEST(found->second != groupOf[v]);
                    earlier.insert(found->second);
                }
                for (std::size_t g = 0; g < groupOf[v]; ++g) BOOST_TEST(earlier.count(g) == 1U);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(vertices_that_are_gone_are_not_listed)
{
    const test::Lump lump(1);
    GuardedMesh surface(lump.surface, modelOf(lump.guard));
    std::size_t removed = 0;
    for (std::uint32_t u = 0; u < surface.vertices() && removed < 5; ++u) {
        if (!surface.isVertex(u)) continue;
        const std::uint32_t v = surface.neighbours(u)[0];
        StarChange star;
        if (!starOfCollapse(surface, u, v, star) || !allows(surface, star, surface.point(u))) continue;
        surface.apply(star, surface.point(u));
        ++removed;
        const Numbers all = allVertices(surface);
        BOOST_TEST(all.size() == surface.vertices() - removed);
        BOOST_TEST(std::count(all.begin(), all.end(), v) == 0);
    }
    BOOST_TEST(removed == 5U);
}

BOOST_AUTO_TEST_CASE(the_first_step_that_is_allowed_is_taken)
{
    /// Says no to some places.
    struct Picky : ShapeTerm {
        double add(const GuardedMesh&, const StarChange&, const Vec3d&, Quadratic&) const override { return 0; }
        bool keepsFit(const GuardedMesh&, const StarChange&, const Vec3d& p) const override { return p[0] < p[1]; }
    } const picky;
    std::map<double, int> taken;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const BoundingGuard guard(test::speckled(seed, 3), test::Lump::close());
        const GuardedMesh surface(test::Lump(seed).surface, modelOf(guard));
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            const Vec3d way = wayOf(v, 1);
            for (const ShapeTerm* shape :
                 {static_cast<const ShapeTerm*>(nullptr), static_cast<const ShapeTerm*>(&picky)}) {
                std::optional<Vec3d> expected;
                double step = 0;
                for (const double share : {1.0, 0.5, 0.2}) {
                    const Vec3d place = rounded(surface, star, surface.point(v) + share * way);
                    if (expected || !allows(surface, star, place) || (shape && !(place[0] < place[1]))) continue;
                    expected = place;
                    step = share;
                }
                ++taken[step];
                const auto found = towards(surface, star, surface.point(v) + way, {1.0, 0.5, 0.2}, shape);
                BOOST_TEST(found.has_value() == expected.has_value());
                if (found && expected) BOOST_TEST((*found - *expected).length() < 1e-6);
            }
        }
    }
    for (const double step : {0.0, 0.2, 0.5, 1.0}) BOOST_TEST(taken[step] > 10);
}

BOOST_AUTO_TEST_CASE(each_vertex_is_visited_once_and_told_whether_it_moved)
{
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const test::Lump lump(seed);
        GuardedMesh surface(lump.surface, modelOf(lump.guard));
        const GuardedMesh before = surface;
        Numbers some;
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            if (v % 3 != 0) some.push_back(v);
        }
        std::map<std::uint32_t, bool> isMoved;
        sweep(
            surface, some, nullptr,
            [&](std::uint32_t v, const StarChange& star) {
                return towards(surface, star, surface.point(v) + wayOf(v, 1), {1.0, 0.3});
            },
            [&](std::uint32_t v, const StarChange& star, bool done) {
                BOOST_TEST(star.centre == v);
                BOOST_TEST(isMoved.emplace(v, done).second);
            });
        BOOST_TEST(isMoved.size() == some.size());
        std::size_t moved = 0;
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const auto found = isMoved.find(v);
            BOOST_TEST((surface.point(v) != before.point(v)) == (found != isMoved.end() && found->second));
            moved += found != isMoved.end() && found->second;
        }
        BOOST_TEST(moved > some.size() / 4);
        BOOST_TEST(test::treeIsRight(surface));
        BOOST_TEST(test::triangleMesh(surface).triangles == test::triangleMesh(before).triangles);
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter_and_every_question_can_cancel)
{
    const BoundingGuard guard(test::soup(3, 30, 0.1));
    const Mesh ball = test::ball(14);
    const auto make = [&](Interrupter* interrupter) {
        GuardedMesh surface(ball, modelOf(guard));
        sweep(
            surface, allVertices(surface), interrupter,
            [&](std::uint32_t v, const StarChange& star) {
                return towards(surface, star, surface.point(v) + wayOf(v, 0.1), {1.0, 0.5, 0.2});
            },
            [](std::uint32_t, const StarChange&, bool) {});
        return surface;
    };
    test::StopAt never(1000000);
    const GuardedMesh many = make(&never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked >= static_cast<int>(many.vertices()));
    for (int i = 0; i < asked; i += asked / 20) {
        test::StopAt stop(i);
        BOOST_CHECK_THROW(make(&stop), Cancelled);
    }
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST(test::sameSurface(many, make(nullptr)));
}

BOOST_AUTO_TEST_SUITE_END()
