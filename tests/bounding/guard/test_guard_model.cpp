// What a guard knows of the model: its units, and where it is in the way, against all of its triangles.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

Corners randomTriangle(std::mt19937& random, double size)
{
    return test::randomTriangle(random, size, test::randomVector(random, 0.5));
}

BoundingGuard guardOf(const Mesh& model, Precision precision, double clearance = 1e-3)
{
    GuardOptions options;
    options.precision = precision;
    options.clearance = clearance;
    return BoundingGuard(model, options);
}

} // namespace

BOOST_AUTO_TEST_SUITE(guard_model)

BOOST_AUTO_TEST_CASE(units_are_a_power_of_two_apart_and_rounding_is_that_of_the_file)
{
    std::mt19937 random(1);
    for (const double size : {1e-60, 1e-3, 0.7, 1.0, 3.0, 1e5, 1e60}) {
        const Mesh model = test::transformed(test::soup(1, 20, 0.1), size, Vec3d(0.0));
        for (const Precision precision : {Precision::float32, Precision::float64}) {
            if (precision == Precision::float32 && (size < 1e-30 || size > 1e30)) continue;
            const BoundingGuard guard = guardOf(model, precision);
            const GuardModel& of = modelOf(guard);
            int exponent;
            BOOST_TEST(std::frexp(of.scale(), &exponent) == 0.5);
            const Vec3d extent = of.scaled(boundingBox(model).extents());
            const double side = std::max({extent[0], extent[1], extent[2]});
            BOOST_TEST((side >= 1 && side < 2));
            BOOST_TEST(of.clearance() == 1e-3 * side, boost::test_tools::tolerance(1e-9));
            BOOST_TEST(of.roundsToFloat() == (precision == Precision::float32));
            for (int i = 0; i < 200; ++i) {
                const Vec3d world = size * test::randomVector(random), p = of.scaled(world);
                BOOST_TEST(of.unscaled(p) == world);
                const Vec3d round = of.rounded(p), back = of.unscaled(round);
                BOOST_TEST(of.rounded(round) == round);
                for (int k = 0; k < 3; ++k) {
                    if (precision == Precision::float64) BOOST_TEST(back[k] == world[k]);
                    if (precision == Precision::float32) BOOST_TEST(back[k] == double(float(world[k])));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(mirror_images_are_exact_and_keep_the_clearance_as_well)
{
    std::mt19937 random(2);
    for (const double offset : {0.0, 0.031, -0.2}) {
        const Mesh model = test::soup(2, 60, 0.1);
        GuardOptions options;
        options.clearance = 3e-2;
        options.symmetry = SymmetryPlane{1, offset};
        const BoundingGuard guard(model, options);
        const BoundingGuard whole(test::joined(model, test::mirrored(model, *guard.symmetry())), [&] {
            options.symmetry.reset();
            return options;
        }());
        const GuardModel& of = modelOf(guard);
        BOOST_TEST(std::abs(guard.symmetry()->offset - offset) < 1e-6);
        int clear = 0, blocked = 0;
        for (int i = 0; i < 2000; ++i) {
            Corners t = randomTriangle(random, 0.1);
            for (Vec3d& p : t) p = of.rounded(of.scaled(p));
            for (const Vec3d& p : t) {
                BOOST_TEST(of.mirrored(of.mirrored(p)) == p);
                BOOST_TEST(of.rounded(of.mirrored(p)) == of.mirrored(p));
                BOOST_TEST(of.mirrored(p)[1] + p[1] == 2 * of.symmetry()->offset);
            }
            // It holds what is beyond the plane, with the mirror image of what is not.
            bool isBeyond = true;
            for (const Vec3d& p : t) isBeyond = isBeyond && p[1] >= of.symmetry()->offset;
            if (!isBeyond) continue;
            Corners world = t;
            for (Vec3d& p : world) p = modelOf(whole).scaled(of.unscaled(p));
            const bool isClear = of.clear(t, TriangleBvh::none, nullptr);
            BOOST_TEST(isClear == modelOf(whole).clear(world, TriangleBvh::none, nullptr));
            ++(isClear ? clear : blocked);
        }
        BOOST_TEST(clear > 50);
        BOOST_TEST(blocked > 50);
    }
}

BOOST_AUTO_TEST_CASE(blockers_are_all_triangles_within_the_clearance)
{
    const BoundingGuard guard = guardOf(test::soup(5, 200, 0.1), Precision::float64, 0.02);
    const GuardModel& of = modelOf(guard);
    std::mt19937 random(3);
    std::size_t seen = 0;
    for (int i = 0; i < 500; ++i) {
        const Corners t = randomTriangle(random, 0.15);
        std::vector<Corners> expected, found;
        for (const TriangleBvh::Item& item : of.tree().items()) {
            const Corners other = of.tree().corners(item);
            if (std::sqrt(nearness(t, other).squaredDistance) < of.clearance()) expected.push_back(other);
        }
        of.forEachBlocker(t, [&](const Corners& other) {
            found.push_back(other);
            return true;
        });
        std::sort(expected.begin(), expected.end());
        std::sort(found.begin(), found.end());
        BOOST_CHECK(found == expected);
        seen += found.size();
        std::size_t visits = 0;
        of.forEachBlocker(t, [&](const Corners&) { return ++visits < 2; });
        BOOST_TEST(visits == std::min<std::size_t>(2, expected.size()));
    }
    BOOST_TEST(seen > 500U);
}

BOOST_AUTO_TEST_CASE(a_part_is_swept_over_exactly_if_it_is_between_the_old_and_the_new)
{
    // Balls of which one grows or shrinks: what lies between the two is swept over.
    std::mt19937 random(4);
    const Mesh model = test::soup(6, 80, 0.02);
    const BoundingGuard guard = guardOf(model, Precision::float64);
    const GuardModel& of = modelOf(guard);
    const auto trianglesOf = [&](const Mesh& mesh, bool isReversed) {
        std::vector<Corners> list;
        for (const Vec3I& t : triangulate(mesh)) {
            const Vec3d a = of.scaled(mesh.points[t[0]]), b = of.scaled(mesh.points[t[1]]),
                        c = of.scaled(mesh.points[t[2]]);
            list.push_back(isReversed ? Corners{a, c, b} : Corners{a, b, c});
        }
        return list;
    };
    int sweeps = 0, free = 0, empty = 0;
    for (int i = 0; i < 300; ++i) {
        const Vec3d centre = test::randomVector(random, 0.3);
        const double old = 0.05 + 0.1 * std::abs(test::randomVector(random)[0]),
                     now = 0.05 + 0.1 * std::abs(test::randomVector(random)[0]);
        std::vector<Corners> surface = trianglesOf(test::sphere(centre, now, 8), false);
        const std::vector<Corners> reversed = trianglesOf(test::sphere(centre, old, 8), true);
        surface.insert(surface.end(), reversed.begin(), reversed.end());
        // Spheres of straight edges: near them is not told apart.
        int between = 0, near = 0, inBox = 0;
        const double inner = std::min(old, now), outer = std::max(old, now);
        const Box box{of.scaled(centre - Vec3d(outer)), of.scaled(centre + Vec3d(outer))};
        for (const Vec3I& t : model.triangles) {
            const Vec3d p = model.points[t[0]];
            const double distance = (p - centre).length();
            for (const double radius : {inner, outer}) near += distance < radius && distance > 0.93 * radius;
            between += distance > inner && distance < 0.93 * outer;
            inBox += box.meets(Box::of(of.scaled(p)));
        }
        BOOST_TEST(of.mayHoldPart(box) == (inBox > 0));
        empty += inBox == 0;
        if (near > 0) continue;
        BOOST_TEST(of.swept(surface, box) == (between > 0));
        ++(between > 0 ? sweeps : free);
    }
    BOOST_TEST(sweeps > 30);
    BOOST_TEST(free > 30);
    BOOST_TEST(empty > 5);
}

BOOST_AUTO_TEST_CASE(a_guard_can_be_cancelled_while_it_is_built)
{
    const Mesh model = test::soup(7, 3000, 0.05);
    test::StopAt never(1000000);
    const BoundingGuard guard(model, {}, &never);
    const int asked = test::questions(never, 1000000);
    BOOST_TEST(asked > 0);
    for (int i = 0; i < asked; ++i) {
        test::StopAt stop(i);
        BOOST_CHECK_THROW(BoundingGuard(model, {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
