#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>

#include <support/stop_at.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/voxelize/interior.h>
#include <vdbcage/voxelize/voxelize.h>
#include <voxelize/models.h>
#include <voxelize/reference.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::HardModel;

namespace {

/// A wavy surface over the unit square, seen from above.
Mesh cloth(int cells)
{
    Mesh mesh;
    const auto width = static_cast<openvdb::Index32>(cells + 1);
    for (int y = 0; y <= cells; ++y) {
        for (int x = 0; x <= cells; ++x) {
            const double u = double(x) / cells, v = double(y) / cells;
            mesh.points.emplace_back(u, v, 0.03 * std::sin(9 * u) * std::cos(7 * v));
        }
    }
    for (openvdb::Index32 y = 0; y + 1 < width; ++y) {
        for (openvdb::Index32 x = 0; x + 1 < width; ++x) {
            const openvdb::Index32 a = y * width + x;
            mesh.quads.emplace_back(a, a + 1, a + width + 1, a + width);
        }
    }
    return mesh;
}

/// rayAgreement() by its definition: every ray against every triangle.
double agreementByDefinition(const Mesh& model)
{
    const std::vector<openvdb::Vec3i> lattice = detail::latticePoints(model, detail::makeFrame(model, 64));
    std::size_t crossed = 0, odd = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (int i = 0; i <= 64; ++i) {
            for (int j = 0; j <= 64; ++j) {
                test::Vector end;
                end[axis] = test::Int128(66) * detail::latticeStep;
                end[(axis + 1) % 3] = test::Int128(i) * detail::latticeStep;
                end[(axis + 2) % 3] = test::Int128(j) * detail::latticeStep;
                std::size_t count = 0;
                for (const auto& t : triangulate(model)) {
                    test::Triangle triangle;
                    for (int k = 0; k < 3; ++k) {
                        const openvdb::Vec3i& p = lattice[t[k]];
                        triangle[static_cast<std::size_t>(k)] = {p[0], p[1], p[2]};
                    }
                    count += test::crosses(triangle, end, axis);
                }
                crossed += count > 0;
                odd += count % 2;
            }
        }
    }
    return crossed == 0 ? 1 : 1 - double(odd) / double(crossed);
}

std::size_t voxelsOf(const Mesh& model, Interior interior)
{
    VoxelizeOptions options;
    options.resolution = 48;
    options.interior = interior;
    return voxelize(model, options).mask->activeVoxelCount();
}

bool isInside(const Mesh& model, Interior interior, const Vec3d& at)
{
    VoxelizeOptions options;
    options.resolution = 48;
    options.interior = interior;
    const auto mask = voxelize(model, options).mask;
    return mask->tree().isValueOn(mask->transform().worldToIndexCellCentered(at));
}

} // namespace

BOOST_AUTO_TEST_SUITE(interior)

BOOST_DATA_TEST_CASE(rays_agree_as_the_definition_says, boost::unit_test::data::make(test::hardModels()), model)
{
    BOOST_TEST(rayAgreement(model.mesh) == agreementByDefinition(model.mesh));
}

BOOST_AUTO_TEST_CASE(rays_agree_about_closed_models_and_the_less_the_more_is_open)
{
    const Mesh ball = test::sphere(Vec3d(0), 1, 24);
    for (const Mesh& closed : {ball, test::torus(1, 0.4, 40, 20), test::joined(ball, test::torus(1, 0.4, 40, 20))}) {
        BOOST_TEST(rayAgreement(closed) == 1);
    }
    BOOST_TEST(rayAgreement(test::bowl(1, 24)) == 0.5, boost::test_tools::tolerance(0.1));
    BOOST_TEST(rayAgreement(cloth(40)) < 0.1);
    Mesh opened = ball;
    opened.triangles.clear(); // the caps of the poles
    opened.quads.resize(opened.quads.size() - opened.quads.size() / 20);
    BOOST_TEST(rayAgreement(opened) < 1);
    BOOST_TEST(rayAgreement(opened) > 0.8);
}

BOOST_AUTO_TEST_CASE(a_bowl_is_filled_or_its_wall_and_a_closed_model_is_the_same)
{
    const Mesh bowl = test::bowl(1, 24), ball = test::sphere(Vec3d(0), 1, 24);
    const Vec3d hollow(0.1, 0.05, -0.4), wall(0, 0, -1);
    BOOST_TEST(isInside(bowl, Interior::solid, hollow));
    BOOST_TEST(!isInside(bowl, Interior::shell, hollow));
    BOOST_TEST(isInside(bowl, Interior::shell, wall));
    BOOST_TEST(isInside(ball, Interior::shell, hollow)); // nothing leads there
    BOOST_TEST(voxelsOf(ball, Interior::shell) == voxelsOf(ball, Interior::solid));
}

BOOST_AUTO_TEST_CASE(every_voxelizer_makes_the_same_shell)
{
    VoxelizeOptions options;
    options.resolution = 40;
    options.interior = Interior::shell;
    const Mesh model = test::joined(test::bowl(1, 16), cloth(12));
    options.voxelizer = Voxelizer::cpu;
    const auto mask = voxelize(model, options).mask;
    options.voxelizer = Voxelizer::gl;
    BOOST_TEST(voxelize(model, options).mask->tree().hasSameTopology(mask->tree()));
#ifdef VDBCAGE_WITH_CGAL_GPL
    options.voxelizer = Voxelizer::cgal;
    BOOST_TEST(voxelize(model, options).mask->tree().hasSameTopology(mask->tree()));
#endif
}

BOOST_AUTO_TEST_CASE(automatic_takes_the_shell_of_sheets_only_and_says_so)
{
    VoxelizeOptions options;
    options.resolution = 48;
    BOOST_TEST(!voxelize(cloth(20), options).report.agreement.has_value());
    options.interior = Interior::automatic;
    const auto taken = [&](const Mesh& model) {
        const VoxelizeReport report = voxelize(model, options).report;
        BOOST_TEST(report.agreement.value() == rayAgreement(model));
        return report.interior;
    };
    BOOST_TEST((taken(cloth(20)) == Interior::shell));
    BOOST_TEST((taken(test::bowl(1, 24)) == Interior::solid));
    BOOST_TEST((taken(test::sphere(Vec3d(0), 1, 12)) == Interior::solid));
}

BOOST_AUTO_TEST_CASE(the_share_of_rays_can_be_cancelled_and_refuses_what_voxels_refuse)
{
    BOOST_CHECK_THROW((void)rayAgreement(Mesh()), InputError);
    test::StopAt stop(0);
    BOOST_CHECK_THROW((void)rayAgreement(test::sphere(Vec3d(0), 1, 12), &stop), Cancelled);
}

BOOST_AUTO_TEST_SUITE_END()
