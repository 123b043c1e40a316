#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <vdbcage/bounding/bounding_guard.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/contact_planes.h>
#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"
#include "support/symmetric.h"

using namespace vdbcage;
using detail::Box;
using detail::Corners;
using detail::GuardedMesh;
using detail::StarChange;
using openvdb::Vec3d;

namespace {

Corners randomTriangle(std::mt19937& random, double size)
{
    return test::randomTriangle(random, size, test::randomVector(random));
}

Mesh soup(std::mt19937& random, int triangles, double size)
{
    Mesh mesh;
    for (int i = 0; i < triangles; ++i) {
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        for (const Vec3d& p : randomTriangle(random, size)) mesh.points.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

/// Two pyramids base to base: point 0 is the top, 1 the bottom, then `sides` around.
Mesh bipyramid(const Vec3d& centre, double size, int sides = 6)
{
    Mesh mesh;
    mesh.points = {centre + Vec3d(0, 0, size), centre - Vec3d(0, 0, size)};
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * detail::pi * i / sides;
        mesh.points.push_back(centre + size * Vec3d(std::cos(angle), std::sin(angle), 0));
    }
    for (int i = 0; i < sides; ++i) {
        const auto a = static_cast<openvdb::Index32>(2 + i), b = static_cast<openvdb::Index32>(2 + (i + 1) % sides);
        mesh.triangles.emplace_back(0U, a, b);
        mesh.triangles.emplace_back(1U, b, a);
    }
    return mesh;
}

BoundingGuard guardOf(const Mesh& model, double minAngle = 0, double clearance = 1e-4)
{
    GuardOptions options;
    options.clearance = clearance;
    options.minAngleDegrees = minAngle;
    return BoundingGuard(model, options);
}

/// Whether the top of `surface` (its point 0) may go to `p`.
bool topMayGo(const Mesh& surface, const BoundingGuard& guard, const Vec3d& p)
{
    const GuardedMesh guarded(surface, detail::modelOf(guard));
    return allows(guarded, starOf(guarded, 0), detail::modelOf(guard).rounded(detail::modelOf(guard).scaled(p)));
}

std::vector<std::uint32_t> neighboursOf(const GuardedMesh& surface, std::uint32_t v)
{
    const auto list = surface.neighbours(v);
    return {list.begin(), list.end()};
}

const Mesh inLowerHalf = test::box({-0.1, -0.1, -0.5}, {0.1, 0.1, -0.3});

} // namespace

BOOST_AUTO_TEST_SUITE(bounding_guard)

BOOST_AUTO_TEST_CASE(nearness_is_never_more_than_between_any_two_points_and_is_reached)
{
    std::mt19937 random(1);
    int crossing = 0;
    for (int round = 0; round < 3000; ++round) {
        Corners a = randomTriangle(random, round % 3 == 0 ? 0.3 : 1.5), b = randomTriangle(random, 0.5);
        if (round % 7 == 0) a[2] = a[1];                        // a segment
        if (round % 11 == 0) b[1] = b[2] = b[0];                // a point
        if (round % 13 == 0) b[0] = 0.5 * (a[0] + a[1]);        // a touch
        if (round % 17 == 0) b[1] = b[0] + 2.0 * (a[1] - a[0]); // parallel edges
        const detail::Nearness near = detail::nearness(a, b);
        double sampled = 1e9;
        constexpr int steps = 12;
        for (int i = 0; i <= steps; ++i) {
            for (int j = 0; i + j <= steps; ++j) {
                const Vec3d p = a[0] + (double(i) / steps) * (a[1] - a[0]) + (double(j) / steps) * (a[2] - a[0]);
                sampled = std::min(sampled, (detail::closestPointOnTriangle(p, b) - p).lengthSqr());
            }
        }
        BOOST_REQUIRE_LE(near.squaredDistance, sampled + 1e-12);
        if (near.squaredDistance == 0) {
            ++crossing;
            continue;
        }
        BOOST_REQUIRE_SMALL((near.onFirst - near.onSecond).lengthSqr() - near.squaredDistance, 1e-12);
        BOOST_REQUIRE_SMALL((detail::closestPointOnTriangle(near.onFirst, a) - near.onFirst).length(), 1e-9);
        BOOST_REQUIRE_SMALL((detail::closestPointOnTriangle(near.onSecond, b) - near.onSecond).length(), 1e-9);
        // Refined around the nearest points, sampling comes as near.
        BOOST_REQUIRE_LE(std::sqrt(near.squaredDistance), std::sqrt(sampled) + 1e-9);
    }
    BOOST_TEST(crossing > 100);
}

BOOST_AUTO_TEST_CASE(clearance_agrees_with_every_triangle_asked_one_by_one)
{
    std::mt19937 random(2);
    for (const double clearance : {1e-6, 1e-2}) {
        const Mesh model = soup(random, 300, 0.1);
        const BoundingGuard guard = guardOf(model, 0, clearance);
        int clear = 0;
        for (int round = 0; round < 2000; ++round) {
            const Corners world = randomTriangle(random, round % 2 ? 0.1 : 0.4);
            const auto scaled = [&](const Vec3d& p) { return detail::modelOf(guard).scaled(p); };
            const Corners t{scaled(world[0]), scaled(world[1]), scaled(world[2])};
            bool expected = true;
            for (const auto& m : model.triangles) {
                const Corners other{model.points[m[0]], model.points[m[1]], model.points[m[2]]};
                expected &= detail::nearness(world, other).squaredDistance >= guard.clearance() * guard.clearance();
            }
            std::uint32_t blocker = detail::TriangleBvh::none;
            BOOST_REQUIRE_EQUAL(detail::modelOf(guard).clear(t, detail::TriangleBvh::none, &blocker), expected);
            BOOST_REQUIRE_EQUAL(blocker == detail::TriangleBvh::none, expected);
            if (!expected) BOOST_REQUIRE(!detail::modelOf(guard).clear(t, blocker, nullptr));
            clear += expected;
        }
        BOOST_TEST(clear > 200);
        BOOST_TEST(clear < 1800);
    }
}

BOOST_AUTO_TEST_CASE(many_quads_are_kept_clear_of_under_both_diagonals)
{
    // Saddles: one diagonal of each is above the other, by a fifth of the clearance in one half, by two in the other.
    constexpr int side = 520;
    constexpr double clearance = 3e-5;
    const auto heightAt = [](int i) { return i < side / 2 ? 0.1 * clearance : clearance; };
    Mesh model;
    for (int j = 0; j <= side; ++j) {
        for (int i = 0; i <= side; ++i) {
            model.points.emplace_back(double(i) / side, double(j) / side, (i + j) % 2 ? heightAt(i) : -heightAt(i));
        }
    }
    const auto at = [](int i, int j) { return static_cast<openvdb::Index32>(j * (side + 1) + i); };
    for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) model.quads.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    const BoundingGuard guard = guardOf(model, 0, clearance);
    BOOST_TEST(guard.clearance() > 1.19 * clearance);
    BOOST_TEST(guard.clearance() < 1.25 * clearance);

    std::mt19937 random(1);
    std::uniform_int_distribution<int> index(1, side - 2);
    std::uniform_real_distribution<double> apart(0.7, 1.5);
    int tooNear = 0, clear = 0;
    for (int round = 0; round < 4000; ++round) {
        const int i = index(random), j = index(random);
        const double outside = heightAt(i + 1) + apart(random) * clearance;
        Vec3d p = 0.5 * (model.points[at(i, j)] + model.points[at(i + 1, j + 1)]);
        p.z() = round % 2 ? outside : -outside;
        const Corners probe{p, p + Vec3d(1e-7, 0, 0), p + Vec3d(0, 1e-7, 0)};
        double squared = 1;
        for (int k = j - 1; k <= j + 1; ++k) {
            for (int l = i - 1; l <= i + 1; ++l) {
                const std::array<openvdb::Index32, 4> q{at(l, k), at(l + 1, k), at(l + 1, k + 1), at(l, k + 1)};
                for (std::size_t c = 0; c < 4; ++c) { // each half of each split leaves a corner out
                    const Corners half{model.points[q[c]], model.points[q[(c + 1) % 4]], model.points[q[(c + 2) % 4]]};
                    squared = std::min(squared, detail::nearness(probe, half).squaredDistance);
                }
            }
        }
        const double distance = std::sqrt(squared);
        const bool isClear = detail::modelOf(guard).clear(probe, detail::TriangleBvh::none, nullptr);
        if (distance < clearance) BOOST_REQUIRE(!isClear);
        if (distance > guard.clearance()) BOOST_REQUIRE(isClear);
        tooNear += distance < clearance;
        clear += distance > guard.clearance();
    }
    BOOST_TEST(tooNear > 400);
    BOOST_TEST(clear > 400);

    model.quads.resize(1000);
    BOOST_TEST(guardOf(model, 0, clearance).clearance() == clearance, boost::test_tools::tolerance(1e-6));
}

// Up to the first impact the moving triangle meets nothing, and there it touches.
BOOST_AUTO_TEST_CASE(impacts_are_the_first_on_the_way)
{
    std::mt19937 random(21);
    constexpr double never = 2;
    constexpr int steps = 100;
    const auto firstTime = [&](const BoundingGuard& guard, const Corners& now, const Vec3d& to) {
        std::vector<detail::HalfSpace> halfSpaces;
        // The edge from b is the edge from a of the triangle beside it.
        detail::addImpacts(detail::modelOf(guard), now, to, true, 0, halfSpaces);
        detail::addImpacts(detail::modelOf(guard), {now[0], now[2], now[1]}, to, false, 0, halfSpaces);
        double time = never;
        for (const detail::HalfSpace& h : halfSpaces) {
            time = std::min(time, (h.offset - h.normal.dot(now[0])) / h.normal.dot(to - now[0]));
        }
        return time;
    };
    const auto distanceTo = [](const Mesh& model, const BoundingGuard& guard, const Corners& t) {
        double least = 1;
        for (const openvdb::Vec3I& other : model.triangles) {
            const auto corner = [&](int i) { return detail::modelOf(guard).scaled(model.points[other[i]]); };
            least = std::min(least, detail::nearness(t, {corner(0), corner(1), corner(2)}).squaredDistance);
        }
        return std::sqrt(least);
    };
    int impacts = 0, misses = 0;
    for (int round = 0; round < 300; ++round) {
        const Mesh model = round % 2 ? soup(random, 300, 0.01) : soup(random, 20, 0.5);
        const BoundingGuard guard = guardOf(model);
        Corners now = randomTriangle(random, 0.7);
        Vec3d to = test::randomVector(random);
        for (Vec3d* p : {&now[0], &now[1], &now[2], &to}) *p = detail::modelOf(guard).scaled(*p);
        const auto at = [&](double time) { return Corners{now[0] + time * (to - now[0]), now[1], now[2]}; };
        if (!(distanceTo(model, guard, now) > 1e-6)) continue;
        const double time = firstTime(guard, now, to);
        if (time < never) BOOST_TEST(distanceTo(model, guard, at(time)) < 1e-9);
        for (int i = 0; i < steps && i < time * steps - 1e-3; ++i) {
            BOOST_TEST(distanceTo(model, guard, at(1.0 * i / steps)) > 0);
        }
        ++(time < never ? impacts : misses);
    }
    BOOST_TEST(impacts > 50);
    BOOST_TEST(misses > 20);
}

// Each of the next four fails if the test of the guard that it is named after is taken out.

BOOST_AUTO_TEST_CASE(clearance_to_the_model_is_kept)
{
    const Mesh model = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});
    const Mesh surface = bipyramid({0, 0, 0}, 1);
    BOOST_TEST(topMayGo(surface, guardOf(model), {0, 0, 0.3}));
    BOOST_TEST(!topMayGo(surface, guardOf(model), {0, 0, 0.05}));
    // Clear of the model, but not by enough.
    BOOST_TEST(topMayGo(surface, guardOf(model, 0, 1e-3), {0, 0, 0.13}));
    BOOST_TEST(!topMayGo(surface, guardOf(model, 0, 0.1), {0, 0, 0.13}));
}

BOOST_AUTO_TEST_CASE(the_rest_of_the_surface_is_not_touched)
{
    const Mesh model = test::joined(inLowerHalf, test::box({-0.05, -0.05, 1.9}, {0.05, 0.05, 2.0}));
    const Mesh surface = test::joined(bipyramid({0, 0, 0}, 1), bipyramid({0, 0, 1.8}, 0.5));
    const BoundingGuard guard = guardOf(model);
    BOOST_TEST(topMayGo(surface, guard, {0, 0, 1.2}));
    BOOST_TEST(!topMayGo(surface, guard, {0, 0, 1.5}));
    BOOST_TEST(!topMayGo(surface, guard, {0, 0, 1.3})); // tip on tip
    // Nor nearly touched: the model is 2.5 long.
    BOOST_TEST(topMayGo(surface, guard, {0, 0, 1.3 - 0.0051}));
    BOOST_TEST(!topMayGo(surface, guard, {0, 0, 1.3 - 0.0049}));
    // Small triangles need less: here a twentieth of the root of 2 by a hundredth, .0007.
    const Mesh withSmall = test::joined(bipyramid({0, 0, 0}, 1), bipyramid({0, 0, 1.31}, 0.01));
    BOOST_TEST(topMayGo(withSmall, guard, {0, 0, 1.3 - 0.0008}));
    BOOST_TEST(!topMayGo(withSmall, guard, {0, 0, 1.3 - 0.0006}));
    // With a quarter of the spacing it is a quarter of each.
    GuardOptions narrow = GuardOptions{};
    narrow.minAngleDegrees = 0;
    narrow.spacing = 0.0005;
    const BoundingGuard nearer(model, narrow);
    BOOST_TEST(topMayGo(surface, nearer, {0, 0, 1.3 - 0.0013}));
    BOOST_TEST(!topMayGo(surface, nearer, {0, 0, 1.3 - 0.0012}));
    BOOST_TEST(topMayGo(withSmall, nearer, {0, 0, 1.3 - 0.0002}));
    BOOST_TEST(!topMayGo(withSmall, nearer, {0, 0, 1.3 - 0.00015}));
    for (const double spacing : {0.0, 5e-5, 0.02, std::nan("")}) {
        narrow.spacing = spacing;
        BOOST_CHECK_THROW(BoundingGuard(model, narrow), InputError);
    }
}

BOOST_AUTO_TEST_CASE(triangles_do_not_fold_onto_each_other)
{
    const BoundingGuard guard = guardOf(inLowerHalf);
    const Mesh surface = bipyramid({0, 0, 0}, 1);
    BOOST_TEST(topMayGo(surface, guard, {0.1, 0.05, 0}));
    BOOST_TEST(!topMayGo(surface, guard, {3, 0.3, 0})); // flat, and over its own ring
    // Nor nearly: 1.1 and .9 degrees above the bottom, with the model elsewhere.
    const BoundingGuard elsewhere = guardOf(test::box({4.9, 4.9, 4.9}, {5.1, 5.1, 5.1}));
    BOOST_TEST(topMayGo(surface, elsewhere, {0, 0, -0.96}));
    BOOST_TEST(!topMayGo(surface, elsewhere, {0, 0, -0.97}));
}

BOOST_AUTO_TEST_CASE(what_is_too_near_may_only_come_apart)
{
    // The tips are too near to each other from the start.
    const Mesh surface = test::joined(bipyramid({0, 0, 0}, 1), bipyramid({0, 0, 2.001}, 1));
    const BoundingGuard guard = guardOf(test::joined(inLowerHalf, test::box({-0.1, -0.1, 2}, {0.1, 0.1, 2.5})));
    BOOST_TEST(topMayGo(surface, guard, {0, 0, 0.9}));
    BOOST_TEST(!topMayGo(surface, guard, {0, 0, 0.9999}));
    BOOST_TEST(!topMayGo(surface, guard, {0, 0, 1}));
}

BOOST_AUTO_TEST_CASE(parts_of_the_model_are_not_swept_over)
{
    const Mesh surface = bipyramid({0, 0, 0}, 1);
    const Mesh speck = test::box({0.199, -0.001, 0.499}, {0.201, 0.001, 0.501});
    BOOST_TEST(topMayGo(surface, guardOf(inLowerHalf), {0, 0, 0.05}));
    BOOST_TEST(!topMayGo(surface, guardOf(test::joined(inLowerHalf, speck)), {0, 0, 0.05}));
    BOOST_TEST(topMayGo(surface, guardOf(test::joined(inLowerHalf, speck)), {0, 0, 0.8}));
}

BOOST_AUTO_TEST_CASE(triangles_keep_their_shape)
{
    const Mesh surface = bipyramid({0, 0, 0}, 1);
    const Vec3d nearRing(0.8, 0, 0.1);
    BOOST_TEST(topMayGo(surface, guardOf(inLowerHalf, 0), nearRing));
    BOOST_TEST(!topMayGo(surface, guardOf(inLowerHalf, 15), nearRing));
    // On the line between two points of the ring: no area.
    BOOST_TEST(!topMayGo(surface, guardOf(inLowerHalf, 0), 0.5 * (surface.points[2] + surface.points[3])));
}

BOOST_AUTO_TEST_CASE(changes_made_side_by_side_do_not_run_into_each_other)
{
    // Either tip may cross the middle alone, not both.
    const Mesh model = test::joined(inLowerHalf, test::box({-0.05, -0.05, 3.35}, {0.05, 0.05, 3.4}));
    const Mesh surface = test::joined(bipyramid({0, 0, 0}, 1), bipyramid({0, 0, 3}, 1));
    const BoundingGuard guard = guardOf(model);
    GuardedMesh guarded(surface, detail::modelOf(guard));
    const StarChange below = starOf(guarded, 0), above = starOf(guarded, 9);
    const Vec3d up = detail::modelOf(guard).rounded(detail::modelOf(guard).scaled({0, 0, 1.6}));
    const Vec3d down = detail::modelOf(guard).rounded(detail::modelOf(guard).scaled({0, 0, 1.4}));
    BOOST_REQUIRE(allows(guarded, below, up));
    BOOST_REQUIRE(allows(guarded, above, down));
    {
        detail::Batch batch(guarded);
        BOOST_TEST(batch.apply(below, up));
        BOOST_TEST(!batch.apply(above, down));
        // Nor are neighbours moved on what they no longer see.
        BOOST_TEST(!batch.apply(starOf(guarded, 2), guarded.point(2)));
    }
    BOOST_TEST(!allows(guarded, above, down)); // what was changed is seen when the batch has ended
    // Nor nearly: two thousandths of the model's 3.9 between them is asked.
    GuardedMesh apart(surface, detail::modelOf(guard));
    const Vec3d place = detail::modelOf(guard).rounded(detail::modelOf(guard).scaled({0, 0, 1.5}));
    const Vec3d near = detail::modelOf(guard).rounded(detail::modelOf(guard).scaled({0, 0, 1.502}));
    BOOST_REQUIRE(allows(apart, above, near));
    detail::Batch second(apart);
    BOOST_TEST(second.apply(below, place));
    BOOST_TEST(!second.apply(above, near));
}

BOOST_AUTO_TEST_CASE(contacts_do_not_depend_on_what_was_learned_before)
{
    int known = 0;
    for (unsigned seed = 0; seed < 10; ++seed) {
        std::mt19937 random(seed);
        const BoundingGuard guard = guardOf(soup(random, 200, 0.2));
        const GuardedMesh surface(bipyramid({0, 0, 0}, 4, 8), detail::modelOf(guard));
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            const Vec3d from = surface.point(v);
            detail::Obstacle obstacle;
            for (const double way : {1.0, 0.9, 0.7, 0.5, 0.3}) {
                const Vec3d inside = detail::modelOf(guard).scaled(test::randomVector(random));
                const Vec3d to = rounded(surface, star, (1 - way) * from + way * inside);
                if (allows(surface, star, to, &obstacle)) continue;
                if (obstacle.clear > 0 && obstacle.clear < star.link.size()) ++known;
                std::vector<detail::HalfSpace> learned, anew;
                contacts(surface, star, from, to, obstacle, learned);
                contacts(surface, star, from, to, {}, anew);
                BOOST_REQUIRE(learned.size() == anew.size());
                for (std::size_t i = 0; i < anew.size(); ++i) {
                    BOOST_TEST(learned[i].normal == anew[i].normal);
                    BOOST_TEST(learned[i].offset == anew[i].offset);
                }
            }
        }
    }
    BOOST_TEST(known > 20);
}

BOOST_AUTO_TEST_CASE(a_new_vertex_takes_the_place_of_faces)
{
    const BoundingGuard guard = guardOf(inLowerHalf);
    GuardedMesh guarded(bipyramid({0, 0, 0}, 1, 6), detail::modelOf(guard));
    StarChange star;
    BOOST_TEST(!starOfFaces(guarded, {0, 4}, false, star));              // they touch at the top alone
    BOOST_TEST(!starOfFaces(guarded, {0, 2, 4, 6, 8, 10}, false, star)); // the top is inside
    BOOST_REQUIRE(starOfFaces(guarded, {0, 2, 4}, false, star));
    BOOST_TEST(star.link.size() == 5U);
    const auto at = [&](double height) {
        const Mesh mesh = guarded.mesh();
        return detail::modelOf(guard).rounded(
            detail::modelOf(guard).scaled(0.45 * (mesh.points[3] + mesh.points[4]) + Vec3d(0, 0, height)));
    };
    BOOST_TEST(!allows(guarded, star, at(-0.4))); // through the bottom's faces
    BOOST_REQUIRE(allows(guarded, star, at(0.3)));
    guarded.apply(star, at(0.3));
    BOOST_TEST(guarded.liveFaces() == 14U);
    const MeshTopology topology = analyzeTopology(guarded.mesh());
    BOOST_TEST(topology.isCycle());
    BOOST_TEST(topology.boundaryEdges + topology.nonManifoldEdges + topology.nonManifoldVertices == 0U);
    BOOST_TEST(neighboursOf(guarded, 8) == (std::vector<std::uint32_t>{0, 2, 3, 4, 5}),
               boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_new_vertex_on_the_plane_of_symmetry_takes_the_place_of_faces)
{
    // Of eight sides, four are beyond the plane x = 0. Faces 0 to 7 are those, above and below in turn; 2, 4 and 8 are
    // on the plane, 3 and 9 beyond it.
    GuardOptions options;
    options.clearance = 1e-4;
    options.symmetry = SymmetryPlane{0, 0};
    const BoundingGuard guard(inLowerHalf, options);
    Mesh surface = bipyramid({0, 0, 0}, 1, 8);
    for (const std::size_t onPlane : {4U, 8U}) surface.points[onPlane][0] = 0;
    for (const auto& [image, of] : {std::pair<std::size_t, std::size_t>{5, 3}, {6, 2}, {7, 9}}) {
        surface.points[image] = test::mirrored(surface.points[of], {0, 0});
    }
    GuardedMesh guarded(surface, detail::modelOf(guard));
    BOOST_REQUIRE(guarded.liveFaces() == 8U);
    const auto corners = [&](std::uint32_t f) {
        const openvdb::Vec3I& t = guarded.face(f);
        return std::array<std::uint32_t, 3>{t[0], t[1], t[2]};
    };
    BOOST_REQUIRE((corners(0) == std::array<std::uint32_t, 3>{0, 2, 3}));
    BOOST_REQUIRE((corners(2) == std::array<std::uint32_t, 3>{0, 3, 4}));
    BOOST_REQUIRE((corners(3) == std::array<std::uint32_t, 3>{1, 4, 3}));
    StarChange star;
    BOOST_TEST(!starOfFaces(guarded, {0}, true, star));       // no side on the plane
    BOOST_TEST(!starOfFaces(guarded, {2, 3}, true, star));    // the corner on the plane between their sides is inside
    BOOST_TEST(!starOfFaces(guarded, {1, 0, 2}, true, star)); // one side on the plane, and the bottom
    BOOST_TEST(!starOfFaces(guarded, {0, 2, 4, 6}, true, star)); // two sides on the plane
    BOOST_REQUIRE(starOfFaces(guarded, {2, 0}, true, star));
    BOOST_TEST(star.onPlane);
    BOOST_TEST(star.link.size() == 3U);
    const Vec3d aside(0.05, 0.6, 0.6), place = rounded(guarded, star, detail::modelOf(guard).scaled(aside));
    BOOST_TEST(place[0] == detail::modelOf(guard).symmetry()->offset);
    BOOST_TEST(!allows(guarded, star, detail::modelOf(guard).rounded(detail::modelOf(guard).scaled(aside))));
    BOOST_REQUIRE(allows(guarded, star, place));
    guarded.apply(star, place);
    BOOST_TEST(guarded.liveFaces() == 9U);
    BOOST_TEST(guarded.isOnPlane(10));
    BOOST_TEST(neighboursOf(guarded, 10) == (std::vector<std::uint32_t>{0, 2, 3, 4}), boost::test_tools::per_element());
    const Mesh both = guarded.mesh();
    BOOST_TEST(both.points.size() == surface.points.size() + 1);
    const MeshTopology topology = analyzeTopology(both);
    BOOST_TEST(topology.isCycle());
    BOOST_TEST(topology.boundaryEdges + topology.nonManifoldEdges + topology.nonManifoldVertices == 0U);
    BOOST_CHECK(test::isSymmetric(both, *guard.symmetry()));
}

// The quad of the next tests: two faces of a pyramid with eight sides that meet at the edge from the top, point 0, to
// point 3. Its other diagonal, from point 2 to point 4, spans the plane x + y + z = 1 with the top.
Mesh boxAt(double x, double y, double z)
{
    return test::joined(inLowerHalf, test::box({x - 0.02, y - 0.02, z - 0.02}, {x + 0.02, y + 0.02, z + 0.02}));
}
bool makesQuad(const Mesh& model, double minAngle = 0, double fold = 90)
{
    const BoundingGuard guard = guardOf(model, minAngle);
    GuardedMesh guarded(bipyramid({0, 0, 0}, 1, 8), detail::modelOf(guard));
    guarded.limitQuadFold(fold);
    const bool made = makeQuad(guarded, 0, 2);
    const Mesh mesh = guarded.mesh();
    BOOST_TEST(mesh.quads.size() == (made ? 1U : 0U));
    BOOST_TEST(mesh.triangles.size() == (made ? 14U : 16U));
    BOOST_TEST(guarded.quads() == mesh.quads.size());
    return made;
}

BOOST_AUTO_TEST_CASE(a_quad_bounds_under_both_diagonals)
{
    BOOST_TEST(makesQuad(inLowerHalf));
    BOOST_TEST(makesQuad(boxAt(0.27, 0.27, 0.37)));
    BOOST_TEST(!makesQuad(boxAt(0.3, 0.3, 0.4)));    // the other diagonal's triangle cuts it
    BOOST_TEST(!makesQuad(boxAt(0.33, 0.33, 0.46))); // it lies between the two
    BOOST_TEST(!makesQuad(inLowerHalf, 30));         // the other triangles have corners of 22.5 degrees
    BOOST_TEST(!makesQuad(inLowerHalf, 0, 10));
}

BOOST_AUTO_TEST_CASE(a_quad_bounds_under_both_diagonals_while_it_moves)
{
    const BoundingGuard guard = guardOf(boxAt(0.27, 0.27, 0.37));
    GuardedMesh guarded(bipyramid({0, 0, 0}, 1, 8), detail::modelOf(guard));
    const auto mayGo = [&](std::uint32_t v, const Vec3d& p) {
        return allows(guarded, starOf(guarded, v), detail::modelOf(guard).rounded(detail::modelOf(guard).scaled(p)));
    };
    const Vec3d cuts(0.8, 0, 0), concave(1.5, -1, 0), up(0, 0, 1.1);
    for (const Vec3d& p : {cuts, concave, up}) BOOST_TEST(mayGo(2, p + (p == up ? Vec3d(1, 0, -1) : Vec3d(0.0))));
    BOOST_TEST(mayGo(0, up));
    BOOST_REQUIRE(makeQuad(guarded, 0, 2));
    BOOST_TEST(!mayGo(2, cuts));
    BOOST_TEST(!mayGo(2, concave));
    BOOST_TEST(mayGo(0, up));
    // Both kinds of corner know each other, since their moves depend on each other.
    for (const std::uint32_t v : {0U, 2U, 3U, 4U}) {
        const auto near = guarded.neighbours(v);
        for (const std::uint32_t w : {0U, 2U, 3U, 4U}) {
            BOOST_TEST((v == w || std::count(near.begin(), near.end(), w) == 1));
        }
    }
    guarded.splitQuad(2);
    BOOST_TEST(guarded.quads() == 0U);
    BOOST_TEST(mayGo(2, cuts));
    BOOST_TEST(mayGo(2, concave));
}

BOOST_AUTO_TEST_CASE(a_part_between_the_diagonals_of_a_quad_stays_inside)
{
    // The part is inside at first; then a corner passes it under one diagonal only.
    const Vec3d part(0.33, 0.33, 0.46);
    const BoundingGuard guard = guardOf(boxAt(part[0], part[1], part[2]));
    Mesh surface = bipyramid({0, 0, 0}, 1, 8);
    surface.points[2] = Vec3d(1.6, 0, 0);
    surface.points[4] = Vec3d(0, 1.6, 0);
    surface.points[3] = Vec3d(1.1, 1.1, 0);
    GuardedMesh guarded(surface, detail::modelOf(guard));
    BOOST_REQUIRE(makeQuad(guarded, 0, 2));
    const auto mayGo = [&](const Vec3d& p) {
        return allows(guarded, starOf(guarded, 2), detail::modelOf(guard).rounded(detail::modelOf(guard).scaled(p)));
    };
    BOOST_TEST(mayGo({1.5, 0, 0}));
    BOOST_TEST(!mayGo({0.72, 0, 0})); // past the part, clear of it
    guarded.splitQuad(0);
    BOOST_TEST(mayGo({0.72, 0, 0}));
}

BOOST_AUTO_TEST_CASE(bad_options_and_surfaces_are_refused)
{
    BOOST_CHECK_THROW(guardOf(inLowerHalf, 0, 0), InputError);
    BOOST_CHECK_THROW(guardOf(inLowerHalf, 0, std::nan("")), InputError);
    BOOST_CHECK_THROW(guardOf(inLowerHalf, 31), InputError);
    BOOST_CHECK_THROW(guardOf(Mesh{}), InputError);
    const BoundingGuard guard = guardOf(inLowerHalf);
    Mesh open = bipyramid({0, 0, 0}, 1);
    open.triangles.pop_back();
    BOOST_CHECK_THROW(GuardedMesh(open, detail::modelOf(guard)), InputError);
}

BOOST_AUTO_TEST_CASE(faces_of_a_whole_surface_that_are_too_near_are_found)
{
    const BoundingGuard guard = guardOf(inLowerHalf);
    BOOST_TEST(guard.facesTooNear(bipyramid({0, 0, 0}, 1)).empty());
    const std::vector<std::size_t> lower{1, 3, 5, 7, 9, 11}; // the odd ones are at the lower tip
    BOOST_TEST(guard.facesTooNear(bipyramid({0, 0, 0}, 0.5)) == lower, boost::test_tools::per_element());
    // A quad is too near if one of its diagonals is; it has a number after the triangles.
    Mesh bent = bipyramid({0, 0, 0}, 1);
    bent.points.insert(bent.points.end(), {{-1, -1, -0.2}, {1, -1, -0.2}, {1, 1, -0.2}, {-1, 1, -0.6}});
    bent.quads.emplace_back(8, 9, 10, 11);
    bent.points.insert(bent.points.end(), {{2, 2, 2}, {3, 2, 2}, {3, 3, 2}, {2, 3, 2}});
    bent.quads.emplace_back(12, 13, 14, 15);
    for (int turn = 0; turn < 4; ++turn) {
        openvdb::Vec4I& q = bent.quads[0];
        q = {q[1], q[2], q[3], q[0]};
        const std::vector<std::size_t> first{12};
        BOOST_TEST(guard.facesTooNear(bent) == first, boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_SUITE_END()
