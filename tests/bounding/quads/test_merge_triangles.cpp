// Pairs of triangles that become quads or vanish, against polygons counted on the mesh.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <vector>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/collapse_triangles.h>
#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>
#include <vdbcage/bounding/detail/quads/pairing/merge_triangles.h>
#include <vdbcage/check/check.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/manifold.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

const Mesh model = test::soup(4, 30, 0.1);

/// A rough surface with some quads.
GuardedMesh start(const BoundingGuard& guard, unsigned seed)
{
    std::mt19937 random(seed);
    const Mesh ball = test::ball(7);
    GuardedMesh surface(guard.symmetry() ? guard.symmetrized(ball, 0.03) : ball, modelOf(guard));
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (!surface.isVertex(v)) continue;
        const StarChange star = starOf(surface, v);
        const Vec3d place = rounded(surface, star, surface.point(v) + test::randomVector(random, 0.06));
        if (allows(surface, star, place)) surface.apply(star, place);
    }
    test::makeSomeQuads(surface, random, 3);
    return surface;
}

/// How many polygons of a mesh have two edges in common, and how many of its points have less than three edges.
std::size_t faultsOf(const Mesh& mesh)
{
    std::map<std::pair<unsigned, unsigned>, std::vector<std::size_t>> at;
    const auto polygons = test::polygons(mesh);
    for (std::size_t p = 0; p < polygons.size(); ++p) {
        for (std::size_t i = 0; i < polygons[p].size(); ++i)
            at[std::minmax(polygons[p][i], polygons[p][(i + 1) % polygons[p].size()])].push_back(p);
    }
    std::map<std::pair<std::size_t, std::size_t>, int> shared;
    std::map<unsigned, int> edges;
    std::size_t faults = 0;
    for (const auto& [edge, both] : at) {
        ++edges[edge.first];
        ++edges[edge.second];
        if (both.size() == 2 && ++shared[std::minmax(both[0], both[1])] == 2) ++faults;
    }
    for (const auto& entry : edges) faults += entry.second < 3;
    return faults;
}

/// Calls visit(f, g) for each two triangles that share an edge, as long as they are triangles.
template <typename Visit>
void forEachPair(const GuardedMesh& surface, const Visit& visit)
{
    const std::uint32_t count = surface.faces();
    for (std::uint32_t f = 0; f < count; ++f) {
        for (std::uint32_t g = f + 1; g < count; ++g) {
            if (!isTriangle(surface, f) || !isTriangle(surface, g)) continue;
            int shared = 0;
            for (int k = 0; k < 3; ++k) shared += test::hasCorner(surface.face(f), surface.face(g)[k]);
            if (shared == 2) visit(f, g);
        }
    }
}

/// The volume that a mesh encloses, with each quad split by its first diagonal or by the other.
double volumeOf(Mesh mesh, bool isFirst)
{
    if (!isFirst) {
        for (Vec4I& q : mesh.quads) q = {q[1], q[2], q[3], q[0]};
    }
    return test::countTopology(mesh).volume;
}

} // namespace

BOOST_AUTO_TEST_SUITE(merge_triangles)

BOOST_AUTO_TEST_CASE(two_triangles_become_a_quad_or_nothing_changes)
{
    int pushed = 0, merged = 0, refused = 0;
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const CageChecker checker(model);
        for (unsigned seed = 1; seed <= 2; ++seed) {
            const GuardedMesh before = start(guard, seed);
            BOOST_REQUIRE(faultsOf(before.mesh()) == 0);
            forEachPair(before, [&](std::uint32_t f, std::uint32_t g) {
                GuardedMesh surface = before;
                if (!mergeTriangles(surface, f, g)) {
                    ++refused;
                    BOOST_TEST(test::sameSurface(surface, before));
                    return;
                }
                ++merged;
                BOOST_TEST(surface.partnerOf(f) == g);
                BOOST_TEST(surface.quads() == before.quads() + 1);
                BOOST_TEST(surface.liveFaces() == before.liveFaces());
                const Vec4I q = before.quadOf(f, g);
                std::size_t moved = 0;
                for (std::uint32_t v = 0; v < before.vertices(); ++v) {
                    if (surface.point(v) == before.point(v)) continue;
                    BOOST_TEST((v == q[0] || v == q[1] || v == q[2] || v == q[3]));
                    ++moved;
                }
                BOOST_TEST(moved <= 2U); // the ends of one diagonal, outward
                pushed += moved > 0;
                const auto volume = [](const GuardedMesh& of) {
                    return test::countTopology(test::triangleMesh(of)).volume;
                };
                if (moved > 0 && !isSymmetric) BOOST_TEST(volume(surface) > volume(before));
                const Mesh mesh = surface.mesh();
                BOOST_TEST(faultsOf(mesh) == 0U);
                if (merged % 16 == 0) BOOST_TEST(checker.check(mesh).bounding());
                if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
            });
        }
    }
    BOOST_TEST(merged > 100);
    BOOST_TEST(refused > 20);
    BOOST_TEST(pushed > 20);
}

BOOST_AUTO_TEST_CASE(no_quad_is_made_where_two_polygons_would_share_two_edges)
{
    // As many merges as go, in any order: no polygon comes to have two edges with another.
    const BoundingGuard guard(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    for (unsigned seed = 1; seed <= 12; ++seed) {
        const Mesh coarse = decimate(test::ball(6), guard, test::to(16 + 8 * seed, Effort::fast));
        GuardedMesh surface(coarse, modelOf(guard));
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        forEachPair(surface, [&](std::uint32_t f, std::uint32_t g) { pairs.emplace_back(f, g); });
        std::mt19937 random(seed);
        std::shuffle(pairs.begin(), pairs.end(), random);
        for (const auto& [f, g] : pairs) {
            if (isTriangle(surface, f) && isTriangle(surface, g)) mergeTriangles(surface, f, g);
        }
        BOOST_TEST(surface.quads() > surface.liveFaces() / 8);
        BOOST_TEST(faultsOf(surface.mesh()) == 0U);
        BOOST_TEST(test::listsAreRight(surface));
        BOOST_TEST(test::treeIsRight(surface));
    }
}

BOOST_AUTO_TEST_CASE(two_triangles_vanish_and_all_quads_stay)
{
    int done = 0, refused = 0, besideQuads = 0;
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const CageChecker checker(model);
        for (unsigned seed = 1; seed <= 2; ++seed) {
            const GuardedMesh before = start(guard, seed);
            forEachPair(before, [&](std::uint32_t f, std::uint32_t g) {
                GuardedMesh surface = before;
                const Vec4I q = before.quadOf(f, g);
                if (!collapseTriangles(surface, f, g)) {
                    ++refused;
                    BOOST_TEST((test::triangleMesh(surface).triangles == test::triangleMesh(before).triangles));
                    BOOST_TEST((test::triangleMesh(surface).points == test::triangleMesh(before).points));
                    return;
                }
                ++done;
                BOOST_TEST(surface.liveFaces() == before.liveFaces() - 2);
                BOOST_TEST(surface.quads() == before.quads());
                BOOST_TEST((!surface.isFace(f) && !surface.isFace(g)));
                BOOST_TEST(surface.isVertex(q[0]) != surface.isVertex(q[2]));
                for (const std::uint32_t end : {q[0], q[2]}) besideQuads += !before.alternatesOf(end).empty();
                const Mesh mesh = surface.mesh();
                BOOST_TEST(test::isClosedManifold(mesh));
                BOOST_TEST(test::listsAreRight(surface));
                if (done % 16 == 0) BOOST_TEST(checker.check(mesh).bounding());
                if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
            });
        }
    }
    BOOST_TEST(done > 50);
    BOOST_TEST(refused > 20);
    BOOST_TEST(besideQuads > 20);
}

BOOST_AUTO_TEST_CASE(the_enclosed_volume_is_the_mean_of_both_diagonals)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const double cubed = std::pow(modelOf(guard).scale(), 3) / (isSymmetric ? 2 : 1);
        for (unsigned seed = 1; seed <= 4; ++seed) {
            GuardedMesh surface = start(guard, seed);
            BOOST_REQUIRE(surface.quads() > 5U);
            const Mesh mesh = surface.mesh();
            const double mean = 0.5 * (volumeOf(mesh, true) + volumeOf(mesh, false));
            BOOST_TEST(enclosedVolume(surface) == cubed * mean, boost::test_tools::tolerance(1e-9));
            if (seed == 1) BOOST_TEST(volumeOf(mesh, true) != volumeOf(mesh, false));
        }
    }
}

BOOST_AUTO_TEST_CASE(a_change_that_grows_too_much_or_fails_is_undone)
{
    const BoundingGuard guard(model);
    const GuardedMesh before = start(guard, 2);
    const double volume = enclosedVolume(before);
    std::mt19937 random(2);
    int kept = 0, undone = 0;
    for (int i = 0; i < 200; ++i) {
        const auto v = static_cast<std::uint32_t>(random() % before.vertices());
        const StarChange star = starOf(before, v);
        const Vec3d place = rounded(before, star, before.point(v) + 0.05 * (i % 3 - 1.0) * outward(before, star));
        if (place == before.point(v) || !allows(before, star, place)) continue;
        GuardedMesh expected = before;
        expected.apply(star, place);
        const double growth = enclosedVolume(expected) - volume;
        for (const double share : {0.9, 1.1}) {
            for (const bool isDone : {true, false}) {
                GuardedMesh surface = before;
                const double most = growth > 0 ? share * growth : share * growth * (share > 1 ? 0.9 / 1.1 : 1.1 / 0.9);
                const bool stays = changeWithin(surface, most, [&] {
                    surface.apply(star, place);
                    return isDone;
                });
                BOOST_TEST(stays == (isDone && !(growth > most)));
                BOOST_TEST(test::sameSurface(surface, stays ? expected : before));
                ++(stays ? kept : undone);
            }
        }
    }
    BOOST_TEST(kept > 20);
    BOOST_TEST(undone > 20);
}

BOOST_AUTO_TEST_SUITE_END()
