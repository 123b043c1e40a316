// Half-spaces of contacts, against distances measured where they end.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/contact_planes.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

double distance(const Corners& a, const Corners& b)
{
    return std::sqrt(nearness(a, b).squaredDistance);
}

double distanceToModel(const GuardModel& guard, const Corners& t)
{
    double least = 1e9;
    for (const TriangleBvh::Item& item : guard.tree().items())
        least = std::min(least, distance(t, guard.tree().corners(item)));
    return least;
}

bool isKept(const std::vector<HalfSpace>& halfSpaces, const Vec3d& p, double slack = 0)
{
    return std::all_of(halfSpaces.begin(), halfSpaces.end(),
                       [&](const HalfSpace& h) { return h.normal.dot(p) >= h.offset - slack; });
}

} // namespace

BOOST_AUTO_TEST_SUITE(contact_planes)

BOOST_AUTO_TEST_CASE(an_approach_ends_at_the_clearance)
{
    int held = 0, lost = 0, none = 0;
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        const Corners star = test::randomTriangle(random, 1, Vec3d(0.0)),
                      other = test::randomTriangle(random, 1, test::randomVector(random, 1));
        const double apart = distance(star, other);
        if (apart > 0 && apart < 1e-3) continue;
        const double clearance = apart * (i % 2 == 0 ? 1.0001 : 0.9999);
        std::vector<HalfSpace> halfSpaces;
        addApproach(star, other, star[0], clearance, halfSpaces);
        const auto moved = [&](const Vec3d& p) { return distance({p, star[1], star[2]}, other); };
        if (halfSpaces.empty()) { // they cross, or the corner has no part in it
            ++none;
            const double step = 1e-4 * std::max(apart, 1e-3);
            for (int k = 0; k < 3 && apart > 0; ++k) {
                const Vec3d aside = step * test::randomVector(random).unit();
                BOOST_TEST(std::abs(moved(star[0] + aside) - apart) < 0.05 * step);
            }
            continue;
        }
        BOOST_REQUIRE(halfSpaces.size() == 1U);
        const HalfSpace& h = halfSpaces.front();
        BOOST_TEST(std::abs(h.normal.length() - 1) < 1e-12);
        BOOST_TEST(isKept(halfSpaces, star[0]) == (clearance < apart));
        const Vec3d border = star[0] + (h.offset - h.normal.dot(star[0])) * h.normal;
        if ((border - star[0]).length() > 1e-3) continue; // a corner that has little part in it: not to first order
        ++(std::abs(moved(border) - clearance) < 0.05 * std::abs(apart - clearance) ? held : lost);
    }
    BOOST_TEST(held > 5000);
    BOOST_TEST(lost < 10); // where other points become the nearest
    BOOST_TEST(none > 500);
}

BOOST_AUTO_TEST_CASE(an_impact_ends_the_way_about_the_clearance_before_it)
{
    constexpr double clearance = 1e-4;
    std::mt19937 random(2);
    int hits = 0, misses = 0;
    for (int i = 0; i < 4000; ++i) {
        Mesh model; // one triangle, so that there is one first contact
        for (const Vec3d& p : test::randomTriangle(random, 1, Vec3d(0.0))) model.points.push_back(p);
        model.triangles.emplace_back(0, 1, 2);
        const BoundingGuard guard(model);
        const GuardModel& of = modelOf(guard);
        const Corners obstacle{of.scaled(model.points[0]), of.scaled(model.points[1]), of.scaled(model.points[2])};
        const Corners now = test::randomTriangle(random, 1, test::randomVector(random, 1));
        const Vec3d to = test::randomVector(random, 1.5);
        if (distance(now, obstacle) < 0.05) continue;
        std::vector<HalfSpace> halfSpaces;
        // What its edge from b meets is found by the triangle beside it.
        addImpacts(of, now, to, true, clearance, halfSpaces);
        addImpacts(of, {now[0], now[2], now[1]}, to, false, clearance, halfSpaces);
        BOOST_TEST(isKept(halfSpaces, now[0], 1e-12));
        if (halfSpaces.empty()) {
            ++misses;
            constexpr int steps = 50;
            for (int k = 0; k <= steps; ++k) {
                const Corners t{now[0] + (1.0 * k / steps) * (to - now[0]), now[1], now[2]};
                BOOST_TEST(distance(t, obstacle) > 0);
            }
            continue;
        }
        ++hits;
        BOOST_TEST(!isKept(halfSpaces, to));
        double way = 1;
        for (const HalfSpace& h : halfSpaces)
            way = std::min(way, (h.offset - h.normal.dot(now[0])) / h.normal.dot(to - now[0]));
        BOOST_TEST((way >= 0 && way <= 1));
        const double left = distance({now[0] + way * (to - now[0]), now[1], now[2]}, obstacle);
        BOOST_TEST(left > 0); // not there yet
        BOOST_TEST(left < 1.05 * clearance);
    }
    BOOST_TEST(hits > 500);
    BOOST_TEST(misses > 500);
}

BOOST_AUTO_TEST_CASE(contacts_forbid_what_the_model_or_another_part_is_in_the_way_of)
{
    int forbidden = 0, ofSurface = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        GuardOptions options;
        options.clearance = 1e-3;
        options.minAngleDegrees = 0;
        const BoundingGuard guard(test::speckled(seed, 4), options);
        const GuardedMesh surface(test::Lump(seed).surface, modelOf(guard));
        std::mt19937 random(seed);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            for (int i = 0; i < 6; ++i) {
                const Vec3d from = surface.point(v),
                            to = rounded(surface, star, from + test::randomVector(random, 0.7));
                Obstacle obstacle;
                if (!allows(surface, star, from) || allows(surface, star, to, &obstacle)) continue;
                std::vector<HalfSpace> halfSpaces;
                contacts(surface, star, from, to, obstacle, halfSpaces);
                for (const HalfSpace& h : halfSpaces) BOOST_TEST(std::abs(h.normal.length() - 1) < 1e-9);
                double nearest = 1;
                for (std::size_t k = 0; k < star.link.size(); ++k)
                    nearest = std::min(nearest, distanceToModel(modelOf(guard), starCorners(surface, star, k, to)));
                const bool isModelInTheWay = nearest < modelOf(guard).clearance();
                if (isModelInTheWay && nearest > 0) BOOST_TEST(!isKept(halfSpaces, to));
                forbidden += isModelInTheWay;
                if (!isModelInTheWay) ofSurface += !isKept(halfSpaces, to);
            }
        }
    }
    BOOST_TEST(forbidden > 200);
    BOOST_TEST(ofSurface > 10);
}

BOOST_AUTO_TEST_CASE(contacts_of_a_vertex_on_the_plane_lie_in_the_plane)
{
    const BoundingGuard guard = test::guardOf(test::soup(3, 60, 0.1), true);
    const GuardedMesh surface(guard.symmetrized(test::ball(8), 0.03), modelOf(guard));
    std::mt19937 random(3);
    int inPlane = 0, across = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (!surface.isVertex(v)) continue;
        const StarChange star = starOf(surface, v);
        for (int i = 0; i < 20; ++i) {
            const Vec3d from = surface.point(v),
                        to = rounded(surface, star, 0.6 * test::randomVector(random) * i / 20 + from * (1 - i / 20.0));
            if (allows(surface, star, to)) continue;
            std::vector<HalfSpace> halfSpaces;
            contacts(surface, star, from, to, {}, halfSpaces);
            for (const HalfSpace& h : halfSpaces) {
                if (star.onPlane) BOOST_TEST(std::abs(h.normal[0]) < 1e-12);
                inPlane += star.onPlane;
                across += h.normal == Vec3d(1, 0, 0);
                if (h.normal == Vec3d(1, 0, 0)) BOOST_TEST(h.offset > 0); // off the plane
            }
            if (!star.onPlane && to[0] <= 0) BOOST_TEST(!isKept(halfSpaces, to));
        }
    }
    BOOST_TEST(inPlane > 20);
    BOOST_TEST(across > 5);
}

BOOST_AUTO_TEST_SUITE_END()
