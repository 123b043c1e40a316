#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <volume/by_definition.h>

#include <cmath>
#include <limits>

#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/detail/sphere/sphere_pass.h>
#include <vdbcage/volume/morphology.h>

namespace vdbcage {

/// For Boost.Test, which names the case by its data.
static std::ostream& operator<<(std::ostream& out, StructuringElement element)
{
    return out << (element == StructuringElement::sphere ? "sphere" : "cube");
}

} // namespace vdbcage

using namespace vdbcage;
using namespace vdbcage::test;
namespace data = boost::unit_test::data;

namespace {

const std::vector<StructuringElement> elements{StructuringElement::sphere, StructuringElement::cube};
const std::vector<double> radii{0, 0.5, 1, 1.41, 1.5, 2, 2.5, 3.7, 5, 8, 12.3};

MaskGrid::Ptr close(const MaskGrid& grid, double closeRadius, double erodeRadius, StructuringElement element)
{
    return closeMask(grid, {closeRadius, erodeRadius, element});
}

std::uint64_t countIf(int radius, int dimensions)
{
    std::uint64_t count = 0;
    for (int i = 1; i <= radius; ++i) {
        for (int j = 1; j <= (dimensions > 1 ? radius : 1); ++j) {
            for (int k = 1; k <= (dimensions > 2 ? radius : 1); ++k) {
                const int square = i * i + (dimensions > 1 ? j * j : 0) + (dimensions > 2 ? k * k : 0);
                if (square <= radius * radius) ++count;
            }
        }
    }
    return count;
}

// The number of voxels within a whole radius of a cube of n^3 voxels: the cube, its faces, edges and corners.
std::uint64_t dilatedCubeCount(std::uint64_t n, int radius)
{
    return n * n * n + 6 * n * n * countIf(radius, 1) + 12 * n * countIf(radius, 2) + 8 * countIf(radius, 3);
}

// The voxels within a radius of some voxels.
DenseSet unionOfBalls(const std::vector<Coord>& centres, double radius)
{
    const int reach = static_cast<int>(radius);
    CoordBBox box;
    for (const Coord& centre : centres) box.expand(grown(CoordBBox(centre, centre), reach));
    DenseSet set(box);
    for (const Coord& centre : centres) {
        for (int x = -reach; x <= reach; ++x) {
            for (int y = -reach; y <= reach; ++y) {
                for (int z = -reach; z <= reach; ++z) {
                    if (x * x + y * y + z * z <= radius * radius) set.set(centre.offsetBy(x, y, z), true);
                }
            }
        }
    }
    return set;
}

MaskGrid::Ptr gridOf(openvdb::MaskTree::Ptr tree)
{
    return MaskGrid::create(std::move(tree));
}

} // namespace

namespace vdbcage::detail {

/// For Boost.Test.
static std::ostream& operator<<(std::ostream& out, Simd simd)
{
    return out << (simd == Simd::plain ? "plain" : simd == Simd::avx2 ? "avx2" : "avx512");
}

} // namespace vdbcage::detail

BOOST_AUTO_TEST_SUITE(morphology)

// Below and above the radii where the sphere's kernels change their integers: 104 (coarse squares), 120 (heights).
BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(every_instruction_set_equals_the_definition,
                     data::make(detail::supportedSimd()) *
                         data::make({0.0, 0.5, 1.0, 2.5, 6.9, 16.0, 33.3, 64.0, 105.5, 121.0, 200.0}),
                     simd, radius)
{
    const std::vector<Coord> voxels{Coord(-3, 120, 64), Coord(9, 117, 71), Coord(5, 125, 60), Coord(6, 124, 60)};
    auto grid = MaskGrid::create();
    for (const Coord& voxel : voxels) grid->tree().setValueOn(voxel);
    const auto squared = static_cast<std::int64_t>(radius * radius);
    const auto ball = gridOf(detail::dilateBySphere(grid->tree(), squared, {}, simd));
    BOOST_TEST(holds(*ball, unionOfBalls(voxels, radius)));
    // The closing of two voxels next to each other is these two; of all four it is what the plain code says.
    const auto closed = gridOf(detail::erodeBySphere(ball->tree(), &grid->tree(), squared, {}, simd));
    BOOST_TEST(isSubset(*grid, *closed));
    BOOST_TEST(
        sameTree(*closed, *gridOf(detail::erodeBySphere(ball->tree(), nullptr, squared, {}, detail::Simd::plain))));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(every_instruction_set_closes_blobs_by_definition,
                     data::make(detail::supportedSimd()) * data::make({1.5, 4.0, 7.3, 11.0}), simd, radius)
{
    for (unsigned seed = 0; seed < 3; ++seed) {
        const DenseSet set = randomBlobs(cubeAt(Coord(120, -134, 4), 15), seed);
        const auto grid = toGrid(set);
        const auto squared = static_cast<std::int64_t>(radius * radius);
        const DenseSet dilated = dilatedByDefinition(set, radius, StructuringElement::sphere);
        const auto fast = gridOf(detail::dilateBySphere(grid->tree(), squared, {}, simd));
        BOOST_TEST(holds(*fast, dilated));
        BOOST_TEST(holds(*gridOf(detail::erodeBySphere(fast->tree(), &grid->tree(), squared, {}, simd)),
                         erodedByDefinition(dilated, radius, StructuringElement::sphere)));
    }
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(equals_the_definition, data::make(elements) * data::make(radii), element, radius)
{
    // Across the origin, across borders of leaves and blocks, across borders of upperNodes.
    const std::vector<Coord> corners{Coord(-6), Coord(120, -133, 3), Coord(4090, -4100, -7)};
    const unsigned seeds = radius < 3 ? 6 : radius < 9 ? 3 : 1;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        const DenseSet set = randomBlobs(cubeAt(corners[seed % 3], 11 + static_cast<int>(seed)), seed);
        const auto grid = toGrid(set);
        const DenseSet dilated = dilatedByDefinition(set, radius, element);
        BOOST_TEST(sameSet(*dilate(*grid, radius, element), *toGrid(dilated)));
        for (const double erodeRadius : {radius, 0.6 * radius}) {
            const auto expected = toGrid(erodedByDefinition(dilated, erodeRadius, element));
            BOOST_TEST(sameSet(*erode(*toGrid(dilated), erodeRadius, element), *expected));
            BOOST_TEST(sameSet(*close(*grid, radius, erodeRadius, element), *expected));
        }
    }
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(closing_is_extensive_idempotent_and_increasing, data::make(elements) * data::make({3.7, 9.0}),
                     element, radius)
{
    const auto small = fatBlobs(90, 3), large = fatBlobs(90, 4);
    large->topologyUnion(*small);
    const auto closed = close(*small, radius, radius, element);
    BOOST_TEST(isSubset(*small, *closed));
    BOOST_TEST(!isSubset(*closed, *small));
    BOOST_TEST(sameTree(*closed, *close(*closed, radius, radius, element)));
    BOOST_TEST(isSubset(*closed, *close(*large, radius, radius, element)));
    BOOST_TEST(isSubset(*closed, *close(*small, radius, 0.5 * radius, element)));
}

// The radii that equals_the_definition is too slow for: whole entries and parts of one, within a block and beyond.
BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(cubes_add_up, data::make({8, 12, 16, 17, 33, 64, 121}) * data::make({3, 8, 11}), radius, more)
{
    const auto grid = fatBlobs(160, 8);
    for (const Coord& lone : {Coord(-3, 120, 64), Coord(140, 0, -77)}) grid->tree().setValueOn(lone);
    const auto large = dilate(*grid, radius + more, StructuringElement::cube);
    BOOST_TEST(
        sameTree(*dilate(*dilate(*grid, radius, StructuringElement::cube), more, StructuringElement::cube), *large));
    BOOST_TEST(sameTree(*erode(*erode(*large, radius, StructuringElement::cube), more, StructuringElement::cube),
                        *erode(*large, radius + more, StructuringElement::cube)));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(whole_voxel_shifts_commute, data::make(elements), element)
{
    const auto grid = fatBlobs(70, 5);
    const auto closed = close(*grid, 6.2, 5, element);
    for (const Coord& by : {Coord(1, 2, 3), Coord(-128, 64, 4096), Coord(1 << 29, -(1 << 29), 777)}) {
        BOOST_TEST(sameSet(*close(*shifted(*grid, by), 6.2, 5, element), *shifted(*closed, by)));
    }
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(erosion_is_the_dilation_of_the_complement, data::make(elements), element)
{
    const auto grid = fatBlobs(120, 6);
    const int radius = 7;
    CoordBBox box = grid->evalActiveVoxelBoundingBox();
    auto complement = MaskGrid::create();
    complement->sparseFill(grown(box, 2 * radius), true);
    complement->topologyDifference(*grid);
    auto expected = MaskGrid::create();
    expected->sparseFill(grown(box, radius), true);
    expected->topologyDifference(*dilate(*complement, radius, element));
    BOOST_TEST(expected->activeVoxelCount() > 0U);
    BOOST_TEST(sameSet(*erode(*grid, radius, element), *expected));
}

BOOST_TEST_DECORATOR(*boost::unit_test::label("property"))
BOOST_DATA_TEST_CASE(opening_is_the_dilation_of_the_erosion, data::make(elements) * data::make({0.0, 1.0, 2.5, 4.0}),
                     element, radius)
{
    for (unsigned seed = 0; seed < 3; ++seed) {
        const DenseSet set = randomBlobs(cubeAt(Coord(120, -133, 3), 14), seed, 20);
        const auto grid = toGrid(set);
        DenseSet roomy(grown(set.box(), static_cast<int>(radius) + 1));
        for (auto c = set.box().begin(); c; ++c) roomy.set(*c, set[*c]);
        const auto opened = openMask(*grid, radius, element);
        BOOST_TEST(holds(*opened, dilatedByDefinition(erodedByDefinition(roomy, radius, element), radius, element)));
        BOOST_TEST(isSubset(*opened, *grid));
        BOOST_TEST(sameTree(*opened, *openMask(*opened, radius, element)));
    }
}

BOOST_AUTO_TEST_CASE(bool_grids_of_any_transform)
{
    const auto mask = fatBlobs(50, 8);
    auto bits = openvdb::BoolGrid::create(false);
    bits->topologyUnion(*mask); // values stay false: only active states count
    bits->setTransform(openvdb::math::Transform::createFrustumTransform(
        openvdb::BBoxd(openvdb::Vec3d(-30), openvdb::Vec3d(30)), 0.5, 10));
    bits->sparseFill(cubeAt(Coord(256), 8), true);
    mask->sparseFill(cubeAt(Coord(256), 8), true);
    const auto isSame = [&](const MaskGrid& fromBits, const MaskGrid& fromMask) {
        return sameTree(fromBits, fromMask) && fromBits.transform() == bits->transform();
    };
    for (const StructuringElement element : elements) {
        BOOST_TEST(isSame(*dilate(*bits, 4, element), *dilate(*mask, 4, element)));
        BOOST_TEST(isSame(*erode(*bits, 2, element), *erode(*mask, 2, element)));
        BOOST_TEST(isSame(*openMask(*bits, 2, element), *openMask(*mask, 2, element)));
        BOOST_TEST(isSame(*closeMask(*bits, {4, 3, element}), *close(*mask, 4, 3, element)));
    }
}

BOOST_DATA_TEST_CASE(one_and_two_threads_give_the_same, data::make(elements), element)
{
    const auto grid = fatBlobs(160, 7);
    MaskGrid::Ptr results[2];
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results[threads - 1] = close(*grid, 10, 8.5, element);
    }
    BOOST_TEST(sameTree(*results[0], *results[1]));
}

BOOST_DATA_TEST_CASE(equal_sets_give_equal_trees, data::make(elements), element)
{
    auto tiles = MaskGrid::create();
    tiles->sparseFill(cubeAt(Coord(-128), 256), true);
    tiles->sparseFill(cubeAt(Coord(136, 0, 0), 24), true);
    const auto dense = tiles->deepCopy();
    dense->tree().voxelizeActiveTiles();
    BOOST_TEST(dense->tree().leafCount() > tiles->tree().leafCount());
    BOOST_TEST(dilate(*dense, 0, element)->tree().leafCount() == 0U);
    for (const double radius : {0.0, 8.0, 11.0}) {
        BOOST_TEST(sameTree(*dilate(*tiles, radius, element), *dilate(*dense, radius, element)));
        BOOST_TEST(sameTree(*erode(*tiles, radius, element), *erode(*dense, radius, element)));
        BOOST_TEST(sameTree(*close(*tiles, radius, radius, element), *close(*dense, radius, radius, element)));
    }
}

BOOST_AUTO_TEST_CASE(only_active_states_count)
{
    // topologyUnion leaves active tiles whose value is false.
    openvdb::BoolGrid bits(false);
    bits.sparseFill(cubeAt(Coord(0), 128), true);
    auto grid = MaskGrid::create();
    grid->topologyUnion(bits);
    const auto result = dilate(*grid, 0);
    BOOST_TEST(result->activeVoxelCount() == 128U * 128U * 128U);
    for (auto value = result->cbeginValueOn(); value; ++value) BOOST_TEST(*value);
}

BOOST_AUTO_TEST_CASE(empty_and_single_voxel)
{
    for (const StructuringElement element : elements) {
        BOOST_TEST(dilate(*MaskGrid::create(), 5, element)->empty());
        BOOST_TEST(erode(*MaskGrid::create(), 5, element)->empty());
        BOOST_TEST(close(*MaskGrid::create(), 5, 5, element)->empty());
        auto voxel = MaskGrid::create();
        voxel->tree().setValueOn(Coord(7, -8, 127));
        BOOST_TEST(sameTree(*close(*voxel, 9, 9, element), *voxel));
        BOOST_TEST(erode(*voxel, 1, element)->empty());
        BOOST_TEST(sameTree(*erode(*voxel, 0.9, element), *voxel));
    }
}

// Beyond 16 bits of squared distance, and beyond one block.
BOOST_DATA_TEST_CASE(large_radii, data::make({102, 103, 104, 150, 301}), radius)
{
    auto voxel = MaskGrid::create();
    voxel->tree().setValueOn(Coord(-3, 120, 64));
    const auto ball = dilate(*voxel, radius);
    BOOST_TEST(ball->activeVoxelCount() == dilatedCubeCount(1, radius));
    const auto side = static_cast<std::uint64_t>(2 * radius + 1);
    BOOST_TEST(dilate(*voxel, radius, StructuringElement::cube)->activeVoxelCount() == side * side * side);
    BOOST_TEST(sameTree(*erode(*ball, radius), *voxel));
}

BOOST_AUTO_TEST_CASE(radii_at_the_edge_of_rounding)
{
    auto voxel = MaskGrid::create();
    voxel->tree().setValueOn(Coord(0));
    // The square of the double next below the root of 3 rounds to 3, but is less.
    const double below = std::nextafter(std::sqrt(3.0), 0.0), above = std::nextafter(std::sqrt(3.0), 2.0);
    BOOST_TEST(dilate(*voxel, above)->activeVoxelCount() == 27U);
    for (double radius = below; radius * radius >= 3.0; radius = std::nextafter(radius, 0.0)) {
        if (std::fma(radius, radius, -3.0) < 0) BOOST_TEST(dilate(*voxel, radius)->activeVoxelCount() == 19U);
    }
    BOOST_TEST(dilate(*voxel, 1.7)->activeVoxelCount() == 19U);
    BOOST_TEST(dilate(*voxel, 1.99, StructuringElement::cube)->activeVoxelCount() == 27U);
}

BOOST_AUTO_TEST_CASE(an_upper_tile_is_not_made_dense)
{
    auto grid = MaskGrid::create();
    grid->tree().addTile(3, Coord(-4096, 0, 0), true, true);
    grid->tree().addTile(3, Coord(0, 0, 0), true, true); // its neighbour: no contour between them
    const auto dilated = dilate(*grid, 8, StructuringElement::cube);
    BOOST_TEST(dilated->activeVoxelCount() == (8192ULL + 16) * (4096 + 16) * (4096 + 16));
    BOOST_TEST(dilated->tree().leafCount() == 0U);
    BOOST_TEST(sameTree(*erode(*dilated, 8, StructuringElement::cube), *grid));
    const auto eroded = erode(*grid, 8, StructuringElement::cube);
    BOOST_TEST(eroded->activeVoxelCount() == (8192ULL - 16) * (4096 - 16) * (4096 - 16));
}

BOOST_AUTO_TEST_CASE(an_upper_tile_and_the_sphere, *boost::unit_test::label("slow"))
{
    auto grid = MaskGrid::create();
    grid->tree().addTile(3, Coord(0), true, true);
    const auto dilated = dilate(*grid, 3);
    BOOST_TEST(dilated->activeVoxelCount() == dilatedCubeCount(4096, 3));
    BOOST_TEST(sameTree(*erode(*dilated, 3), *grid));
}

BOOST_AUTO_TEST_CASE(block_tiles_and_the_sphere)
{
    auto grid = MaskGrid::create();
    grid->sparseFill(cubeAt(Coord(-128), 256), true);
    const auto dilated = dilate(*grid, 13);
    BOOST_TEST(dilated->activeVoxelCount() == dilatedCubeCount(256, 13));
    BOOST_TEST(sameSet(*erode(*dilated, 13), *grid));
    BOOST_TEST(sameSet(*close(*grid, 13, 13, StructuringElement::sphere), *grid));
}

BOOST_AUTO_TEST_CASE(keeps_the_transform_and_nothing_else)
{
    auto grid = toGrid(randomBlobs(cubeAt(Coord(0), 10), 2));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.125));
    grid->transform().postTranslate(openvdb::Vec3d(1, 2, 3));
    grid->setName("solid");
    for (const auto& result : {dilate(*grid, 2), erode(*grid, 1), closeMask(*grid)}) {
        BOOST_CHECK(result->transform() == grid->transform());
        BOOST_TEST(result->metaCount() == 0U);
    }
}

BOOST_AUTO_TEST_CASE(bad_input_is_refused)
{
    const auto grid = toGrid(randomBlobs(cubeAt(Coord(0), 10), 2));
    constexpr double infinity = std::numeric_limits<double>::infinity();
    for (const double radius : {-0.001, 512.01, infinity, -infinity, std::nan("")}) {
        BOOST_CHECK_THROW(dilate(*grid, radius), InputError);
        BOOST_CHECK_THROW(erode(*grid, radius), InputError);
        BOOST_CHECK_THROW(openMask(*grid, radius), InputError);
        BOOST_CHECK_THROW(closeMask(*grid, {radius, 0, StructuringElement::cube}), InputError);
        BOOST_CHECK_THROW(closeMask(*grid, {4, radius, StructuringElement::cube}), InputError);
    }
    BOOST_CHECK_EXCEPTION(
        closeMask(*grid, {4, 4.5, StructuringElement::sphere}), InputError, [](const InputError& error) {
            return std::string(error.what()) == "the erode radius is 4.5 voxels; it must be between 0 and 4";
        });
    constexpr int limit = 1 << 30;
    for (const int bad : {limit, -limit - 1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        auto far = MaskGrid::create();
        far->tree().setValueOn(Coord(0, bad, 0));
        BOOST_CHECK_THROW(dilate(*far, 1), InputError);
        BOOST_CHECK_THROW(erode(*far, 1, StructuringElement::cube), InputError);
        BOOST_CHECK_THROW(openMask(*far, 1), InputError);
        BOOST_CHECK_THROW(closeMask(*far), InputError);
    }
    auto corners = MaskGrid::create();
    corners->tree().setValueOn(Coord(limit - 1));
    corners->tree().setValueOn(Coord(-limit));
    for (const StructuringElement element : elements) {
        BOOST_TEST(dilate(*corners, 100, element)->activeVoxelCount() > 2U);
        BOOST_TEST(sameTree(*close(*corners, 60, 60, element), *corners));
    }
}

BOOST_DATA_TEST_CASE(stops_at_any_check, data::make(elements), element)
{
    const auto grid = toGrid(randomBlobs(cubeAt(Coord(-6), 12), 9));
    StopOnce never(-1);
    closeMask(*grid, {3, 3, element}, &never);
    BOOST_TEST(!never.outOfRange);
    BOOST_TEST(never.checks > 10);
    for (int k = 0; k < never.checks; ++k) {
        StopOnce stop(k);
        BOOST_CHECK_THROW(closeMask(*grid, {3, 3, element}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
