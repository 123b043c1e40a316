#include <boost/test/unit_test.hpp>

#include <volume/masks.h>

#include <vdbcage/core/error.h>
#include <vdbcage/volume/boundary_voxels.h>

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

DenseSet contourByDefinition(const DenseSet& set)
{
    DenseSet result(set.box());
    for (auto c = set.box().begin(); c; ++c) {
        bool isInner = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            for (const int step : {-1, 1}) {
                Coord neighbour = *c;
                neighbour[axis] += step;
                isInner = isInner && set[neighbour];
            }
        }
        result.set(*c, set[*c] && !isInner);
    }
    return result;
}

} // namespace

BOOST_AUTO_TEST_SUITE(contours)

BOOST_AUTO_TEST_CASE(equals_the_definition, *boost::unit_test::label("property"))
{
    for (const Coord& corner : {Coord(-9), Coord(120, -135, 1), Coord(4090, -4100, -8)}) {
        for (unsigned seed = 0; seed < 5; ++seed) {
            const DenseSet set = randomBlobs(cubeAt(corner, 21), seed);
            BOOST_TEST(sameTree(*contour(*toGrid(set)), *toGrid(contourByDefinition(set))));
        }
    }
}

BOOST_AUTO_TEST_CASE(of_tiles_is_their_skin)
{
    for (const int size : {8, 128, 256}) {
        auto grid = MaskGrid::create();
        grid->sparseFill(cubeAt(Coord(-128), size), true);
        const auto skin = contour(*grid);
        const auto n = static_cast<openvdb::Index64>(size), inner = n - 2;
        BOOST_TEST(skin->activeVoxelCount() == n * n * n - inner * inner * inner);
        BOOST_TEST(isSubset(*skin, *grid));
    }
}

BOOST_AUTO_TEST_CASE(keeps_the_transform_and_stops_when_told)
{
    auto grid = toGrid(randomBlobs(cubeAt(Coord(0), 20), 1));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
    BOOST_CHECK(contour(*grid)->transform() == grid->transform());
    StopOnce never(-1);
    contour(*grid, &never);
    BOOST_TEST(never.checks > 0);
    for (int k = 0; k < never.checks; ++k) {
        StopOnce stop(k);
        BOOST_CHECK_THROW(contour(*grid, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
