#include <boost/test/unit_test.hpp>

#include <set>

#include <vdbcage/core/error.h>
#include <vdbcage/volume/mirror.h>

#include "support/solids.h"
#include "volume/masks.h"

using namespace vdbcage;
using openvdb::Coord;

namespace {

std::set<Coord> voxels(const openvdb::MaskGrid& mask)
{
    std::set<Coord> all;
    for (auto value = mask.tree().cbeginValueOn(); value; ++value) {
        openvdb::CoordBBox box;
        value.getBoundingBox(box);
        for (auto voxel = box.begin(); voxel; ++voxel) all.insert(*voxel);
    }
    return all;
}

} // namespace

BOOST_AUTO_TEST_SUITE(mirror)

BOOST_AUTO_TEST_CASE(it_is_the_union_with_the_mirror_image)
{
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        const auto mask = test::randomSolid(seed, 14, 0.3, Coord(-5, 3, 100));
        mask->tree().fill(openvdb::CoordBBox(Coord(8, 8, 8), Coord(31, 15, 23)), true, true); // tiles
        for (const std::size_t axis : {0U, 1U, 2U}) {
            for (const int sum : {0, 7, -20, 31}) {
                std::set<Coord> expected = voxels(*mask);
                for (Coord voxel : voxels(*mask)) {
                    voxel[axis] = sum - voxel[axis];
                    expected.insert(voxel);
                }
                const auto both = withMirrorImage(*mask, int(axis), sum);
                BOOST_CHECK(voxels(*both) == expected);
                BOOST_CHECK(both->transform() == mask->transform());
                const auto again = withMirrorImage(*both, int(axis), sum);
                BOOST_TEST(again->activeVoxelCount() == expected.size());
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(bad_axes_and_cancelling)
{
    const auto mask = test::randomSolid(1, 8, 0.5, Coord(0));
    BOOST_CHECK_THROW(withMirrorImage(*mask, 3, 0), InputError);
    BOOST_CHECK_THROW(withMirrorImage(*mask, -1, 0), InputError);
    for (const bool tiles : {false, true}) {
        if (tiles) mask->tree().fill(openvdb::CoordBBox(Coord(0), Coord(7)), true, true);
        test::StopOnce stop(0);
        BOOST_CHECK_THROW(withMirrorImage(*mask, 0, 0, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
