#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <volume/masks.h>

#include <cmath>
#include <limits>

#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/sphere/radius_field.h>
#include <vdbcage/volume/detail/sphere/sphere_pass.h>
#include <vdbcage/volume/factor_field.h>

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::FloatGrid;
using openvdb::Vec3d;
namespace data = boost::unit_test::data;

namespace vdbcage::detail {

/// For Boost.Test.
static std::ostream& operator<<(std::ostream& out, Simd simd)
{
    return out << (simd == Simd::plain ? "plain" : simd == Simd::avx2 ? "avx2" : "avx512");
}

} // namespace vdbcage::detail

namespace {

FactorRegion sphereRegion(const Vec3d& centre, double radius, double scale)
{
    FactorRegion region;
    region.shape = FactorRegion::Shape::sphere;
    region.lower = centre;
    region.radius = radius;
    region.factor = scale;
    return region;
}

FactorRegion boxRegion(const Vec3d& lower, const Vec3d& upper, double scale)
{
    FactorRegion region;
    region.shape = FactorRegion::Shape::box;
    region.lower = lower;
    region.upper = upper;
    region.factor = scale;
    return region;
}

// A field with all that there is: a grid whose voxels are not those of the masks, a sphere, a box.
FactorField mixedField(const Vec3d& middle, unsigned seed)
{
    std::mt19937 random(seed);
    auto grid = FloatGrid::create(1.0F);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(2.75));
    grid->transform().postTranslate(middle);
    for (int i = 0; i < 40; ++i) {
        const auto coordinate = [&] { return static_cast<int>(random() % 7U) - 3; };
        grid->tree().setValue(Coord(coordinate(), coordinate(), coordinate()),
                              static_cast<float>(random() % 1000U) * 0.0015F);
    }
    return {grid,
            {sphereRegion(middle + Vec3d(4, 3, 0), 4.5, 0.25),
             boxRegion(middle + Vec3d(-20, -9, -3), middle + Vec3d(-2, -1, 30), 0)}};
}

CoordBBox grownBox(const DenseSet& set, double radius)
{
    return grown(set.box(), 2 * static_cast<int>(std::ceil(radius)) + 2);
}

int squaredLength(const Coord& d)
{
    return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
}

// By the definition: a voxel is in if one of the set is within the voxel's own radius.
DenseSet gathered(const DenseSet& set, const detail::RadiusField& field)
{
    std::vector<Coord> voxels;
    for (auto c = set.box().begin(); c; ++c) {
        if (set[*c]) voxels.push_back(*c);
    }
    DenseSet result(grownBox(set, field.largest()));
    for (auto c = result.box().begin(); c; ++c) {
        const int square = field.square(*c, 1);
        result.set(*c, std::any_of(voxels.begin(), voxels.end(),
                                   [&](const Coord& q) { return squaredLength(q - *c) <= square; }));
    }
    return result;
}

// By the definition: every voxel outside takes away what is within its radius. The box must leave room for it.
DenseSet scattered(const DenseSet& set, const detail::RadiusField& field, double factor)
{
    DenseSet result = set;
    for (auto c = set.box().begin(); c; ++c) {
        if (set[*c]) continue;
        const int square = field.square(*c, factor), reach = static_cast<int>(std::sqrt(square));
        CoordBBox around = grown(CoordBBox(*c, *c), reach);
        around.intersect(set.box());
        for (auto g = around.begin(); g; ++g) {
            if (squaredLength(*g - *c) <= square) result.set(*g, false);
        }
    }
    return result;
}

MaskGrid::Ptr gridOf(openvdb::MaskTree::Ptr tree)
{
    return MaskGrid::create(std::move(tree));
}

} // namespace

BOOST_AUTO_TEST_SUITE(scale_field)

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(closing_equals_the_definition,
                     data::make(detail::supportedSimd()) * data::make({1.5, 2.9, 4.0, 8.2}), simd, radius)
{
    const std::vector<Coord> corners{Coord(-6), Coord(120, -133, 3), Coord(4090, -4100, -7)};
    for (unsigned seed = 0; seed < (radius < 5 ? 3U : 1U); ++seed) {
        const DenseSet set = randomBlobs(cubeAt(corners[seed], 13), seed);
        const auto grid = toGrid(set);
        const Vec3d middle = corners[seed].asVec3d() + Vec3d(6.5);
        const FactorField scale = mixedField(middle, seed);
        const detail::RadiusField field(scale, grid->transform(), radius, grid->evalActiveVoxelBoundingBox(), {});
        BOOST_TEST(!field.isUniform());
        const DenseSet dilated = gathered(set, field);
        const auto fast = gridOf(detail::dilateByField(grid->tree(), field, {}, simd));
        BOOST_TEST(holds(*fast, dilated));
        for (const double factor : {1.0, 0.6}) {
            const DenseSet expected = scattered(dilated, field, factor);
            BOOST_TEST(
                holds(*gridOf(detail::erodeByField(fast->tree(), &grid->tree(), field, factor, {}, simd)), expected));
            CloseOptions options{radius, factor * radius, StructuringElement::sphere};
            BOOST_TEST(holds(*closeMask(*grid, options, scale), expected));
        }
    }
}

// Where the field is sampled at every fourth and eighth voxel; the closing is looked at in some places.
BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(closing_by_large_radii_equals_the_definition, data::make({17.3, 33.0}), radius)
{
    std::mt19937 random(5);
    const auto grid = MaskGrid::create();
    for (int i = 0; i < 10; ++i) {
        const auto coordinate = [&] { return static_cast<int>(random() % 24U); };
        grid->tree().setValueOn(Coord(coordinate(), coordinate() - 140, coordinate() + 120));
    }
    // Two plates, so that there is something to close.
    for (const int x : {20, 26}) grid->sparseFill(CoordBBox(Coord(x, -130, 130), Coord(x, -125, 135)), true);
    grid->tree().voxelizeActiveTiles();
    const DenseSet set(*grid, grid->evalActiveVoxelBoundingBox());
    const FactorField scale = mixedField(Vec3d(12, -128, 132), 1);
    const detail::RadiusField field(scale, grid->transform(), radius, set.box(), {});
    const DenseSet dilated = gathered(set, field);
    BOOST_TEST(holds(*dilate(*grid, radius, scale), dilated));
    const auto closed = closeMask(*grid, {radius, radius, StructuringElement::sphere}, scale);
    BOOST_TEST(isSubset(*grid, *closed));
    BOOST_TEST(closed->activeVoxelCount() > grid->activeVoxelCount());
    const Coord first = set.box().min(), size = set.box().dim();
    for (int i = 0; i < 600; ++i) {
        Coord p;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            p[axis] = first[axis] + static_cast<int>(random() % static_cast<unsigned>(size[axis]));
        }
        bool isKept = dilated[p];
        const CoordBBox around = grown(CoordBBox(p, p), static_cast<int>(radius));
        for (auto q = around.begin(); q && isKept; ++q) {
            isKept = dilated[*q] || squaredLength(*q - p) > field.square(*q, 1);
        }
        BOOST_TEST(closed->tree().isValueOn(p) == isKept);
    }
}

BOOST_AUTO_TEST_CASE(tiles_and_threads_make_no_difference)
{
    auto tiles = MaskGrid::create();
    tiles->sparseFill(cubeAt(Coord(-128), 256), true);
    tiles->sparseFill(cubeAt(Coord(136, 0, 0), 24), true);
    const auto dense = tiles->deepCopy();
    dense->tree().voxelizeActiveTiles();
    const FactorField scale{nullptr, {sphereRegion(Vec3d(132, 12, 12), 14, 0.3)}};
    const CloseOptions options{9, 8, StructuringElement::sphere};
    MaskGrid::Ptr results[2];
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results[threads - 1] = closeMask(threads == 1 ? *tiles : *dense, options, scale);
    }
    BOOST_TEST(sameTree(*results[0], *results[1]));
    BOOST_TEST(!sameSet(*results[0], *tiles));
    BOOST_TEST(closeMask(*MaskGrid::create(), options, scale)->empty());
}

BOOST_AUTO_TEST_CASE(far_from_the_origin)
{
    constexpr int limit = 1 << 30;
    for (const Coord& corner : {Coord(-limit), Coord(limit - 12)}) {
        const auto grid = toGrid(randomBlobs(cubeAt(corner, 12), 3));
        const auto near = shifted(*grid, Coord(0) - corner);
        const auto field = [](const Coord& at) {
            return FactorField{nullptr, {sphereRegion(at.asVec3d() + Vec3d(5), 3, 0.25)}};
        };
        const CloseOptions options{4, 4, StructuringElement::sphere};
        BOOST_TEST(sameSet(*shifted(*closeMask(*grid, options, field(corner)), Coord(0) - corner),
                           *closeMask(*near, options, field(Coord(0)))));
    }
    auto beyond = MaskGrid::create();
    beyond->tree().setValueOn(Coord(limit));
    BOOST_CHECK_THROW(closeMask(*beyond, {}, {nullptr, {sphereRegion(Coord(limit).asVec3d(), 3, 0.5)}}), InputError);
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(closing_is_extensive_idempotent_and_increasing, data::make({3.7, 9.0, 17.0}), radius)
{
    const auto small = fatBlobs(90, 3), large = fatBlobs(90, 4);
    large->topologyUnion(*small);
    const FactorField scale{nullptr, {sphereRegion(Vec3d(20, 0, 0), 25, 0.2), boxRegion(Vec3d(-50), Vec3d(-10), 1.5)}};
    const CloseOptions options{radius, radius, StructuringElement::sphere};
    const auto closed = closeMask(*small, options, scale);
    BOOST_TEST(isSubset(*small, *closed));
    BOOST_TEST(!isSubset(*closed, *small));
    BOOST_TEST(sameTree(*closed, *closeMask(*closed, options, scale)));
    BOOST_TEST(isSubset(*closed, *closeMask(*large, options, scale)));
    BOOST_TEST(!sameSet(*closed, *closeMask(*small, options)));
    BOOST_TEST(isSubset(*closed, *closeMask(*small, {radius, 0.5 * radius, StructuringElement::sphere}, scale)));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_AUTO_TEST_CASE(radii_obey_the_field_and_the_slope)
{
    const CoordBBox box = cubeAt(Coord(-20), 40);
    for (const double radius : {3.0, 10.0, 40.0}) {
        const FactorField scale{nullptr, {sphereRegion(Vec3d(0), 9, 0.25)}};
        const detail::RadiusField field(scale, openvdb::math::Transform(), radius, box, {});
        BOOST_TEST(field.largest() == radius);
        BOOST_TEST(field.square(Coord(0), 1) <= 0.0625 * radius * radius);
        BOOST_TEST(field.square(Coord(0), 1) > 0.0625 * radius * radius - 2);
        for (auto c = box.begin(); c; ++c) {
            const double r = std::sqrt(field.square(*c, 1));
            BOOST_REQUIRE(r <= radius);
            // Far enough from the sphere to have grown back.
            const double rise = (std::sqrt(squaredLength(*c)) - 9) / 2 + 0.25 * radius;
            BOOST_REQUIRE(r <= std::max(rise * std::sqrt(3.0), 0.25 * radius) + 3);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Coord next = *c;
                ++next[axis];
                // Squares are rounded down: by up to 0.6 of a voxel where radii are small.
                BOOST_REQUIRE(std::abs(std::sqrt(field.square(next, 1)) - r) <= 0.5 + 0.6);
            }
        }
        BOOST_TEST(field.square(Coord(5000), 1) == static_cast<int>(radius * radius));
    }
}

BOOST_AUTO_TEST_CASE(a_field_of_one_value_is_one_radius)
{
    const auto grid = fatBlobs(60, 5);
    const CloseOptions options{7.3, 6, StructuringElement::sphere};
    BOOST_TEST(sameTree(*closeMask(*grid, options, FactorField{}), *closeMask(*grid, options)));
    BOOST_TEST(sameTree(*closeMask(*grid, {7.3, 6, StructuringElement::cube}, FactorField{}),
                        *closeMask(*grid, {7.3, 6, StructuringElement::cube})));
    BOOST_TEST(sameTree(*closeMask(*grid, options, {FloatGrid::create(0.5F), {}}),
                        *closeMask(*grid, {3.65, 3, StructuringElement::sphere})));
    const FactorField elsewhere{nullptr, {sphereRegion(Vec3d(5000, 0, 0), 10, 0)}};
    BOOST_TEST(sameTree(*closeMask(*grid, options, elsewhere), *closeMask(*grid, options)));
}

BOOST_AUTO_TEST_CASE(a_hole_stays_where_the_field_is_zero)
{
    // A plate with two holes, in a grid whose voxels are a tenth wide.
    auto plate = MaskGrid::create();
    plate->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    plate->sparseFill(CoordBBox(Coord(0), Coord(79, 39, 5)), true);
    for (const int x : {20, 60}) plate->sparseFill(CoordBBox(Coord(x - 3, 17, 0), Coord(x + 2, 22, 5)), false, false);
    const CloseOptions options{6, 6, StructuringElement::sphere};
    const Coord first(20, 20, 3), second(60, 20, 3);
    BOOST_TEST(!plate->tree().isValueOn(first));
    BOOST_TEST(!plate->tree().isValueOn(second));
    const auto uniform = closeMask(*plate, options);
    BOOST_TEST(uniform->tree().isValueOn(first));
    BOOST_TEST(uniform->tree().isValueOn(second));
    const auto kept = closeMask(*plate, options, {nullptr, {sphereRegion(Vec3d(2, 2, 0.3), 0.8, 0)}});
    BOOST_TEST(!kept->tree().isValueOn(first));
    BOOST_TEST(kept->tree().isValueOn(second));
    BOOST_CHECK(kept->transform() == plate->transform());
}

BOOST_AUTO_TEST_CASE(values_at_points_become_a_grid)
{
    const std::vector<Vec3d> points{Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0.1, 0, 0)};
    const auto scale = factorsFromPoints(points, {0.25F, 0.5F, 0.75F}, 0.1, 0.3);
    const auto at = [&](const Vec3d& p) { return scale->tree().getValue(Coord::round(scale->worldToIndex(p))); };
    BOOST_TEST(at(points[0]) == 0.25F);
    BOOST_TEST(at(points[1]) == 0.5F);
    BOOST_TEST(at(points[2]) == 0.75F);
    BOOST_TEST(at(Vec3d(1.2, 0.2, 0)) == 0.5F);
    BOOST_TEST(at(Vec3d(1.3, 0.2, 0)) == 1.0F);
    BOOST_TEST(at(Vec3d(-0.2, 0, 0)) == 0.25F);
    BOOST_TEST(scale->background() == 1.0F);
    BOOST_CHECK_THROW(factorsFromPoints(points, {1.0F}, 0.1, 0.3), InputError);
    BOOST_CHECK_THROW(factorsFromPoints(points, {1.0F, 1.0F, std::nanf("")}, 0.1, 0.3), InputError);
    BOOST_CHECK_THROW(factorsFromPoints({}, {}, 0, 0.3), InputError);
    BOOST_CHECK_THROW(factorsFromPoints({}, {}, 0.1, 6.5), InputError);
    StopOnce stop(0);
    BOOST_CHECK_THROW(factorsFromPoints(points, {1.0F, 1.0F, 1.0F}, 0.1, 0.3, &stop), Cancelled);
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused)
{
    const auto grid = toGrid(randomBlobs(cubeAt(Coord(0), 10), 2));
    const CloseOptions options;
    const auto refused = [&](const FactorField& scale, const CloseOptions& with) {
        BOOST_CHECK_THROW(closeMask(*grid, with, scale), InputError);
    };
    refused({nullptr, {sphereRegion(Vec3d(0), 5, -0.1)}}, options);
    refused({nullptr, {sphereRegion(Vec3d(0), 5, 8.1)}}, options);
    refused({nullptr, {sphereRegion(Vec3d(0), 5, std::nan(""))}}, options);
    refused({nullptr, {sphereRegion(Vec3d(0), -5, 0.5)}}, options);
    refused({nullptr, {boxRegion(Vec3d(0), Vec3d(std::numeric_limits<double>::infinity()), 0.5)}}, options);
    refused({nullptr, {sphereRegion(Vec3d(0), 5, 0.5)}}, {4, 4, StructuringElement::cube});
    refused({nullptr, {sphereRegion(Vec3d(0), 5, 0.5)}}, {4, 5, StructuringElement::sphere});
    refused({nullptr, {sphereRegion(Vec3d(0), 5000, 8)}}, {100, 100, StructuringElement::sphere});
    auto field = FloatGrid::create(1.0F);
    field->tree().setValue(Coord(0), std::numeric_limits<float>::infinity());
    refused({field, {}}, options);
    refused({FloatGrid::create(std::nanf("")), {}}, options);
    auto frustum = FloatGrid::create(1.0F);
    frustum->tree().setValue(Coord(0), 0.5F);
    frustum->setTransform(
        openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0), Vec3d(10)), 0.5, 10));
    refused({frustum, {}}, options);
    auto corners = MaskGrid::create();
    corners->tree().setValueOn(Coord(-100000));
    corners->tree().setValueOn(Coord(100000));
    BOOST_CHECK_THROW(closeMask(*corners, options, {nullptr, {boxRegion(Vec3d(-1e6), Vec3d(1e6), 0.5)}}), InputError);
}

BOOST_AUTO_TEST_CASE(stops_at_any_check)
{
    const auto grid = toGrid(randomBlobs(cubeAt(Coord(-6), 12), 9));
    const FactorField scale{nullptr, {sphereRegion(Vec3d(0), 5, 0.5)}};
    const CloseOptions options{3, 3, StructuringElement::sphere};
    StopOnce never(-1);
    closeMask(*grid, options, scale, &never);
    BOOST_TEST(!never.outOfRange);
    BOOST_TEST(never.checks > 10);
    for (int k = 0; k < never.checks; ++k) {
        StopOnce stop(k);
        BOOST_CHECK_THROW(closeMask(*grid, options, scale, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
