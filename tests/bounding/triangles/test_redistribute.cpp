// Flips of edges: the stars that make them, and the operator that looks for them.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <vector>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/triangles/redistribute.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/check/check.h>

#include "bounding/support/manifold.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using detail::GuardedMesh;
using detail::StarChange;
using openvdb::Vec3d;
using openvdb::Vec3I;
using test::ball;
using test::guardOf;
using test::soup;
using test::to;

namespace {

const Mesh model = test::box({-0.3, -0.2, -0.1}, {0.3, 0.2, 0.1});

Mesh start(const BoundingGuard& guard)
{
    return guard.symmetry() ? guard.symmetrized(ball(), 0.25 / 16) : ball();
}

/// Asks visit(c, a, b) for each edge from a to b across from a vertex.
template <typename Visit>
void forEachCorner(const GuardedMesh& surface, const Visit& visit)
{
    for (std::uint32_t c = 0; c < surface.vertices(); ++c) {
        for (const auto& edge : starOf(surface, c).link) visit(c, edge[0], edge[1]);
    }
}

bool areJoined(const GuardedMesh& surface, std::uint32_t a, std::uint32_t b)
{
    const auto list = surface.neighbours(a);
    return std::find(list.begin(), list.end(), b) != list.end();
}

/// Two low pyramids base to base, with a ridge from point 0 to point 1 on top instead of a tip.
Mesh roof()
{
    Mesh mesh;
    mesh.points = {{-1, 0, 0.2}, {1, 0, 0.2}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {2, 0, 4}, {1, 2, 4}, {3, 1, 4}, {0, 3, 4}};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(redistribute)

BOOST_AUTO_TEST_CASE(edges_may_be_flipped_where_the_surface_stays_a_manifold)
{
    const BoundingGuard guard(model);
    int refused = 0, found = 0;
    for (const std::size_t faces : {8U, 14U, 40U}) {
        const Mesh cage = decimate(ball(), guard, to(faces, Effort::fast));
        const GuardedMesh surface(cage, detail::modelOf(guard));
        forEachCorner(surface, [&](std::uint32_t c, std::uint32_t a, std::uint32_t b) {
            // By hand: a cage's points keep their numbers, its faces their order.
            Mesh flipped = cage;
            for (Vec3I& t : flipped.triangles) {
                const std::vector<std::uint32_t> corners{t[0], t[1], t[2]};
                const auto has = [&](std::uint32_t v) { return std::count(corners.begin(), corners.end(), v) > 0; };
                if (!has(a) || !has(b) || has(c)) continue;
                const std::uint32_t d = t[0] + t[1] + t[2] - a - b;
                t = Vec3I(c, d, b);
                for (Vec3I& u : flipped.triangles) {
                    if (u == Vec3I(c, a, b) || u == Vec3I(a, b, c) || u == Vec3I(b, c, a)) u = Vec3I(c, a, d);
                }
                break;
            }
            StarChange star;
            BOOST_TEST(starOfFlip(surface, c, a, b, star) == test::isClosedManifold(flipped));
            ++(test::isClosedManifold(flipped) ? found : refused);
        });
        StarChange star;
        BOOST_TEST(!starOfFlip(surface, surface.face(0)[0], surface.face(0)[2], surface.face(0)[1], star));
    }
    BOOST_TEST(refused > 0);
    BOOST_TEST(found > 0);
}

BOOST_AUTO_TEST_CASE(no_edge_is_flipped_into_the_plane_of_symmetry)
{
    // An octahedron: across from each edge at point 0 are two others on the plane.
    Mesh surface;
    surface.points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}, {-1, 0, 0}};
    for (openvdb::Index32 i = 1; i <= 4; ++i) {
        const openvdb::Index32 next = i % 4 + 1;
        surface.triangles.emplace_back(0U, i, next);
        surface.triangles.emplace_back(5U, next, i);
    }
    const BoundingGuard guard = guardOf(model, true), without = guardOf(model, false);
    const GuardedMesh half(surface, detail::modelOf(guard)), whole(surface, detail::modelOf(without));
    BOOST_REQUIRE(half.liveFaces() == 4U);
    StarChange star;
    forEachCorner(
        half, [&](std::uint32_t c, std::uint32_t a, std::uint32_t b) { BOOST_TEST(!starOfFlip(half, c, a, b, star)); });
    BOOST_TEST(starOfFlip(whole, 1, 2, 0, star));
}

BOOST_AUTO_TEST_CASE(flips_that_the_guard_allows_bound_the_model)
{
    const CageChecker checker(model);
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = guardOf(model, isSymmetric);
        const Mesh cage = decimate(start(guard), guard, to(60, Effort::fast));
        const GuardedMesh surface(cage, detail::modelOf(guard));
        int made = 0, inner = 0;
        forEachCorner(surface, [&](std::uint32_t c, std::uint32_t a, std::uint32_t b) {
            StarChange star;
            if (!starOfFlip(surface, c, a, b, star)) return;
            inner += !star.onPlane;
            for (const double off : {0.0, 0.01, 0.1}) {
                const Vec3d place = rounded(surface, star, surface.point(c) + off * outward(surface, star));
                if (!allows(surface, star, place)) continue;
                GuardedMesh changed = surface;
                changed.apply(star, place);
                ++made;
                BOOST_TEST(changed.liveFaces() == surface.liveFaces());
                BOOST_TEST(!areJoined(changed, a, b));
                BOOST_TEST(changed.neighbours(c).size() == surface.neighbours(c).size() + 1);
                const Mesh mesh = changed.mesh();
                BOOST_TEST(test::isClosedManifold(mesh));
                BOOST_TEST(checker.check(mesh).bounding());
                if (guard.symmetry()) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
                // The faces are where it looks for them: it answers as a surface made anew does.
                const GuardedMesh anew(mesh, detail::modelOf(guard));
                for (const std::uint32_t v : anew.neighbours(c)) {
                    for (const double push : {-0.1, 0.1}) {
                        const StarChange fresh = starOf(anew, v), again = starOf(changed, v);
                        const Vec3d to = rounded(anew, fresh, anew.point(v) + push * outward(anew, fresh));
                        BOOST_TEST(allows(anew, fresh, to) == allows(changed, again, to));
                    }
                }
                break;
            }
        });
        BOOST_TEST(made > 20);
        BOOST_TEST(inner > 0);
    }
}

BOOST_AUTO_TEST_CASE(a_ridge_becomes_a_valley_where_that_is_nearer)
{
    const Mesh low = test::sphere({0, 0, -0.4}, 0.15, 12), high = test::box({-0.4, -0.02, -0.1}, {0.4, 0.02, 0.1});
    for (const bool isLow : {true, false}) {
        const Mesh& inside = isLow ? low : high;
        const BoundingGuard guard(inside);
        GuardedMesh surface(roof(), detail::modelOf(guard));
        const double perSample = detail::areaPerSample(surface, surface.liveFaces(), 12);
        const double before = detail::integratedDistance(surface, perSample);
        detail::flipEdges(surface, 0, nullptr);
        BOOST_TEST(surface.liveFaces() == 6U);
        BOOST_TEST(areJoined(surface, 0, 1) == !isLow); // the box is in the way
        BOOST_TEST(areJoined(surface, 2, 3) == isLow);
        BOOST_TEST(checkCage(surface.mesh(), inside).bounding());
        if (isLow) BOOST_TEST(detail::integratedDistance(surface, perSample) < before);
    }
}

BOOST_AUTO_TEST_CASE(of_two_flips_that_would_cross_one_is_made)
{
    // A slab with corners by turns high and low, ridges between the high ones on top and the low ones below: a valley
    // in either would be nearer to what is in the corners, both would cross.
    Mesh slab;
    for (int i = 0; i < 4; ++i) {
        const double x = i == 0 || i == 3 ? 1 : -1, y = i < 2 ? 1 : -1, low = i % 2 == 0 ? -0.3 : 0.05;
        slab.points.emplace_back(x, y, low);
        slab.points.emplace_back(x, y, low + 0.25); // the points on top have odd numbers
    }
    for (openvdb::Index32 i = 0; i < 4; ++i) {
        const openvdb::Index32 low = 2 * i, next = 2 * ((i + 1) % 4);
        slab.triangles.emplace_back(low, next + 1, low + 1);
        slab.triangles.emplace_back(low, next, next + 1);
    }
    for (const Vec3I& t : {Vec3I(3, 5, 7), Vec3I(3, 7, 1), Vec3I(0, 4, 2), Vec3I(0, 6, 4)}) slab.triangles.push_back(t);
    Mesh inside; // holds the corners where they are
    for (std::size_t i = 0; i < 8; i += 2) {
        const Vec3d& p = slab.points[i];
        inside = test::joined(inside, test::sphere({0.92 * p[0], 0.92 * p[1], p[2] + 0.125}, 0.06, 6));
    }
    const BoundingGuard guard(inside);
    GuardedMesh surface(slab, detail::modelOf(guard));
    BOOST_REQUIRE(checkCage(slab, inside).bounding());
    detail::flipEdges(surface, 0, nullptr);
    BOOST_TEST(checkCage(surface.mesh(), inside).bounding());
    BOOST_TEST(areJoined(surface, 1, 5) != areJoined(surface, 2, 6));
}

BOOST_AUTO_TEST_CASE(asks_at_each_edge_and_each_vertex)
{
    const BoundingGuard guard(model);
    const GuardedMesh surface(ball(), detail::modelOf(guard));
    std::size_t corners = 0;
    forEachCorner(surface, [&](std::uint32_t, std::uint32_t, std::uint32_t) { ++corners; });
    const double perSample = detail::areaPerSample(surface, surface.liveFaces(), 4);
    const auto asked = [&](const auto& run) {
        GuardedMesh changed = surface;
        test::StopAt never(1000000);
        run(changed, &never);
        return static_cast<std::size_t>(test::questions(never, 1000000));
    };
    const auto vertices = static_cast<std::size_t>(surface.vertices());
    BOOST_TEST(asked([&](GuardedMesh& at, Interrupter* i) { detail::flipEdges(at, 0, i); }) >= corners);
    BOOST_TEST(asked([&](GuardedMesh& at, Interrupter* i) { detail::redistribute(at, 1, 0, i); }) >=
               corners / 2 + 2 * vertices);
    BOOST_TEST(asked([&](GuardedMesh& at, Interrupter* i) { detail::tighten(at, 1, perSample, i); }) >= vertices);
}

BOOST_AUTO_TEST_CASE(flips_bring_surfaces_nearer_to_the_model)
{
    int nearer = 0, all = 0;
    for (const Mesh& inside : {model, soup(1, 30, 0.1), soup(2, 30, 0.1)}) {
        for (const bool isSymmetric : {false, true}) {
            const BoundingGuard guard = guardOf(inside, isSymmetric);
            const CageChecker checker(inside);
            for (const std::size_t faces : {20U, 40U, 60U, 100U}) {
                GuardedMesh surface(decimate(start(guard), guard, to(faces, Effort::fast)), detail::modelOf(guard));
                const double perSample = detail::areaPerSample(surface, surface.liveFaces(), 4);
                double last = detail::integratedDistance(surface, perSample);
                for (const int sweeps : {0, 0, 6}) {
                    detail::flipEdges(surface, sweeps, nullptr);
                    const double now = detail::integratedDistance(surface, perSample);
                    BOOST_TEST(now <= last);
                    nearer += now < last;
                    ++all;
                    last = now;
                }
                BOOST_TEST(checker.check(surface.mesh()).bounding());
            }
        }
    }
    BOOST_TEST(nearer > all / 2);
    const BoundingGuard guard(model);
    GuardedMesh nothing(Mesh{}, detail::modelOf(guard));
    detail::flipEdges(nothing, 6, nullptr);
    BOOST_TEST(nothing.liveFaces() == 0U);
}

BOOST_AUTO_TEST_SUITE_END()
