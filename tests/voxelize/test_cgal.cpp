#include <boost/test/unit_test.hpp>

#include <support/stop_at.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/voxelize.h>
#include <voxelize/models.h>
#include <voxelize/reference.h>

using namespace vdbcage;
using openvdb::Coord;
using openvdb::Vec3d;

BOOST_AUTO_TEST_SUITE(cgal_backend)

#ifdef VDBCAGE_WITH_CGAL_GPL

BOOST_AUTO_TEST_CASE(voxels_are_those_of_the_definition)
{
    for (const test::HardModel& model : test::hardModels()) {
        const test::Reference& reference = test::referenceOf(model);
        const openvdb::MaskGrid::Ptr mask = voxelize(model.mesh, {model.resolution, Voxelizer::cgal}).mask;
        auto accessor = mask->getConstAccessor();
        std::size_t missing = 0, extra = 0;
        for (const Coord& ijk : reference.box) {
            const bool expected = reference.solid[reference.index(ijk)], got = accessor.isValueOn(ijk);
            missing += expected && !got;
            extra += !expected && got;
        }
        BOOST_TEST(missing == 0U, model.name);
        BOOST_TEST(extra == 0U, model.name);
    }
}

BOOST_AUTO_TEST_CASE(voxels_are_those_of_the_cpu)
{
    const Mesh models[] = {test::torus(1, 0.4, 40, 20), test::bowl(1, 20), test::needles(50, 1e4),
                           test::box(Vec3d(0.5), Vec3d(70.5, 63.5, 32.5))};
    for (const Mesh& model : models) {
        for (const int resolution : {1, 70, 90}) {
            const auto expected = voxelize(model, {resolution, Voxelizer::cpu}).mask;
            BOOST_TEST(voxelize(model, {resolution, Voxelizer::cgal}).mask->tree().hasSameTopology(expected->tree()));
        }
    }
}

BOOST_AUTO_TEST_CASE(questions_can_cancel)
{
    const Mesh model = test::torus(1, 0.4, 20, 10);
    for (const int k : {0, 1, 5, 20, 50}) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(voxelize(model, {30, Voxelizer::cgal}, &stop), Cancelled);
    }
}

#else

BOOST_AUTO_TEST_CASE(a_build_without_it_says_so)
{
    BOOST_CHECK_THROW(voxelize(test::box(Vec3d(0), Vec3d(1)), {16, Voxelizer::cgal}), DeviceError);
}

#endif

BOOST_AUTO_TEST_SUITE_END()
