#include <boost/test/unit_test.hpp>

#include <volume/masks.h>

#include <vector>

#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/cavities.h>

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

// Marks all empty voxels that face-connect to `seed`.
void floodFrom(const Coord& seed, const DenseSet& set, DenseSet& reached)
{
    std::vector<Coord> stack{seed};
    reached.set(seed, true);
    while (!stack.empty()) {
        const Coord c = stack.back();
        stack.pop_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                Coord next = c;
                next[axis] += step;
                if (!reached.box().isInside(next) || set[next] || reached[next]) continue;
                reached.set(next, true);
                stack.push_back(next);
            }
        }
    }
}

std::size_t fillByFlood(DenseSet& set)
{
    DenseSet outside(grown(set.box(), 1));
    floodFrom(outside.box().min(), set, outside);
    DenseSet reached = outside;
    std::size_t count = 0;
    for (auto c = set.box().begin(); c; ++c) {
        if (set[*c] || reached[*c]) continue;
        ++count;
        floodFrom(*c, set, reached);
    }
    for (auto c = set.box().begin(); c; ++c) set.set(*c, !outside[*c]);
    return count;
}

void requireSameAsFlood(DenseSet set)
{
    const auto [filled, cavities] = fillCavities(*toGrid(set));
    const std::size_t expected = fillByFlood(set);
    BOOST_TEST(cavities == expected);
    BOOST_TEST(sameSet(*filled, *toGrid(set)));
}

MaskGrid::Ptr box(const CoordBBox& voxels)
{
    auto grid = MaskGrid::create();
    grid->sparseFill(voxels, true);
    return grid;
}

// A box without the voxels of another one.
MaskGrid::Ptr shell(const CoordBBox& outer, const CoordBBox& inner)
{
    auto grid = box(outer);
    grid->topologyDifference(*box(inner));
    return grid;
}

std::size_t cavitiesOf(const MaskGrid& grid)
{
    return fillCavities(grid).cavities;
}

} // namespace

BOOST_AUTO_TEST_SUITE(cavities)

BOOST_AUTO_TEST_CASE(equals_a_flood, *boost::unit_test::label("property"))
{
    for (const Coord& corner : {Coord(-12), Coord(110, -140, 1), Coord(4085, -4108, -8)}) {
        for (unsigned seed = 0; seed < 12; ++seed) {
            // Sparse noise has no cavity, dense noise many small ones.
            std::mt19937 random(seed);
            DenseSet set = randomBlobs(cubeAt(corner, 25), seed, 30);
            const unsigned density = 8 * (seed % 12);
            for (auto c = set.box().begin(); c; ++c) {
                if (random() % 100 < density) set.set(*c, true);
            }
            requireSameAsFlood(set);
        }
    }
}

BOOST_AUTO_TEST_CASE(nested_shells)
{
    // Three shells around each other, the middle one across the borders of blocks, and a ball in the middle.
    DenseSet set(cubeAt(Coord(-20), 40));
    for (auto c = set.box().begin(); c; ++c) {
        const double r = ((*c).asVec3d() + openvdb::Vec3d(0.5)).length();
        set.set(*c, (r > 16 && r < 19) || (r > 8 && r < 11) || r < 4);
    }
    requireSameAsFlood(set);
    BOOST_TEST(cavitiesOf(*toGrid(set)) == 2U);
    set.set(Coord(17, 0, 0), false); // within the outer wall: a cavity of its own
    BOOST_TEST(cavitiesOf(*toGrid(set)) == 3U);
    for (int x = 14; x < 20; ++x) set.set(Coord(x, 0, 0), false);
    BOOST_TEST(cavitiesOf(*toGrid(set)) == 1U);
    requireSameAsFlood(set);
}

BOOST_AUTO_TEST_CASE(an_edge_is_no_way_out)
{
    const auto grid = shell(cubeAt(Coord(0), 20), cubeAt(Coord(1), 18));
    grid->tree().setValueOff(Coord(0, 0, 7));
    const auto [filled, cavities] = fillCavities(*grid);
    BOOST_TEST(cavities == 1U);
    BOOST_TEST(filled->activeVoxelCount() == 20U * 20U * 20U - 1U);
}

BOOST_AUTO_TEST_CASE(nothing_to_fill)
{
    BOOST_TEST(cavitiesOf(*MaskGrid::create()) == 0U);
    const auto grid = fatBlobs(60);
    BOOST_TEST(cavitiesOf(*grid) == 0U);
    BOOST_TEST(sameSet(*fillCavities(*grid).mask, *grid));
    BOOST_TEST(fillCavities(*grid).mask->tree().activeTileCount() > 0U); // and the result is pruned
}

BOOST_AUTO_TEST_CASE(cavities_of_whole_blocks)
{
    const CoordBBox outer = cubeAt(Coord(-300), 900);
    for (const int wall : {1, 40, 130}) {
        const auto grid = shell(outer, grown(outer, -wall));
        const auto whole = fillCavities(*box(outer)).mask;
        const auto hollow = fillCavities(*grid);
        BOOST_TEST(sameTree(*hollow.mask, *whole));
        BOOST_TEST(hollow.cavities == 1U);
        // Something floats inside, with a cavity of its own.
        grid->topologyUnion(*shell(cubeAt(Coord(0), 290), cubeAt(Coord(100), 150)));
        const auto nested = fillCavities(*grid);
        BOOST_TEST(sameTree(*nested.mask, *whole));
        BOOST_TEST(nested.cavities == 2U);
        grid->topologyDifference(*box(CoordBBox(Coord(-300, 5, 5), Coord(-300 + wall - 1, 5, 5))));
        BOOST_TEST(cavitiesOf(*grid) == 1U);
    }
}

BOOST_AUTO_TEST_CASE(cavities_of_whole_upper_nodes)
{
    // Walls of block tiles around more than an upper node, and one of upper node tiles.
    const CoordBBox outer = cubeAt(Coord(-4096 - 512), 2 * 4096 + 1024);
    const auto grid = shell(outer, grown(outer, -256));
    const auto [filled, cavities] = fillCavities(*grid);
    BOOST_TEST(cavities == 1U);
    BOOST_TEST(filled->activeVoxelCount() == outer.volume());
    BOOST_TEST(filled->tree().getValueDepth(Coord(0)) == 0);
    auto upperNodes = MaskGrid::create();
    for (int i = 0; i < 27; ++i) {
        if (i != 13) upperNodes->tree().addTile(3, Coord(i / 9 * 4096, i / 3 % 3 * 4096, i % 3 * 4096), true, true);
    }
    const auto full = fillCavities(*upperNodes);
    BOOST_TEST(full.cavities == 1U);
    BOOST_TEST(full.mask->activeVoxelCount() == 27ULL << 36U);
}

BOOST_AUTO_TEST_CASE(far_scattered_voxels_cost_nothing)
{
    auto grid = MaskGrid::create();
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        const auto coordinate = [&] { return static_cast<int>(random() >> 1U) - (1 << 30); };
        grid->tree().setValueOn(Coord(coordinate(), coordinate(), coordinate()));
    }
    BOOST_TEST(cavitiesOf(*grid) == 0U);
}

BOOST_AUTO_TEST_CASE(threads_transform_cancel)
{
    auto grid = toGrid(randomBlobs(cubeAt(Coord(-20), 40), 4, 60));
    grid->topologyUnion(*shell(cubeAt(Coord(100), 100), cubeAt(Coord(110), 60)));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    MaskGrid::Ptr results[2];
    for (const std::size_t threads : {1U, 2U}) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results[threads - 1] = fillCavities(*grid).mask;
    }
    BOOST_TEST(sameTree(*results[0], *results[1]));
    BOOST_CHECK(results[0]->transform() == grid->transform());
    StopOnce never(-1);
    fillCavities(*grid, &never);
    BOOST_TEST(!never.outOfRange);
    BOOST_TEST(never.checks > 2);
    for (int k = 0; k < never.checks; ++k) {
        StopOnce stop(k);
        BOOST_CHECK_THROW(fillCavities(*grid, &stop), Cancelled);
    }
    auto far = MaskGrid::create();
    far->tree().setValueOn(Coord(1 << 30, 0, 0));
    BOOST_CHECK_THROW(fillCavities(*far), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
