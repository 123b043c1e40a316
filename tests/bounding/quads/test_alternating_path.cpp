// Triangles paired across quads, against all paths that there are between polygons, and the faces before and after.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/alternating_path.h>
#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>
#include <vdbcage/bounding/detail/quads/pairing/quad_candidates.h>
#include <vdbcage/bounding/detail/quads/pairing/quad_pairing.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/pi.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/manifold.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

const Mesh model = test::soup(4, 20, 0.1);

/// A ball of which most triangles are paired.
GuardedMesh start(const BoundingGuard& guard, unsigned seed)
{
    std::mt19937 random(seed);
    const Mesh ball = test::ball(4 + int(seed % 3));
    GuardedMesh surface(guard.symmetry() ? guard.symmetrized(ball, 0.03) : ball, modelOf(guard));
    for (int i = 0; i < 4; ++i) test::makeSomeQuads(surface, random, 2);
    return surface;
}

using Polygon = std::set<std::uint32_t>; // its corners

std::multiset<Polygon> polygonsOf(const GuardedMesh& surface)
{
    std::multiset<Polygon> polygons;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (!surface.isFace(f) || polygonOf(surface, f) != f) continue;
        const Vec3I& t = surface.face(f);
        Polygon polygon{t[0], t[1], t[2]};
        if (surface.isInQuad(f)) {
            const Vec4I q = surface.quadOf(f);
            polygon = {q[0], q[1], q[2], q[3]};
        }
        polygons.insert(polygon);
    }
    return polygons;
}

/// How many polygons there are on the shortest row of neighbours from a triangle to another one, with both; none is a
/// triangle but the ends. 0 if there is no other.
std::size_t nearestTriangle(const GuardedMesh& surface, std::uint32_t triangle)
{
    std::map<std::uint32_t, std::size_t> rank{{triangle, 1}};
    std::vector<std::uint32_t> queue{triangle};
    for (std::size_t at = 0; at < queue.size(); ++at) {
        const std::uint32_t polygon = queue[at];
        std::vector<std::uint32_t> faces{polygon};
        if (surface.isInQuad(polygon)) faces.push_back(surface.partnerOf(polygon));
        for (const std::uint32_t f : faces) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t next = polygonOf(surface, faceAcross(surface, f, i));
                if (!rank.emplace(next, rank[polygon] + 1).second) continue;
                if (isTriangle(surface, next)) return rank[next];
                queue.push_back(next);
            }
        }
    }
    return 0;
}

} // namespace

BOOST_AUTO_TEST_SUITE(alternating_path)

BOOST_AUTO_TEST_CASE(a_path_pairs_two_triangles_and_changes_nothing_off_it)
{
    std::map<std::size_t, int> paired; // by length
    int failed = 0;
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const CageChecker checker(model);
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const GuardedMesh before = start(guard, seed);
            for (const std::uint32_t f : trianglesOf(before)) {
                const std::size_t nearest = nearestTriangle(before, f);
                for (const std::size_t pairs : {1U, 2U, 3U, 4U}) {
                    GuardedMesh surface = before;
                    pairAlongPath(surface, f, {90, 1, pairs, PathEnd::quad});
                    if (surface.quads() == before.quads()) {
                        ++failed;
                        BOOST_TEST(test::sameSurface(surface, before));
                        continue;
                    }
                    // Of `pairs` pairs on a path all but one are quads before.
                    BOOST_TEST(nearest > 0U);
                    BOOST_TEST(nearest <= pairs + 1);
                    BOOST_TEST(surface.quads() == before.quads() + 1);
                    BOOST_TEST(trianglesOf(surface).size() + 2 == trianglesOf(before).size());
                    BOOST_TEST(surface.liveFaces() == before.liveFaces());
                    const std::multiset<Polygon> old = polygonsOf(before), now = polygonsOf(surface);
                    std::vector<Polygon> gone, made;
                    std::set_difference(old.begin(), old.end(), now.begin(), now.end(), std::back_inserter(gone));
                    std::set_difference(now.begin(), now.end(), old.begin(), old.end(), std::back_inserter(made));
                    BOOST_TEST(made.size() <= pairs);
                    BOOST_TEST(gone.size() == made.size() + 1);
                    BOOST_TEST(std::count_if(gone.begin(), gone.end(),
                                             [](const Polygon& polygon) { return polygon.size() == 3; }) == 2);
                    for (const Polygon& polygon : made) BOOST_TEST(polygon.size() == 4U);
                    const Vec3I& t = before.face(f);
                    BOOST_TEST(std::count(gone.begin(), gone.end(), Polygon({t[0], t[1], t[2]})) == 1);
                    ++paired[made.size()];
                    const Mesh mesh = surface.mesh();
                    BOOST_TEST(test::isClosedManifold(mesh));
                    BOOST_TEST(test::listsAreRight(surface));
                    if (paired[made.size()] % 8 == 1) BOOST_TEST(checker.check(mesh).bounding());
                    if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
                }
            }
        }
    }
    BOOST_TEST(failed > 10);
    for (const std::size_t length : {1U, 2U, 3U}) BOOST_TEST(paired[length] > 0);
}

BOOST_AUTO_TEST_CASE(a_path_ends_in_a_collapse_where_that_is_asked)
{
    int done = 0, failed = 0;
    const BoundingGuard guard(model);
    const CageChecker checker(model);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const GuardedMesh before = start(guard, seed);
        for (const std::uint32_t f : trianglesOf(before)) {
            for (const std::size_t pairs : {1U, 2U, 3U}) {
                GuardedMesh surface = before;
                pairAlongPath(surface, f, {90, 1, pairs, PathEnd::collapse});
                if (surface.liveFaces() == before.liveFaces()) {
                    ++failed;
                    BOOST_TEST(test::sameSurface(surface, before));
                    continue;
                }
                ++done;
                BOOST_TEST(surface.liveFaces() == before.liveFaces() - 2);
                BOOST_TEST(surface.quads() == before.quads());
                BOOST_TEST(trianglesOf(surface).size() + 2 == trianglesOf(before).size());
                const Mesh mesh = surface.mesh();
                BOOST_TEST(test::isClosedManifold(mesh));
                if (done % 8 == 0) BOOST_TEST(checker.check(mesh).bounding());
            }
        }
    }
    BOOST_TEST(done > 10);
    BOOST_TEST(failed > 10);
}

BOOST_AUTO_TEST_CASE(no_path_lets_the_surface_grow_more_than_it_may)
{
    int less = 0, more = 0;
    const BoundingGuard guard(model);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        GuardedMesh before = start(guard, seed);
        const double volume = enclosedVolume(before);
        for (const std::uint32_t f : trianglesOf(before)) {
            for (const double most : {-1e-3, 0.0, 1e-4, 1e-2}) {
                GuardedMesh surface = before;
                pairAlongPath(surface, f, {90, most, 3, PathEnd::quad});
                BOOST_TEST((test::sameSurface(surface, before) || enclosedVolume(surface) - volume <= most));
                ++(test::sameSurface(surface, before) ? less : more);
            }
        }
    }
    BOOST_TEST(less > 10);
    BOOST_TEST(more > 10);
}

// Greedy pairing leaves triangles; paths pair more, and with collapses and splits all of them.
BOOST_AUTO_TEST_CASE(every_stage_of_pairing_brings_more_quads)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1}), isSymmetric);
        const Mesh ball = test::ball(7);
        const GuardedMesh before(isSymmetric ? guard.symmetrized(ball, 0.03) : ball, modelOf(guard));
        double last = 0;
        for (int stage = 0; stage < 3; ++stage) {
            GuardedMesh surface = before;
            PairingOptions options{};
            options.mergeAngleDegrees = 90;
            options.share = 1;
            options.maxPathPairs = stage == 0 ? 0 : 6;
            options.maxLoss = 10;
            options.collapses = options.splits = stage == 2;
            pairUp(surface, options, nullptr);
            const Mesh mesh = surface.mesh();
            BOOST_TEST(quadShare(surface) == double(mesh.quads.size()) / double(faceCount(mesh)),
                       boost::test_tools::tolerance(1e-12));
            BOOST_TEST(quadShare(surface) >= last);
            BOOST_TEST(test::isClosedManifold(mesh));
            last = quadShare(surface);
        }
        BOOST_TEST(last > 0.95);
        GuardedMesh half = before;
        PairingOptions options{};
        options.mergeAngleDegrees = 90;
        options.share = 0.5;
        options.maxPathPairs = 6;
        options.maxLoss = 10;
        pairUp(half, options, nullptr);
        BOOST_TEST(quadShare(half) >= 0.5);
    }
}

// By the angle of the triangles and the corners; and each pair of neighbours is a candidate once.
BOOST_AUTO_TEST_CASE(candidates_are_all_neighbours_with_a_shape_that_may_do)
{
    std::mt19937 random(1);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const BoundingGuard guard(model);
        GuardedMesh surface = start(guard, seed);
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            if (surface.isFace(f) && surface.isInQuad(f) && random() % 4 != 0) surface.splitQuad(f);
        }
        const double merge = 20.0 * seed, perFace = 1e-3;
        std::set<std::pair<std::uint32_t, std::uint32_t>> expected, found;
        int refused = 0;
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            for (std::uint32_t g = f + 1; g < surface.faces(); ++g) {
                if (!isTriangle(surface, f) || !isTriangle(surface, g)) continue;
                int shared = 0;
                for (int k = 0; k < 3; ++k) shared += test::hasCorner(surface.face(f), surface.face(g)[k]);
                if (shared != 2) continue;
                const auto p = pointsOf(surface, surface.quadOf(f, g));
                const auto angle = [](const Vec3d& u, const Vec3d& v) {
                    return std::acos(std::clamp(u.dot(v) / (u.length() * v.length()), -1.0, 1.0)) * 180 / pi;
                };
                const double fold = angle(areaNormal(surface, f), areaNormal(surface, g));
                double deviation = 0;
                bool isConvex = true;
                Vec3d mean(0.0);
                for (std::size_t i = 0; i < 4; ++i) mean += (p[(i + 1) % 4] - p[i]).cross(p[(i + 3) % 4] - p[i]).unit();
                for (std::size_t i = 0; i < 4; ++i) {
                    const Vec3d u = p[(i + 1) % 4] - p[i], v = p[(i + 3) % 4] - p[i];
                    deviation = std::max(deviation, std::abs(angle(u, v) - 90));
                    isConvex = isConvex && angle(u, v) <= 160 && u.cross(v).dot(mean) > 0;
                }
                isConvex = isConvex && fold < 90 &&
                           angle((p[1] - p[0]).cross(p[3] - p[0]), (p[2] - p[1]).cross(p[3] - p[1])) < 90;
                const auto error = shapeError(surface, f, g, merge);
                BOOST_TEST(error.has_value() == (isConvex && fold <= 2.5 * merge));
                refused += !error;
                if (!error) continue;
                BOOST_TEST(*error == fold + deviation, boost::test_tools::tolerance(1e-5));
                expected.emplace(f, g);
            }
        }
        BOOST_TEST(refused > 0);
        double last = -1;
        for (const QuadCandidate& candidate : quadCandidates(surface, merge, perFace)) {
            BOOST_TEST(found.emplace(candidate.f, candidate.g).second);
            BOOST_TEST(candidate.score >= last);
            last = candidate.score;
            const auto p = pointsOf(surface, surface.quadOf(candidate.f, candidate.g));
            const double volume = std::abs((p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0])) / 6;
            BOOST_TEST(std::abs(candidate.loss - volume / perFace) < 1e-9 * (1 + candidate.loss));
            const auto error = shapeError(surface, candidate.f, candidate.g, merge);
            BOOST_REQUIRE(error.has_value());
            BOOST_TEST(candidate.score >= *error + 30 * candidate.loss - 1e-9);
            BOOST_TEST(candidate.score <= *error + 30 * candidate.loss + 45 + 1e-9);
        }
        BOOST_CHECK(found == expected);
    }
}

// Of a long bar bent around its middle, quads along it and across it are better than those askew.
BOOST_AUTO_TEST_CASE(quads_along_the_directions_of_curvature_come_first)
{
    // A cylinder of n x n squares, halved: one half of its pairs share a diagonal, the others a side.
    constexpr openvdb::Index32 around = 12, along = 8;
    Mesh cylinder;
    for (openvdb::Index32 j = 0; j <= along; ++j) {
        for (openvdb::Index32 i = 0; i < around; ++i) {
            const double angle = 2 * pi * i / around;
            cylinder.points.emplace_back(std::cos(angle), std::sin(angle), 0.52 * j);
        }
    }
    const auto at = [&](openvdb::Index32 i, openvdb::Index32 j) { return j * around + i % around; };
    for (openvdb::Index32 j = 0; j < along; ++j) {
        for (openvdb::Index32 i = 0; i < around; ++i)
            cylinder.quads.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    const auto bottom = static_cast<openvdb::Index32>(cylinder.points.size());
    cylinder.points.emplace_back(0, 0, -0.5);
    cylinder.points.emplace_back(0, 0, 0.52 * along + 0.5);
    for (openvdb::Index32 i = 0; i < around; ++i) {
        cylinder.triangles.emplace_back(bottom, at(i + 1, 0), at(i, 0));
        cylinder.triangles.emplace_back(bottom + 1, at(i, along), at(i + 1, along));
    }
    const BoundingGuard guard(test::box({-0.1, -0.1, 1}, {0.1, 0.1, 3}));
    const GuardedMesh surface(cylinder, modelOf(guard));
    const auto candidates = quadCandidates(surface, 90, 1);
    const std::uint32_t caps = 2 * around;
    std::size_t squares = 0, askew = 0;
    double worstSquare = 0, bestAskew = 1e9;
    for (const QuadCandidate& candidate : candidates) {
        if (candidate.f < caps || candidate.g < caps) continue;
        const bool isSquare = (candidate.f - caps) / 2 == (candidate.g - caps) / 2;
        ++(isSquare ? squares : askew);
        if (isSquare) worstSquare = std::max(worstSquare, candidate.score);
        if (!isSquare) bestAskew = std::min(bestAskew, candidate.score);
    }
    BOOST_TEST(squares == std::size_t(around * along));
    BOOST_TEST(askew > 50U);
    BOOST_TEST(worstSquare + 30 < bestAskew);
}

BOOST_AUTO_TEST_SUITE_END()
