#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/voxelize/detail/face_scan.h>
#include <vdbcage/voxelize/voxelize.h>
#include <voxelize/models.h>
#include <voxelize/reference.h>

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3i;
using test::HardModel;

namespace {

std::vector<openvdb::Vec3I> allTriangles(const Mesh& mesh)
{
    std::vector<openvdb::Vec3I> triangles = triangulate(mesh);
    for (const auto& q : mesh.quads) {
        triangles.emplace_back(q[0], q[1], q[3]);
        triangles.emplace_back(q[1], q[2], q[3]);
    }
    return triangles;
}

/// The voxels that scanSurface sets, slab by slab.
BitGrid scannedSurface(const Mesh& mesh, const Frame& frame, int planesPerSlab)
{
    BitGrid bits(frame.voxels);
    std::vector<Vec3i> points = latticePoints(mesh, frame);
    const Coord low = frame.voxels.min();
    for (Vec3i& p : points) p -= Vec3i(low.x(), low.y(), low.z()) * latticeStep;
    ScanBuffer buffer;
    for (int x = 0; x < bits.size().x(); x += planesPerSlab) {
        Slab slab;
        slab.planes = {x, std::min(x + planesPerSlab, bits.size().x()) - 1};
        slab.rowsPerPlane = bits.size().y();
        slab.wordsPerRow = bits.wordsPerRow();
        slab.surface = bits.row(x, 0);
        for (const auto& t : allTriangles(mesh)) {
            scanSurface({{points[t[0]], points[t[1]], points[t[2]]}}, false, slab, buffer);
        }
    }
    return bits;
}

} // namespace

BOOST_AUTO_TEST_SUITE(surface)

BOOST_DATA_TEST_CASE(touched_voxels_are_those_of_the_definition, boost::unit_test::data::make(test::hardModels()),
                     model)
{
    const Frame frame = makeFrame(model.mesh, model.resolution);
    const test::Reference& reference = test::referenceOf(model);
    const BitGrid bits = scannedSurface(model.mesh, frame, 5);
    std::size_t missing = 0, extra = 0;
    for (const Coord& ijk : frame.voxels) {
        const bool expected = reference.surface[reference.index(ijk)], got = test::isOn(bits, ijk);
        missing += expected && !got;
        extra += !expected && got;
    }
    BOOST_TEST(missing == 0U);
    BOOST_TEST(extra == 0U);
}

BOOST_DATA_TEST_CASE(no_voxel_of_the_unrounded_model_is_missed, boost::unit_test::data::make(test::hardModels()), model)
{
    // In world space, on the cubes as the transform has them, with exact numbers.
    using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
    using Number = Kernel::FT;
    const openvdb::MaskGrid::Ptr mask = voxelize(model.mesh, {model.resolution}).mask;
    const BitGrid surface = scannedSurface(model.mesh, makeFrame(model.mesh, model.resolution), 100);
    const double size = mask->voxelSize().x();
    const Vec3d translation = mask->transform().indexToWorld(Vec3d(0));
    const auto border = [&](int index, int axis, int side) {
        return Number(translation[axis]) + (Number(index) + Number(side) / 2) * Number(size);
    };
    const auto exact = [](const Vec3d& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
    auto accessor = mask->getConstAccessor();
    std::size_t missing = 0, notOnSurface = 0, tested = 0;
    for (const auto& t : allTriangles(model.mesh)) {
        const Vec3d &a = model.mesh.points[t[0]], &b = model.mesh.points[t[1]], &c = model.mesh.points[t[2]];
        const Kernel::Triangle_3 triangle(exact(a), exact(b), exact(c));
        if (triangle.is_degenerate()) continue;
        const auto voxel = [&](const Vec3d& p) { return mask->transform().worldToIndexCellCentered(p); };
        const Coord low = voxel(openvdb::math::minComponent(a, openvdb::math::minComponent(b, c))).offsetBy(-1);
        const Coord high = voxel(openvdb::math::maxComponent(a, openvdb::math::maxComponent(b, c))).offsetBy(1);
        for (const Coord& ijk : openvdb::CoordBBox(low, high)) {
            const bool onSurface = surface.box().isInside(ijk) && test::isOn(surface, ijk);
            if (onSurface && accessor.isValueOn(ijk)) continue; // only a miss is an error here
            ++tested;
            const Kernel::Iso_cuboid_3 cube(
                Kernel::Point_3(border(ijk.x(), 0, -1), border(ijk.y(), 1, -1), border(ijk.z(), 2, -1)),
                Kernel::Point_3(border(ijk.x(), 0, 1), border(ijk.y(), 1, 1), border(ijk.z(), 2, 1)));
            if (!CGAL::do_intersect(triangle, cube)) continue;
            missing += !accessor.isValueOn(ijk);
            notOnSurface += !onSurface;
        }
    }
    BOOST_TEST(tested > 0U);
    BOOST_TEST(missing == 0U);
    BOOST_TEST(notOnSurface == 0U);
}

BOOST_AUTO_TEST_CASE(lattice_points_are_the_nearest_to_the_exact_place)
{
    using Number = CGAL::Exact_predicates_exact_constructions_kernel::FT;
    for (const double shift : {0.0, 1000.0, -1e8}) {
        Mesh mesh = test::transformed(test::soup(9, 40, 0, 1, false), 1, Vec3d(shift, -2 * shift, shift / 3));
        const Frame frame = makeFrame(mesh, 100);
        const auto transform = makeTransform(frame);
        const auto lattice = latticePoints(mesh, frame);
        const Vec3d translation = transform->indexToWorld(Vec3d(0));
        for (std::size_t i = 0; i < mesh.points.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                const Number place = (Number(mesh.points[i][axis]) - Number(translation[axis])) /
                                     Number(transform->voxelSize()[axis]) * latticeStep;
                const double error = std::abs(CGAL::to_double(place - Number(lattice[i][axis])));
                BOOST_REQUIRE_LT(error, 1.0); // the unit by which voxels are grown
            }
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
