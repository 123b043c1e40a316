#include <boost/test/unit_test.hpp>

#include <cstdint>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/volume/convex_hull.h>
#include <vdbcage/volume/extract.h>

#include "support/solids.h"
#include "volume/masks.h"

using namespace vdbcage;
using openvdb::Coord;
using openvdb::CoordBBox;

namespace {

/// Brute force, in integers: inside every plane through three corners that has all corners on one side.
std::vector<Coord> centresInHull(const openvdb::MaskGrid& mask)
{
    std::vector<Coord> corners; // twice
    for (auto voxel = mask.tree().cbeginValueOn(); voxel; ++voxel) {
        for (int c = 0; c < 8; ++c) {
            const Coord& v = voxel.getCoord();
            corners.emplace_back(2 * v.x() + (c & 1 ? 1 : -1), 2 * v.y() + (c & 2 ? 1 : -1),
                                 2 * v.z() + (c & 4 ? 1 : -1));
        }
    }
    struct Plane {
        std::int64_t x, y, z, offset;
        std::int64_t at(const Coord& p) const { return x * p.x() + y * p.y() + z * p.z() - offset; }
    };
    std::vector<Plane> planes;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        for (std::size_t j = i + 1; j < corners.size(); ++j) {
            for (std::size_t k = j + 1; k < corners.size(); ++k) {
                const Coord a = corners[j] - corners[i], b = corners[k] - corners[i];
                Plane plane{a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x(),
                            0};
                if (plane.x == 0 && plane.y == 0 && plane.z == 0) continue;
                plane.offset = plane.at(corners[i]);
                bool above = false, below = false;
                for (const Coord& p : corners) {
                    above |= plane.at(p) > 0;
                    below |= plane.at(p) < 0;
                }
                if (above && below) continue;
                if (above) plane = {-plane.x, -plane.y, -plane.z, -plane.offset};
                planes.push_back(plane);
            }
        }
    }
    std::vector<Coord> inside;
    for (auto voxel = mask.evalActiveVoxelBoundingBox().begin(); voxel; ++voxel) {
        const Coord centre(2 * (*voxel).x(), 2 * (*voxel).y(), 2 * (*voxel).z());
        bool isInside = true;
        for (const Plane& plane : planes) isInside &= plane.at(centre) <= 0;
        if (isInside) inside.push_back(*voxel);
    }
    return inside;
}

} // namespace

BOOST_AUTO_TEST_SUITE(convex_hull)

BOOST_AUTO_TEST_CASE(it_is_that_of_brute_force)
{
    std::size_t added = 0;
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
        const auto mask = test::randomSolid(seed, 9, 0.006, Coord(-4, 1000, int(seed)));
        const auto hull = convexHull(*mask);
        const std::vector<Coord> expected = centresInHull(*mask);
        BOOST_TEST(hull->activeVoxelCount() == expected.size());
        for (const Coord& voxel : expected) BOOST_TEST(hull->tree().isValueOn(voxel));
        BOOST_CHECK(hull->transform() == mask->transform());
        added += expected.size() - mask->activeVoxelCount();
    }
    BOOST_TEST(added > 1000U);
}

BOOST_AUTO_TEST_CASE(it_is_a_ball_around_the_mask)
{
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const auto mask = test::randomSolid(seed, 40, seed % 2 ? 0.0002 : 0.01, Coord(0, -300, 7));
        const auto hull = convexHull(*mask);
        const MeshTopology topology = analyzeTopology(extractSurface(*hull));
        BOOST_TEST(topology.components() == 1U);
        BOOST_TEST(topology.genus() == 0);
        BOOST_CHECK(test::isSubset(*mask, *hull));
    }
}

BOOST_AUTO_TEST_CASE(of_a_solid_box_it_is_the_box)
{
    for (const CoordBBox& box : {CoordBBox(Coord(0), Coord(0)), CoordBBox(Coord(-9, 3, 3), Coord(90, 3, 3)),
                                 CoordBBox(Coord(-50), Coord(50)), CoordBBox(Coord(1 << 20), Coord((1 << 20) + 1))}) {
        const auto mask = openvdb::MaskGrid::create();
        mask->tree().fill(box, true, true);
        const auto hull = convexHull(*mask);
        BOOST_CHECK(hull->evalActiveVoxelBoundingBox() == box);
        BOOST_TEST(hull->activeVoxelCount() == mask->activeVoxelCount());
    }
}

BOOST_AUTO_TEST_CASE(of_nothing_it_is_nothing_and_what_is_too_large_is_refused)
{
    const auto mask = openvdb::MaskGrid::create();
    BOOST_CHECK(convexHull(*mask)->empty());
    mask->tree().setValueOn(Coord(0));
    mask->tree().setValueOn(Coord(1 << 19, 1 << 19, 0));
    BOOST_CHECK_THROW(convexHull(*mask), Error);
}

BOOST_AUTO_TEST_CASE(it_can_be_cancelled)
{
    const auto mask = test::randomSolid(1, 40, 0.01, Coord(0));
    test::StopOnce never(-1);
    convexHull(*mask, &never);
    BOOST_TEST(never.checks > 10);
    for (int k = 0; k < never.checks; ++k) {
        test::StopOnce stop(k);
        BOOST_CHECK_THROW(convexHull(*mask, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
