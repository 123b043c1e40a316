#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/volume/detail/boundary_topology.h>
#include <vdbcage/volume/extract.h>

#include "support/shapes.h"
#include "support/solids.h"
#include "support/stop_at.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::MaskGrid;

namespace {

/// Latecki's definition, voxel by voxel: the number of 2x2 squares and 2x2x2 cubes in which just one diagonal pair
/// has the one state and all others have the other.
std::size_t criticalPlaces(const MaskGrid& grid)
{
    const auto voxels = grid.getConstAccessor();
    std::size_t count = 0;
    const CoordBBox box = grid.evalActiveVoxelBoundingBox();
    for (int x = box.min().x() - 1; x <= box.max().x(); ++x) {
        for (int y = box.min().y() - 1; y <= box.max().y(); ++y) {
            for (int z = box.min().z() - 1; z <= box.max().z(); ++z) {
                const auto on = [&](int dx, int dy, int dz) { return voxels.isValueOn(Coord(x + dx, y + dy, z + dz)); };
                const auto crossed = [](bool a, bool b, bool c, bool d) { return a == d && b == c && a != b; };
                count += crossed(on(0, 0, 0), on(1, 0, 0), on(0, 1, 0), on(1, 1, 0));
                count += crossed(on(0, 0, 0), on(1, 0, 0), on(0, 0, 1), on(1, 0, 1));
                count += crossed(on(0, 0, 0), on(0, 1, 0), on(0, 0, 1), on(0, 1, 1));
                for (int corner = 0; corner < 4; ++corner) {
                    int different = 0;
                    const auto at = [&](int n) { return on(n >> 2, n >> 1 & 1, n & 1); };
                    for (int n = 0; n < 8; ++n) different += at(n) != at(corner);
                    count += different == 6 && at(7 - corner) == at(corner);
                }
            }
        }
    }
    return count;
}

std::size_t exposedFaces(const MaskGrid& grid)
{
    const auto voxels = grid.getConstAccessor();
    std::size_t count = 0;
    for (const Coord& voxel : grid.evalActiveVoxelBoundingBox()) {
        if (!voxels.isValueOn(voxel)) continue;
        for (const Coord& step : {Coord(1, 0, 0), Coord(0, 1, 0), Coord(0, 0, 1)}) {
            count += !voxels.isValueOn(voxel + step) + !voxels.isValueOn(voxel - step);
        }
    }
    return count;
}

bool contains(const MaskGrid& outer, const MaskGrid& inner)
{
    MaskGrid::Ptr rest = inner.deepCopy();
    rest->tree().topologyDifference(outer.tree());
    return rest->activeVoxelCount() == 0;
}

bool sameVoxels(const MaskGrid& a, const MaskGrid& b)
{
    return contains(a, b) && contains(b, a);
}

/// Everything that is promised about a solid with voxels of the given size. BOOST_TEST is too slow to call per fact.
bool holdsFor(const MaskGrid& solid, double voxelSize = 1)
{
    const MaskGrid::Ptr composed = makeWellComposed(solid);
    if (criticalPlaces(*composed) != 0 || !contains(*composed, solid)) return false;
    if (criticalPlaces(solid) == 0 && !sameVoxels(*composed, solid)) return false;
    const Mesh surface = extractSurface(solid);
    const std::size_t faces = exposedFaces(*composed);
    const TopologyCount count = countTopology(surface);
    const detail::BoundaryTopology counted = detail::boundaryTopology(solid);
    const MeshTopology topology = analyzeTopology(surface);
    if (counted.components != topology.components() || counted.genus != topology.genus()) return false;
    const double volume = double(composed->activeVoxelCount()) * std::pow(voxelSize, 3);
    const double area = double(faces) * voxelSize * voxelSize;
    return surface.triangles.empty() && surface.quads.size() == faces && count.points == surface.points.size() &&
           count.closedManifold() && std::abs(count.volume - volume) < 1e-9 * volume &&
           std::abs(count.area - area) < 1e-9 * area;
}

MaskGrid::Ptr boxes(const std::vector<CoordBBox>& all)
{
    auto grid = MaskGrid::create();
    for (const CoordBBox& box : all) grid->sparseFill(box, true);
    return grid;
}

} // namespace

BOOST_AUTO_TEST_SUITE(extract)

BOOST_DATA_TEST_CASE(all_blocks_of_eight_voxels, boost::unit_test::data::make({-1, 0, 6, 7, -129, 4095}), low)
{
    for (int bits = 1; bits < 256; ++bits) {
        auto grid = MaskGrid::create();
        for (int n = 0; n < 8; ++n) {
            if (bits >> n & 1) grid->tree().setValueOn(Coord(low + (n >> 2), low + (n >> 1 & 1), low + (n & 1)));
        }
        BOOST_REQUIRE_MESSAGE(holdsFor(*grid), "configuration " << bits);
    }
}

BOOST_DATA_TEST_CASE(random_solids, boost::unit_test::data::xrange(1, 10), tenths)
{
    for (const Coord& low : {Coord(-5, -5, -5), Coord(123, -133, 4091), Coord(0, 8, 1)}) {
        const auto grid = randomSolid(std::uint32_t(tenths), 12, tenths / 10.0, low);
        BOOST_TEST(holdsFor(*grid));
    }
}

BOOST_AUTO_TEST_CASE(smooth_solids_need_few_voxels)
{
    for (const auto& grid : {sample(40, inCreature), sample(48, inTorus)}) {
        BOOST_TEST(holdsFor(*grid, grid->voxelSize().x()));
        BOOST_TEST(makeWellComposed(*grid)->activeVoxelCount() <= grid->activeVoxelCount() + 8);
    }
    BOOST_TEST(countTopology(extractSurface(*sample(48, inTorus))).genus() == 1);
}

BOOST_AUTO_TEST_CASE(nothing_gives_nothing)
{
    auto grid = MaskGrid::create();
    BOOST_TEST(faceCount(extractSurface(*grid)) == 0U);
    grid->tree().setValueOn(Coord(3, 3, 3));
    grid->tree().setValueOff(Coord(3, 3, 3)); // an empty leaf
    BOOST_TEST(faceCount(extractSurface(*grid)) == 0U);
}

BOOST_AUTO_TEST_CASE(one_voxel_is_the_unit_cube_around_its_place)
{
    auto grid = MaskGrid::create();
    grid->tree().setValueOn(Coord(7, -8, 3));
    const Mesh cube = extractSurface(*grid);
    BOOST_TEST(cube.points.size() == 8U);
    BOOST_TEST(cube.quads.size() == 6U);
    BOOST_TEST((boundingBox(cube).min() == Vec3d(6.5, -8.5, 2.5)));
    BOOST_TEST((boundingBox(cube).max() == Vec3d(7.5, -7.5, 3.5)));
}

BOOST_AUTO_TEST_CASE(tiles_count_as_their_voxels)
{
    const CoordBBox leafTile(0, 0, 0, 7, 7, 7), besideEdge(8, 8, 0, 15, 15, 7), besideCorner(-8, -8, -8, -1, -1, -1);
    const CoordBBox bigTile(128, 0, 0, 255, 127, 127), crossed(0, 128, 0, 127, 255, 127);
    for (const auto& grid :
         {boxes({leafTile}), boxes({leafTile, besideEdge}), boxes({leafTile, besideCorner}), boxes({bigTile}),
          boxes({bigTile, crossed}), boxes({leafTile, CoordBBox(8, 8, 8, 8, 8, 8)}),
          boxes({CoordBBox(-3, -20, 5, 40, 30, 33)}), boxes({bigTile, CoordBBox(127, 127, 127, 300, 140, 140)})}) {
        BOOST_TEST(grid->tree().activeTileCount() > 0U);
        const MaskGrid::Ptr dense = grid->deepCopy();
        dense->tree().voxelizeActiveTiles();
        BOOST_TEST(sameVoxels(*makeWellComposed(*grid), *makeWellComposed(*dense)));
        BOOST_TEST(sameMesh(extractSurface(*grid), extractSurface(*dense)));
        BOOST_TEST(countTopology(extractSurface(*grid)).closedManifold());
    }
    BOOST_TEST(criticalPlaces(*makeWellComposed(*boxes({leafTile, besideEdge, besideCorner}))) == 0U);
    BOOST_TEST(makeWellComposed(*boxes({bigTile}))->tree().leafCount() == 0U);
}

BOOST_AUTO_TEST_CASE(the_transform_is_applied_and_a_mirror_does_not_turn_the_faces)
{
    const auto grid = randomSolid(3, 9, 0.6, Coord(-4, -4, -4));
    const double volume = countTopology(extractSurface(*grid)).volume;
    openvdb::Mat4d matrix = openvdb::Mat4d::identity();
    matrix.setToRotation(Vec3d(1, 2, 3).unit(), 0.7);
    matrix.postScale(Vec3d(0.5, 0.25, -2.0));
    matrix.setTranslation(Vec3d(-1000, 3, 5));
    grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
    const TopologyCount count = countTopology(extractSurface(*grid));
    BOOST_TEST(count.closedManifold());
    BOOST_TEST(std::abs(count.volume - volume / 4) < 1e-6);

    grid->setTransform(
        openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd(Vec3d(0.0), Vec3d(10.0)), 0.5, 10, 1));
    BOOST_CHECK_THROW(extractSurface(*grid), InputError);
}

BOOST_AUTO_TEST_CASE(the_solid_is_not_changed_and_threads_do_not_matter)
{
    const auto grid = randomSolid(9, 40, 0.4, Coord(-17, 3, 100));
    const auto before = grid->deepCopy();
    const Mesh surface = extractSurface(*grid);
    BOOST_TEST(sameVoxels(*grid, *before));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_TEST(sameMesh(surface, extractSurface(*grid)));
}

BOOST_AUTO_TEST_CASE(cancelled_at_any_question)
{
    const auto grid = randomSolid(9, 30, 0.3, Coord(0, 0, 0));
    StopAt never(1 << 20);
    extractSurface(*grid, &never);
    const int asked = questions(never, 1 << 20);
    BOOST_TEST(asked >= 4);
    for (int k = 0; k < 4; ++k) {
        StopAt stop(k);
        BOOST_CHECK_THROW(extractSurface(*grid, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
