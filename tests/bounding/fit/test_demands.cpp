#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/fit/align.h>
#include <vdbcage/bounding/detail/fit/demands.h>
#include <vdbcage/bounding/detail/fit/grow.h>
#include <vdbcage/bounding/fit.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

/// The winding number of a closed surface about p.
double windingNumber(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, const Vec3d& p)
{
    double angle = 0;
    for (const Vec3I& t : triangles) {
        const Vec3d a = points[t[0]] - p, b = points[t[1]] - p, c = points[t[2]] - p;
        const double la = a.length(), lb = b.length(), lc = c.length();
        angle += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return angle / (4 * 3.14159265358979);
}

} // namespace

BOOST_AUTO_TEST_SUITE(demands)

BOOST_AUTO_TEST_CASE(samples_outside_are_those_of_winding_number_zero)
{
    // Points of the model are its samples, where each has a cell of its own.
    const Mesh model = test::soup(3, 40, 0.02);
    const GuardModel guard(model, {}, nullptr);
    DemandFinder finder(guard, nullptr);
    for (const int rings : {4, 6}) {
        Mesh cage = test::sphere({0.05, 0, 0}, 0.3, rings);
        std::mt19937 random(1);
        for (Vec3d& p : cage.points) p = guard.scaled(p + test::randomVector(random, 0.02));
        const std::vector<Vec3I> triangles = triangulate(cage);
        const std::vector<Demand> list = finder.ofSamples(cage.points, triangles);
        std::size_t outside = 0;
        for (const Vec3d& p : model.points) {
            const Vec3d sample = guard.scaled(p);
            if (std::abs(windingNumber(cage.points, triangles, sample)) > 0.5) continue;
            ++outside;
            double nearest = std::numeric_limits<double>::infinity();
            for (const Vec3I& t : triangles) {
                const Corners corners{cage.points[t[0]], cage.points[t[1]], cage.points[t[2]]};
                nearest = std::min(nearest, (closestPointOnTriangle(sample, corners) - sample).length());
            }
            // Its demand, if another point of the model does not stand for it, leads to it from the nearest point.
            const auto isOf = [&](const Demand& d) {
                const Vec3d foot = d.point(cage.points);
                return (foot + nearest * d.normal - sample).length() < 1e-9;
            };
            if (std::any_of(list.begin(), list.end(), isOf)) continue;
            const auto isNear = [&](const Demand& d) {
                return (d.point(cage.points) - sample).length() < nearest + 0.1;
            };
            BOOST_TEST(std::any_of(list.begin(), list.end(), isNear));
        }
        BOOST_TEST(outside > 10U);
        for (const Demand& d : list) {
            const Vec3d foot = d.point(cage.points);
            const double height = d.offset - d.normal.dot(foot); // with the margin
            BOOST_TEST(height > 0);
            BOOST_TEST(std::abs(d.normal.length() - 1) < 1e-9);
            BOOST_TEST(std::abs(d.weights[0] + d.weights[1] + d.weights[2] - 1) < 1e-9);
            BOOST_TEST((d.corners == triangles[d.face]));
            BOOST_TEST(std::abs(windingNumber(cage.points, triangles, foot + 0.99 * height * d.normal)) < 0.5);
        }
        // Asked again after moves, it gives what a new finder gives.
        for (Vec3d& p : cage.points) p *= 0.97;
        DemandFinder other(guard, nullptr);
        const auto again = finder.ofSamples(cage.points, triangles), anew = other.ofSamples(cage.points, triangles);
        BOOST_REQUIRE(again.size() == anew.size());
        for (std::size_t i = 0; i < again.size(); ++i) BOOST_TEST(again[i].offset == anew[i].offset);
    }
}

BOOST_AUTO_TEST_CASE(faces_that_met_their_demands_are_beyond_what_they_cut)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.5, 12), {}, nullptr);
    DemandFinder finder(guard, nullptr);
    GuardedMesh surface(test::sphere({0, 0, 0}, 0.5, 6), guard);
    BOOST_TEST(finder.ofContacts(surface).empty()); // none may cut
    for (std::uint32_t f = 0; f < surface.faces(); ++f) surface.letCut(f, true);
    const std::vector<Demand> list = finder.ofContacts(surface);
    BOOST_TEST(list.size() > surface.faces() / 2);
    for (const Demand& d : list) {
        BOOST_TEST(d.lack(surface) > 0);
        const Corners t = surface.corners(d.face);
        Corners raised;
        for (std::size_t i = 0; i < 3; ++i) raised[i] = t[i] + 1.01 * d.lack(surface) * d.normal;
        BOOST_TEST(guard.clear(raised, TriangleBvh::none, nullptr));
    }
}

BOOST_AUTO_TEST_CASE(a_cage_of_another_size_and_place_is_aligned)
{
    const Mesh ball = test::sphere({0, 0, 0}, 0.5, 10);
    const GuardModel guard(ball, {}, nullptr);
    DemandFinder finder(guard, nullptr);
    Mesh cage = test::sphere({0, 0, 0}, 0.52, 7);
    for (Vec3d& p : cage.points) p = guard.scaled(Vec3d(0.9, 0.8, 1.0) * p + Vec3d(0.04, 0, -0.03));
    const std::vector<Vec3I> triangles = triangulate(cage);
    const std::size_t before = finder.ofSamples(cage.points, triangles).size();
    align(cage.points, triangles, finder, nullptr);
    BOOST_TEST(finder.ofSamples(cage.points, triangles).size() <= finder.samples() / 50);
    BOOST_TEST(before > finder.samples() / 4);
    // A cage that fits but for the model's limb stays where it is.
    Mesh horned = ball;
    for (Vec3d& p : horned.points) p[2] = p[2] > 0.45 ? 5 * p[2] : p[2];
    const GuardModel hornedGuard(horned, {}, nullptr);
    DemandFinder hornedFinder(hornedGuard, nullptr);
    Mesh near = test::sphere({0, 0, 0}, 0.53, 10);
    for (Vec3d& p : near.points) p = hornedGuard.scaled(p);
    const std::vector<Vec3d> body = near.points;
    align(near.points, triangulate(near), hornedFinder, nullptr);
    BOOST_TEST((near.points == body));
    // Where nothing is outside, nothing moves.
    Mesh around = test::sphere({0, 0, 0}, 0.6, 7);
    for (Vec3d& p : around.points) p = guard.scaled(p);
    const std::vector<Vec3d> places = around.points;
    align(around.points, triangulate(around), finder, nullptr);
    BOOST_TEST((around.points == places));
}

BOOST_AUTO_TEST_CASE(a_surface_grows_until_it_bounds)
{
    const GuardModel guard(test::sphere({0, 0, 0}, 0.5, 10), fitGuardOptions(), nullptr);
    const Mesh cage = test::sphere({0, 0, 0}, 0.2, 5);
    DemandFinder finder(guard, nullptr);
    Mesh triangles{cage.points, triangulate(cage), {}};
    GuardedMesh surface(triangles, guard);
    const auto firstOfQuads = static_cast<std::uint32_t>(cage.triangles.size());
    BOOST_TEST(grow(surface, firstOfQuads, {25, 3}, finder, nullptr));
    BOOST_TEST(surface.quads() == cage.quads.size());
    for (const std::uint32_t f : test::facesAndAlternates(surface)) {
        BOOST_TEST(!surface.mayCut(f));
        BOOST_TEST(guard.clear(surface.corners(f), TriangleBvh::none, nullptr));
    }
    BOOST_TEST(test::listsAreRight(surface));
}

BOOST_AUTO_TEST_SUITE_END()
