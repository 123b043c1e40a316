// Where faces should go: densities, by the regions and joints around a point; limbs, by rays to every triangle.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/limb.h>
#include <vdbcage/bounding/detail/guard/wishes.h>
#include <vdbcage/core/detail/pi.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

/// Where a ray meets the model first, by all triangles.
double distanceByAll(const TriangleBvh& model, const Vec3d& from, const Vec3d& direction)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const TriangleBvh::Item& item : model.items()) {
        const Corners t = model.corners(item);
        const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
        const double along = normal.dot(t[0] - from) / normal.dot(direction);
        if (!(along >= 0)) continue;
        const Vec3d at = from + along * direction;
        bool isHit = true;
        for (std::size_t i = 0; i < 3; ++i) isHit = isHit && (t[(i + 1) % 3] - t[i]).cross(at - t[i]).dot(normal) >= 0;
        if (isHit) nearest = std::min(nearest, along);
    }
    return nearest;
}

/// The median of the distances across an axis, of many directions.
double radiusByAll(const TriangleBvh& model, const Vec3d& place, const Vec3d& axis)
{
    constexpr int count = 96;
    const Vec3d aside = std::abs(axis[0]) < 0.7 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
    const Vec3d u = axis.cross(aside).unit(), v = axis.cross(u);
    std::vector<double> distances;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * pi * i / count;
        distances.push_back(distanceByAll(model, place, std::cos(angle) * u + std::sin(angle) * v));
    }
    std::sort(distances.begin(), distances.end());
    return distances[count / 2];
}

const Wishes& of(const FaceWishes& wishes)
{
    return wishesOf(wishes);
}

} // namespace

BOOST_AUTO_TEST_SUITE(wishes)

BOOST_AUTO_TEST_CASE(without_a_wish_everything_counts_alike)
{
    const BoundingGuard guard(test::soup(1, 20, 0.1));
    const FaceWishes none, empty(guard);
    for (const FaceWishes& wishes : {none, empty}) {
        BOOST_TEST(!of(wishes).hasDensity());
        BOOST_TEST(of(wishes).limbs().empty());
        BOOST_TEST(of(wishes).distanceWeight(Vec3d(1, 2, 3)) == 1);
        BOOST_TEST(of(wishes).quadricWeight(Vec3d(1, 2, 3)) == 1);
    }
}

BOOST_AUTO_TEST_CASE(densities_of_regions_are_multiplied_and_clamped)
{
    std::mt19937 random(1);
    const Mesh model = test::transformed(test::soup(1, 20, 0.1), 7, Vec3d(1, 2, 3));
    const BoundingGuard guard(model);
    for (int round = 0; round < 20; ++round) {
        FaceWishOptions options;
        for (int i = 0; i < 4; ++i) {
            FactorRegion region;
            region.shape = i % 2 == 0 ? FactorRegion::Shape::box : FactorRegion::Shape::sphere;
            region.lower = Vec3d(1, 2, 3) + test::randomVector(random, 3);
            region.upper = region.lower + Vec3d(2, 3, 4);
            region.radius = 2;
            region.factor = std::array<double, 4>{0, 0.3, 3, 8}[random() % 4];
            options.density.regions.push_back(region);
        }
        const FaceWishes wishes(guard, options);
        BOOST_TEST(of(wishes).hasDensity());
        for (int i = 0; i < 50; ++i) {
            const Vec3d world = Vec3d(1, 2, 3) + test::randomVector(random, 4);
            double density = 1;
            for (const FactorRegion& region : options.density.regions) {
                bool isInside = (world - region.lower).length() <= region.radius;
                if (region.shape == FactorRegion::Shape::box) {
                    isInside = true;
                    for (int k = 0; k < 3; ++k)
                        isInside = isInside && world[k] >= region.lower[k] && world[k] <= region.upper[k];
                }
                if (isInside) density *= region.factor;
            }
            density = std::clamp(density, 1.0 / 8, 8.0);
            const Vec3d p = modelOf(guard).scaled(world);
            BOOST_TEST(of(wishes).distanceWeight(p) == std::pow(density, 3), boost::test_tools::tolerance(1e-9));
            BOOST_TEST(of(wishes).quadricWeight(p) == std::pow(density, 5), boost::test_tools::tolerance(1e-9));
        }
    }
}

BOOST_AUTO_TEST_CASE(of_two_sides_of_the_plane_the_one_farther_from_1_counts)
{
    const BoundingGuard guard = test::guardOf(test::soup(1, 20, 0.1), true);
    const std::vector<std::pair<double, double>> sides{{2, 1}, {1, 2}, {2, 0.25}, {0.3, 2}, {0.5, 0.25}};
    for (const auto& [left, right] : sides) {
        FaceWishOptions options;
        options.density.regions.push_back({FactorRegion::Shape::box, {-9, -9, -9}, {-1e-9, 9, 9}, 0, left});
        options.density.regions.push_back({FactorRegion::Shape::box, {1e-9, -9, -9}, {9, 9, 9}, 0, right});
        const FaceWishes wishes(guard, options);
        const double expected = std::abs(std::log(left)) > std::abs(std::log(right)) ? left : right;
        for (const double x : {-0.3, 0.3})
            BOOST_TEST(of(wishes).distanceWeight({x, 0.1, 0.2}) == std::pow(expected, 3),
                       boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(a_limb_is_as_wide_as_rays_across_its_axis_are_long)
{
    std::mt19937 random(2);
    for (const Mesh& model : {test::torus(0.4, 0.1, 24, 12), test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}),
                              test::sphere({0.1, 0, 0}, 0.5, 12)}) {
        const BoundingGuard guard(model);
        const TriangleBvh& tree = modelOf(guard).tree();
        const bool isTorus = model.triangles.empty() && model.quads.size() > 6;
        for (int i = 0; i < 10; ++i) {
            const Vec3d aside = 0.05 * test::randomVector(random);
            const Vec3d place = modelOf(guard).scaled((isTorus ? Vec3d(0.4, 0, 0) : Vec3d(0.0)) + aside);
            const Vec3d axis = test::randomVector(random).unit();
            const Limb given = limbAt(tree, {place, axis});
            BOOST_TEST(given.place == place);
            BOOST_TEST(given.axis == axis);
            const double expected = radiusByAll(tree, place, axis);
            BOOST_TEST(given.radius == expected, boost::test_tools::tolerance(0.25)); // of sixteen rays
            const Limb found = limbAt(tree, {place, std::nullopt});
            BOOST_TEST(std::abs(found.axis.length() - 1) < 1e-9);
            BOOST_TEST(found.radius <= 1.1 * given.radius); // the thinnest way through
            BOOST_TEST(found.radius == radiusByAll(tree, place, found.axis), boost::test_tools::tolerance(0.25));
        }
    }
}

BOOST_AUTO_TEST_CASE(joints_are_beyond_the_plane_of_symmetry)
{
    const BoundingGuard guard = test::guardOf(test::box({-1, -0.2, -0.2}, {1, 0.2, 0.2}), true);
    FaceWishOptions options;
    options.joints = {{Vec3d(-0.5, 0.1, 0), Vec3d(2, 1, 0)}, {Vec3d(0.5, 0.1, 0), Vec3d(2, -1, 0)}};
    const FaceWishes wishes(guard, options);
    const auto& limbs = of(wishes).limbs();
    BOOST_REQUIRE(limbs.size() == 2U);
    for (const Limb& limb : limbs) {
        BOOST_TEST((modelOf(guard).unscaled(limb.place) - Vec3d(0.5, 0.1, 0)).length() < 1e-9);
        BOOST_TEST((limb.axis.cross(Vec3d(2, -1, 0)).length()) < 1e-9); // mirrored with its place
    }
    BOOST_TEST(limbs[0].radius == limbs[1].radius, boost::test_tools::tolerance(1e-9));
    // Within 1.5 times its distance from the surface, .1, faces are denser.
    const auto weightAt = [&](double off) {
        return of(wishes).distanceWeight(modelOf(guard).scaled({0.5 + off, 0.1, 0}));
    };
    BOOST_TEST(weightAt(0.149) == 8, boost::test_tools::tolerance(1e-9));
    BOOST_TEST(weightAt(0.151) == 1);
    options.jointDensity = 1;
    BOOST_TEST(!of(FaceWishes(guard, options)).hasDensity());
}

BOOST_AUTO_TEST_SUITE_END()
