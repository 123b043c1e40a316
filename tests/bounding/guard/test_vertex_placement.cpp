// Places of vertices, against places sampled densely where the guard allows; distances, against distances to every
// triangle of the model.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/vertex_placement.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Mat3d;

namespace {

/// Calls visit(place, weight of corner 0, area) for n x n samples of a triangle.
template <typename Visit>
void forEachSample(const Corners& t, int n, const Visit& visit)
{
    const double area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length() / (n * n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            for (const double third : {1.0 / 3, 2.0 / 3}) {
                if (third > 0.5 && i + j + 1 == n) continue;
                const double u = (i + third) / n, v = (j + third) / n;
                visit((1 - u - v) * t[0] + u * t[1] + v * t[2], 1 - u - v, area);
            }
        }
    }
}

/// The integral of the distance over a triangle.
double integralByAll(const GuardModel& guard, const Corners& t, int n)
{
    double sum = 0;
    forEachSample(t, n, [&](const Vec3d& p, double, double area) { sum += area * test::distanceByAll(guard, p); });
    return sum;
}

double valueOf(const Quadratic& change, const Vec3d& delta)
{
    return 0.5 * delta.dot(change.curvature * delta) + change.slope.dot(delta);
}

/// Towards a goal, with some directions softer than others.
Quadratic towardsGoal(std::mt19937& random, const Vec3d& way)
{
    Quadratic change;
    for (int k = 0; k < 3; ++k) {
        const Vec3d axis = test::randomVector(random);
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) change.curvature[i][j] += axis[i] * axis[j] + (i == j ? 0.1 : 0);
        }
    }
    change.slope = -(change.curvature * way);
    return change;
}

double radiusOf(const GuardedMesh& surface, const StarChange& star, const Vec3d& p)
{
    double radius = 0;
    for (const auto& edge : star.link) radius = std::max(radius, (surface.point(edge[0]) - p).length());
    return radius;
}

const auto takeAll = [](const Vec3d&) { return true; };

} // namespace

BOOST_AUTO_TEST_SUITE(vertex_placement)

BOOST_AUTO_TEST_CASE(where_nothing_is_in_the_way_the_place_is_the_best_one)
{
    const BoundingGuard guard(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    const GuardedMesh surface(test::ball(6), modelOf(guard));
    std::mt19937 random(1);
    std::uint32_t free = 0, halved = 0, shortened = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        const StarChange star = starOf(surface, v);
        const double radius = radiusOf(surface, star, surface.point(v));
        const Vec3d way = 0.2 * radius * test::randomVector(random);
        const Quadratic change = towardsGoal(random, way);
        const Vec3d goal = rounded(surface, star, surface.point(v) + way);
        if (!allows(surface, star, goal)) continue;
        ++free;
        Vec3d p = surface.point(v);
        BOOST_TEST(descend(surface, star, p, change, {radius}, takeAll));
        BOOST_TEST((p - goal).length() < 1e-6 * radius);
        Vec3d half = surface.point(v);
        if (descend(surface, star, half, change, {radius, 0.5}, takeAll)) {
            BOOST_TEST((half - surface.point(v) - 0.5 * way).length() < 1e-6 * radius);
            ++halved;
        }
        Vec3d far = surface.point(v); // half of the radius at most
        const bool isFound = descend(surface, star, far, towardsGoal(random, 100 * way), {radius}, takeAll);
        if (isFound) BOOST_TEST((far - surface.point(v)).length() < 0.5001 * radius);
        shortened += isFound;
        Vec3d near = surface.point(v); // not worth a step
        BOOST_TEST(!descend(surface, star, near, towardsGoal(random, 1e-5 * way), {radius}, takeAll));
        BOOST_TEST(near == surface.point(v));
    }
    BOOST_TEST(free > surface.vertices() / 2);
    BOOST_TEST(halved > free / 2);
    BOOST_TEST(shortened > free / 2);
}

BOOST_AUTO_TEST_CASE(the_place_is_nearly_as_good_as_the_best_of_many_allowed_ones)
{
    double gained = 0, possible = 0;
    int found = 0, blocked = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        GuardOptions options;
        options.clearance = 1e-3;
        options.minAngleDegrees = 1;
        const BoundingGuard guard(test::speckled(seed, 4), options);
        const GuardedMesh surface(test::Lump(seed).surface, modelOf(guard));
        std::mt19937 random(seed);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            const Vec3d from = surface.point(v);
            const double radius = radiusOf(surface, star, from);
            const Vec3d way = 0.45 * radius * test::randomVector(random).unit();
            const Quadratic change = towardsGoal(random, way);
            if (allows(surface, star, rounded(surface, star, from + way))) continue; // nothing is in the way
            ++blocked;
            double best = 0;
            for (int i = 0; i < 150; ++i) { // of the ball that a step may go to
                const Vec3d delta = 0.5 * radius * test::randomVector(random);
                if (delta.length() > 0.5 * radius || valueOf(change, delta) >= best) continue;
                if (allows(surface, star, rounded(surface, star, from + delta))) best = valueOf(change, delta);
            }
            Vec3d p = from;
            if (descend(surface, star, p, change, {radius}, takeAll)) {
                ++found;
                BOOST_TEST(allows(surface, star, p));
                BOOST_TEST(valueOf(change, p - from) < 0);
            } else {
                BOOST_TEST(p == from);
            }
            gained -= valueOf(change, p - from);
            possible -= best;
        }
    }
    BOOST_TEST(blocked > 100);
    BOOST_TEST(found > 0.7 * blocked);
    BOOST_TEST(gained > 0.85 * possible);
}

BOOST_AUTO_TEST_CASE(over_a_flat_model_a_vertex_slides_to_what_is_nearest_to_its_goal)
{
    // The top of a pyramid over a slab, drawn aside and into the slab: it ends above the goal, at the clearance.
    const Mesh slab = test::box({-2, -2, -0.2}, {2, 2, 0});
    GuardOptions options;
    options.clearance = 1e-3;
    options.minAngleDegrees = 0;
    const BoundingGuard guard(slab, options);
    Mesh cage = test::box({-3, -3, -1}, {3, 3, 0.5});
    cage.triangles = triangulate(cage);
    cage.quads.clear();
    cage.points.emplace_back(0, 0, 1.5);
    std::vector<Vec3I> sides;
    for (const Vec3I& t : cage.triangles) {
        const bool isTop = t[0] >= 4 && t[1] >= 4 && t[2] >= 4;
        if (!isTop) sides.push_back(t);
    }
    for (const auto& edge : {std::array<std::uint32_t, 2>{4, 5}, {5, 7}, {7, 6}, {6, 4}})
        sides.emplace_back(edge[0], edge[1], 8U);
    cage.triangles = sides;
    const GuardedMesh surface(cage, modelOf(guard));
    const StarChange star = starOf(surface, 8);
    const double clearance = modelOf(guard).clearance();
    std::mt19937 random(4);
    for (int i = 0; i < 50; ++i) {
        const Vec3d goal = modelOf(guard).scaled(Vec3d(0, 0, -0.1) + 0.1 * test::randomVector(random));
        Quadratic change;
        change.curvature = Mat3d::identity();
        change.slope = -(goal - surface.point(8));
        Vec3d p = surface.point(8);
        BOOST_TEST(descend(surface, star, p, change, {100}, takeAll));
        BOOST_TEST(std::abs(p[0] - goal[0]) < 0.01);
        BOOST_TEST(std::abs(p[1] - goal[1]) < 0.01);
        BOOST_TEST(p[2] >= clearance);
        BOOST_TEST(p[2] < std::max(goal[2], 0.0) + 3 * clearance);
    }
}

BOOST_AUTO_TEST_CASE(in_a_nook_of_three_walls_the_place_is_about_the_best_of_a_grid)
{
    // A cube whose corner is dented towards the corner of three walls.
    Mesh walls;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d high(1.0);
        high[axis] = 0;
        walls = test::joined(walls, test::box({-0.2, -0.2, -0.2}, high));
    }
    GuardOptions options;
    options.clearance = 1e-3;
    options.minAngleDegrees = 0;
    const BoundingGuard guard(walls, options);
    Mesh cage = test::box({-3, -3, -3}, {3, 3, 3});
    for (openvdb::Vec4I& q : cage.quads) { // at the corner no diagonal ends
        if (q[1] != 7 && q[3] != 7) q = {q[1], q[2], q[3], q[0]};
    }
    cage.points[7] = Vec3d(1.5);
    const GuardedMesh surface(cage, modelOf(guard));
    const StarChange star = starOf(surface, 7);
    BOOST_REQUIRE(star.link.size() == 3U);
    BOOST_REQUIRE(allows(surface, star, surface.point(7)));
    std::mt19937 random(6);
    for (int i = 0; i < 20; ++i) {
        const Vec3d goal = modelOf(guard).scaled(Vec3d(-0.1) + 0.4 * test::randomVector(random));
        const auto worth = [&](const Vec3d& p) { return (p - goal).length(); };
        double best = worth(surface.point(7));
        constexpr int steps = 16;
        for (int k = 0; k < steps * steps * steps; ++k) {
            const Vec3d p = rounded(
                surface, star,
                modelOf(guard).scaled(Vec3d(0.004) + 0.06 * Vec3d(k % steps, k / steps % steps, k / steps / steps)));
            if (worth(p) < best && allows(surface, star, p)) best = worth(p);
        }
        Vec3d p = surface.point(7);
        Quadratic change;
        change.curvature = Mat3d::identity();
        change.slope = p - goal;
        BOOST_TEST(descend(surface, star, p, change, {100}, takeAll));
        BOOST_TEST(allows(surface, star, p));
        BOOST_TEST(worth(p) <= best);
    }
}

BOOST_AUTO_TEST_CASE(places_are_offered_until_one_is_taken)
{
    const BoundingGuard guard(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    const GuardedMesh surface(test::ball(6), modelOf(guard));
    std::mt19937 random(2);
    int repeated = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); v += 7) {
        const StarChange star = starOf(surface, v);
        const Vec3d from = surface.point(v);
        const double radius = radiusOf(surface, star, from);
        const Quadratic change = towardsGoal(random, 0.2 * radius * test::randomVector(random));
        std::vector<Vec3d> offered;
        const auto take = [&](std::size_t number) {
            offered.clear();
            Vec3d p = from;
            const bool isFound = descend(surface, star, p, change, {radius}, [&](const Vec3d& target) {
                offered.push_back(target);
                return offered.size() == number;
            });
            BOOST_TEST(isFound == (offered.size() == number));
            BOOST_TEST(p == (isFound ? offered.back() : from));
        };
        take(2);
        take(1000);
        for (std::size_t i = 0; i < offered.size(); ++i) {
            BOOST_TEST(allows(surface, star, offered[i]));
            if (i > 0) BOOST_TEST((offered[i] - from).length() < (offered[i - 1] - from).length()); // nearer each time
        }
        repeated += offered.size() > 1;
        Quadratic flat = change; // which has no best place
        flat.curvature = Mat3d::zero();
        Vec3d p = from;
        BOOST_TEST(!descend(surface, star, p, flat, {radius}, takeAll));
    }
    BOOST_TEST(repeated > 10);
}

BOOST_AUTO_TEST_CASE(the_integral_of_the_distance_is_that_of_many_samples)
{
    const BoundingGuard guard(test::soup(3, 25, 0.12));
    const GuardModel& model = modelOf(guard);
    const GuardedMesh surface(test::ball(5), model);
    double sum = 0, expected = 0;
    std::uint32_t seed = TriangleBvh::none;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        const Corners t = surface.corners(f);
        const double area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
        const double fine = DistanceMeasure(surface, area / 64).integral(t, seed), all = integralByAll(model, t, 10);
        BOOST_TEST(std::abs(fine - all) < 0.04 * all);                       // distances may be 3 % too large
        const double one = DistanceMeasure(surface, area).integral(t, seed); // at the centroid
        BOOST_TEST(one >= 0.999999 * area * test::distanceByAll(model, (t[0] + t[1] + t[2]) / 3.0));
        BOOST_TEST(one <= 1.030001 * area * test::distanceByAll(model, (t[0] + t[1] + t[2]) / 3.0));
        sum += fine;
        expected += all;
    }
    BOOST_TEST(std::abs(sum - expected) < 0.02 * expected);
}

BOOST_AUTO_TEST_CASE(the_fit_is_the_sum_of_the_star_and_tells_how_it_changes)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(test::soup(3, 25, 0.12), isSymmetric);
        const Mesh ball = test::ball(9);
        const GuardedMesh surface(isSymmetric ? guard.symmetrized(ball, 0.02) : ball, modelOf(guard),
                                  GuardedMesh::Quads::keep);
        const DistanceMeasure measure(surface, 1e-4);
        std::mt19937 random(1);
        int all = 0, onPlane = 0;
        double off = 0;
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            if (!surface.isVertex(v)) continue;
            const StarChange star = starOf(surface, v);
            const Vec3d p = surface.point(v);
            std::uint32_t seed = TriangleBvh::none;
            const DistanceMeasure::Fit fit = measure.fit(surface, star, p, seed);
            double sum = 0;
            for (std::size_t i = 0; i < star.link.size(); ++i)
                sum += surface.weight(star.keptFaces[i]) * measure.integral(starCorners(surface, star, i, p), seed);
            BOOST_TEST(std::abs(fit.integral - sum) < 0.03 * sum);
            BOOST_TEST(fit.radius == radiusOf(surface, star, p), boost::test_tools::tolerance(1e-9));
            for (int i = 0; i < 3; ++i) {
                const Vec3d way = test::randomVector(random);
                BOOST_TEST(way.dot(fit.change.curvature * way) > 0);
                for (int j = 0; j < 3; ++j)
                    BOOST_TEST(std::abs(fit.change.curvature[i][j] - fit.change.curvature[j][i]) < 1e-12);
            }
            if (star.onPlane) {
                ++onPlane;
                BOOST_TEST(fit.change.slope[0] == 0);
                BOOST_TEST((fit.change.curvature[0][1] == 0 && fit.change.curvature[0][2] == 0));
            }
            // A sample comes nearer as the centre does, by the weight of that corner.
            Vec3d slope(0.0);
            double most = 0;
            for (std::size_t i = 0; i < star.link.size(); ++i) {
                const double share = surface.weight(star.keptFaces[i]);
                forEachSample(starCorners(surface, star, i, p), 6, [&](const Vec3d& at, double weight, double area) {
                    Vec3d away = at - test::closestByAll(modelOf(guard), at);
                    if (away.normalize(0)) slope += share * area * weight * away;
                    most += share * area * weight;
                });
            }
            if (star.onPlane) slope[0] = 0;
            BOOST_TEST((fit.change.slope - slope).length() < 0.15 * most);
            off += (fit.change.slope - slope).length() / most;
            ++all;
        }
        BOOST_TEST(off < 0.03 * all);
        BOOST_TEST((onPlane > 0) == isSymmetric);
    }
}

BOOST_AUTO_TEST_CASE(a_vertex_is_only_moved_to_where_the_star_is_nearer)
{
    const BoundingGuard guard(test::soup(3, 25, 0.12));
    const GuardedMesh surface(test::ball(9), modelOf(guard));
    const DistanceMeasure measure(surface, 1e-3);
    int moved = 0, all = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        const StarChange star = starOf(surface, v);
        for (const double gain : {1e-3, 0.1, 0.9}) {
            Vec3d p = surface.point(v);
            std::uint32_t seed = TriangleBvh::none;
            DistanceMeasure::Fit fit = measure.fit(surface, star, p, seed);
            const double before = fit.integral;
            DistanceMeasure::Pace pace;
            pace.gain = gain;
            const bool isMoved = measure.improve(surface, star, p, fit, seed, pace);
            BOOST_TEST((p != surface.point(v)) == isMoved);
            BOOST_TEST((fit.integral == before) == !isMoved);
            ++all;
            if (!isMoved) continue;
            ++moved;
            BOOST_TEST(allows(surface, star, p));
            BOOST_TEST(fit.integral < (1 - gain) * before);
            const double again = measure.fit(surface, star, p, seed).integral;
            BOOST_TEST(std::abs(again - fit.integral) < 0.03 * before);
        }
    }
    BOOST_TEST(moved > 0.3 * all);
    BOOST_TEST(moved < all);
}

BOOST_AUTO_TEST_CASE(distance_counts_as_the_third_power_of_the_density)
{
    const BoundingGuard guard(test::soup(3, 25, 0.12));
    FaceWishOptions options;
    options.density.regions.push_back({FactorRegion::Shape::box, {0, -1, -1}, {1, 1, 1}, 0, 2});
    const FaceWishes wishes(guard, options);
    const GuardedMesh plain(test::ball(6), modelOf(guard)),
        dense(test::ball(6), modelOf(guard), GuardedMesh::Quads::split, wishes);
    int twice = 0, once = 0, other = 0;
    for (std::uint32_t f = 0; f < plain.faces(); ++f) {
        const Corners t = plain.corners(f);
        const double area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
        std::uint32_t seed = TriangleBvh::none;
        const double with = DistanceMeasure(dense, area).integral(t, seed);
        seed = TriangleBvh::none;
        const double without = DistanceMeasure(plain, area).integral(t, seed);
        const double nearest = modelOf(guard).tree().closest((t[0] + t[1] + t[2]) / 3.0).point[0];
        // Of parts that are about as near it may be another one.
        const double ratio = with / without;
        BOOST_TEST((std::abs(ratio - 8) < 1e-9 || std::abs(ratio - 1) < 1e-9));
        if ((nearest > 0) != (ratio > 2)) {
            ++other;
        } else {
            ++(nearest > 0 ? twice : once);
        }
    }
    BOOST_TEST(twice > 20);
    BOOST_TEST(once > 20);
    BOOST_TEST(other < 0.05 * (twice + once));
}

BOOST_AUTO_TEST_SUITE_END()
