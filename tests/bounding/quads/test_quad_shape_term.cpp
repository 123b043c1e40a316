// The shape of quads as a cost, against angles and differences computed from the corners.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/quad_relax.h>
#include <vdbcage/bounding/detail/quads/quad_shape_term.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/geometry/quad_shape.h>

#include "bounding/support/lump.h"
#include "bounding/support/quad_surface.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

using Places = std::array<Vec3d, 4>;

/// A surface of quads that are not square.
struct Rough {
    explicit Rough(unsigned seed, double by = 0.4)
        : lump(seed), surface(moved(lump.surface, seed, by), modelOf(lump.guard)), table(surface)
    {
    }
    static Mesh moved(Mesh mesh, unsigned seed, double by)
    {
        std::mt19937 random(seed);
        for (Vec3d& p : mesh.points) p += test::randomVector(random, by);
        return mesh;
    }
    Places places(std::uint32_t q) const { return pointsOf(surface, table.corners(q)); }

    test::Lump lump;
    GuardedMesh surface;
    QuadTable table;
};

double angleAt(const Vec3d& p, const Vec3d& a, const Vec3d& b)
{
    const Vec3d u = (a - p).unit(), v = (b - p).unit();
    return std::acos(std::clamp(u.dot(v), -1.0, 1.0)) * 180 / pi;
}

double smallestAngle(const Places& p)
{
    double least = 180;
    for (std::size_t i = 0; i < 4; ++i) { // each corner left out in turn
        const std::array<Vec3d, 3> t{p[(i + 1) % 4], p[(i + 2) % 4], p[(i + 3) % 4]};
        for (std::size_t k = 0; k < 3; ++k) least = std::min(least, angleAt(t[k], t[(k + 1) % 3], t[(k + 2) % 3]));
    }
    return least;
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_shape_term)

BOOST_AUTO_TEST_CASE(the_shape_s_slope_is_that_of_its_sum)
{
    const test::Lump lump(3);
    GuardedMesh surface(lump.surface, modelOf(lump.guard));
    const QuadTable table(surface);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const ShapeWeights& weights :
         {ShapeWeights{1, 0.1, 0, 0, 0}, ShapeWeights{0, 0, 1, 0, 0}, ShapeWeights{0, 0, 0, 1, 0}}) {
        const QuadShapeTerm shape(table, weights);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            const Vec3d p = surface.point(v) + 0.05 * Vec3d(unit(random), unit(random), unit(random));
            Quadratic change, ignored;
            const double sum = shape.add(surface, star, p, change);
            for (int i = 0; i < 3; ++i) {
                constexpr double step = 1e-6;
                Vec3d there = p, back = p;
                there[i] += step;
                back[i] -= step;
                const double slope =
                    (shape.add(surface, star, there, ignored) - shape.add(surface, star, back, ignored)) / (2 * step);
                // That of the fold leaves out how its scale changes.
                const double slack = weights.flat > 0 ? 0.3 * change.slope.length() + 0.1 * sum : 1e-5;
                BOOST_TEST(std::abs(slope - change.slope[i]) <= slack + 1e-6);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_move_changes_the_sum_as_it_changes_the_quads_around)
{
    std::mt19937 random(4);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Rough rough(seed);
        const QuadShapeTerm term(rough.table, {0.7, 0.1, 0.5, 0.3, 2});
        for (std::uint32_t v = 0; v < rough.surface.vertices(); ++v) {
            const StarChange star = starOf(rough.surface, v);
            const Vec3d p = rough.surface.point(v) + test::randomVector(random, 3);
            GuardedMesh changed = rough.surface;
            changed.apply(star, p);
            double growth = 0, size = 0;
            for (std::uint32_t q = 0; q < rough.table.quads(); ++q) {
                growth += term.of(changed, q) - term.of(rough.surface, q);
                size = std::max(size, term.of(changed, q));
            }
            Quadratic ignored;
            const double before = term.add(rough.surface, star, rough.surface.point(v), ignored);
            const double after = term.add(rough.surface, star, p, ignored);
            BOOST_TEST(std::abs(after - before - growth) < 1e-9 * (1 + size));
        }
    }
}

BOOST_AUTO_TEST_CASE(a_quad_costs_what_its_corners_and_its_fold_say)
{
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Rough rough(seed);
        const ShapeWeights weights{0.7, 0.1, 0.5, 0.3, 2};
        const QuadShapeTerm term(rough.table, weights);
        int unfit = 0;
        for (std::uint32_t q = 0; q < rough.table.quads(); ++q) {
            const Places p = rough.places(q);
            double sum = 0;
            for (std::size_t i = 0; i < 4; ++i) {
                const double size = std::abs(std::cos(angleAt(p[i], p[(i + 1) % 4], p[(i + 3) % 4]) * pi / 180));
                sum += weights.corners * std::pow(std::max(0.0, size - weights.free), 2);
                sum += weights.bad * std::pow(std::max(0.0, size - 0.6), 2);
            }
            const Vec3d one = p[2] - p[0], other = p[3] - p[1], normal = one.cross(other).unit();
            const double side = (one.length() + other.length()) / 2 / std::sqrt(2.0);
            sum += weights.flat * std::pow(normal.dot(p[0] - p[1]) / (0.5 * side), 2);
            const bool isUnfit = !isFit(rough.surface, p);
            unfit += isUnfit;
            if (isUnfit) sum += weights.unfit;
            BOOST_TEST(term.of(rough.surface, q) == sum, boost::test_tools::tolerance(1e-7));
        }
        BOOST_TEST(countUnfit(rough.surface, rough.table) == static_cast<std::size_t>(unfit));
        BOOST_TEST(unfit > 0);
        BOOST_TEST(unfit < int(rough.table.count()));
    }
}

BOOST_AUTO_TEST_CASE(a_quad_is_fit_if_it_is_convex_and_has_no_needle)
{
    std::mt19937 random(5);
    for (const double least : {1.0, 12.0}) {
        GuardOptions options;
        options.minAngleDegrees = least;
        const BoundingGuard guard(test::Lump(1).model, options);
        GuardedMesh surface(test::Lump(1).surface, modelOf(guard));
        for (const double fold : {90.0, 30.0}) {
            surface.limitQuadFold(fold);
            int fit = 0, unfit = 0;
            for (int i = 0; i < 4000; ++i) {
                Places p{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 1, 0), Vec3d(0, 1, 0)};
                for (Vec3d& corner : p) corner += test::randomVector(random, 0.6);
                double deviation;
                const bool isConvex = isConvexQuad(p, surface.leastQuadCosine(), deviation);
                const double needle = smallestAngle(p);
                if (std::abs(needle - std::max(5.0, least)) < 0.02) continue; // by its sine it is about 5
                BOOST_TEST(isFit(surface, p) == (isConvex && needle > std::max(5.0, least)));
                ++(isFit(surface, p) ? fit : unfit);
            }
            BOOST_TEST(fit > 200);
            BOOST_TEST(unfit > 200);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_move_keeps_quads_fit_that_are)
{
    std::mt19937 random(6);
    int kept = 0, lost = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const Rough rough(seed);
        const QuadShapeTerm term(rough.table, {});
        for (std::uint32_t v = 0; v < rough.surface.vertices(); ++v) {
            const StarChange star = starOf(rough.surface, v);
            const Vec3d p = rough.surface.point(v) + test::randomVector(random, 12);
            GuardedMesh changed = rough.surface;
            changed.apply(star, p);
            bool expected = true;
            for (std::uint32_t q = 0; q < rough.table.quads(); ++q) {
                expected = expected && (!isFit(rough.surface, rough.places(q)) ||
                                        isFit(changed, pointsOf(changed, rough.table.corners(q))));
            }
            BOOST_TEST(term.keepsFit(rough.surface, star, p) == expected);
            ++(expected ? kept : lost);
        }
    }
    BOOST_TEST(kept > 20);
    BOOST_TEST(lost > 20);
}

BOOST_AUTO_TEST_CASE(a_held_vertex_costs_its_squared_distance_from_the_plane)
{
    const Rough rough(2);
    std::vector<PlaneHold> holds;
    std::mt19937 random(7);
    for (std::uint32_t v = 0; v < rough.surface.vertices(); v += 3)
        holds.push_back({v, test::randomVector(random).unit(), double(v) / 10, 0.5 + v});
    const ShapeWeights weights{0.3, 0.1, 0, 0.2, 0, 7};
    const QuadShapeTerm with(rough.table, weights, holds), without(rough.table, weights);
    for (std::uint32_t v = 0; v < rough.surface.vertices(); ++v) {
        const StarChange star = starOf(rough.surface, v);
        const Vec3d p = rough.surface.point(v) + test::randomVector(random);
        Quadratic a, b;
        const double more = with.add(rough.surface, star, p, a) - without.add(rough.surface, star, p, b);
        const bool isHeld = v % 3 == 0;
        double expected = 0;
        Vec3d slope(0.0);
        if (isHeld) {
            const PlaneHold& hold = holds[v / 3];
            const double off = (hold.normal.dot(p) - hold.offset) / hold.width;
            expected = 7 * off * off;
            slope = 14 * off / hold.width * hold.normal;
        }
        BOOST_TEST(std::abs(more - expected) < 1e-9 * (1 + expected));
        BOOST_TEST((a.slope - b.slope - slope).length() < 1e-9 * (1 + slope.length()));
    }
}

BOOST_AUTO_TEST_CASE(on_the_plane_nothing_pulls_across_it)
{
    const BoundingGuard guard = test::guardOf(test::soup(1, 10, 0.1), true);
    Mesh whole = guard.symmetrized(test::ball(7), 0.03);
    GuardedMesh surface(whole, modelOf(guard));
    const QuadTable table(surface);
    const QuadShapeTerm term(table, {1, 0, 1, 1, 1});
    std::mt19937 random(8);
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) { // so that quads beside the plane are askew
        if (!surface.isVertex(v) || surface.isOnPlane(v)) continue;
        surface.apply(starOf(surface, v), surface.point(v) + test::randomVector(random, 0.05));
    }
    int onPlane = 0;
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        if (!surface.isVertex(v) || !surface.isOnPlane(v)) continue;
        Quadratic change;
        term.add(surface, starOf(surface, v), surface.point(v), change);
        BOOST_TEST(change.slope[0] == 0);
        for (int i = 0; i < 3; ++i) BOOST_TEST((change.curvature[0][i] == 0 && change.curvature[i][0] == 0));
        ++onPlane;
    }
    BOOST_TEST(onPlane > 5);
}

BOOST_AUTO_TEST_CASE(corner_angles_are_those_of_all_corners)
{
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Rough rough(seed);
        rough.table.remove(1);
        std::vector<double> deviations;
        for (std::uint32_t q = 0; q < rough.table.quads(); ++q) {
            if (q == 1) continue;
            const Places p = rough.places(q);
            for (std::size_t i = 0; i < 4; ++i)
                deviations.push_back(std::abs(angleAt(p[i], p[(i + 1) % 4], p[(i + 3) % 4]) - 90));
        }
        std::sort(deviations.begin(), deviations.end());
        double sum = 0;
        for (const double deviation : deviations) sum += deviation;
        const CornerAngles angles = cornerAngles(rough.surface, rough.table);
        BOOST_TEST(angles.mean == sum / double(deviations.size()), boost::test_tools::tolerance(1e-7));
        const auto above = std::count_if(deviations.begin(), deviations.end(),
                                         [&](double deviation) { return deviation > angles.mostOf95 + 1e-7; });
        BOOST_TEST(double(above) <= 0.05 * double(deviations.size()));
        BOOST_TEST(double(above) >= 0.05 * double(deviations.size()) - 2);
    }
}

BOOST_AUTO_TEST_CASE(straightened_quads_are_nearer_to_parallelograms)
{
    const Rough rough(3, 0.15);
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < rough.surface.vertices(); ++v) all.push_back(v);
    const auto skew = [&](const GuardedMesh& surface) {
        double sum = 0;
        for (std::uint32_t q = 0; q < rough.table.quads(); ++q) {
            const Places p = pointsOf(surface, rough.table.corners(q));
            sum += (p[0] - p[1] + p[2] - p[3]).lengthSqr();
        }
        return sum;
    };
    GuardedMesh surface = rough.surface;
    straighten(surface, rough.table, all, nullptr);
    BOOST_TEST(skew(surface) < 0.8 * skew(rough.surface));
    GuardedMesh relaxed = rough.surface;
    relaxQuads(relaxed, rough.table, 4, nullptr);
    BOOST_TEST(countUnfit(relaxed, rough.table) <= countUnfit(rough.surface, rough.table));
    BOOST_TEST(cornerAngles(relaxed, rough.table).mean < cornerAngles(rough.surface, rough.table).mean);
}

BOOST_AUTO_TEST_SUITE_END()
