#include <boost/test/unit_test.hpp>

#include <cmath>

#include <tools/report/quad_quality.h>

using namespace vdbcage;
using openvdb::Vec3d;
using report::QuadQuality;
using report::quadQuality;

namespace {

/// n by m quads of 1 by `height`, closed around in the first direction to a tube if `isTube`.
Mesh grid(unsigned n, unsigned m, double height, bool isTube)
{
    Mesh mesh;
    const unsigned columns = isTube ? n : n + 1;
    for (unsigned j = 0; j <= m; ++j) {
        for (unsigned i = 0; i < columns; ++i) {
            const double angle = 2 * std::acos(-1.0) * i / n, radius = 0.5 / std::sin(std::acos(-1.0) / n);
            mesh.points.push_back(isTube ? Vec3d(radius * std::cos(angle), radius * std::sin(angle), height * j)
                                         : Vec3d(i, height * j, 0));
        }
    }
    for (unsigned j = 0; j < m; ++j) {
        for (unsigned i = 0; i < n; ++i) {
            const unsigned next = (i + 1) % columns;
            mesh.quads.emplace_back(j * columns + i, j * columns + next, (j + 1) * columns + next,
                                    (j + 1) * columns + i);
        }
    }
    return mesh;
}

Mesh cube()
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    mesh.quads = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(quad_quality)

BOOST_AUTO_TEST_CASE(a_cube_has_three_loops)
{
    const report::QuadQuality quality = report::quadQuality(cube());
    BOOST_TEST(quality.share == 1);
    BOOST_TEST(quality.irregular == 1);
    BOOST_TEST(quality.valences.size() == 1U);
    BOOST_TEST(quality.valences.at(3) == 8U);
    BOOST_TEST(quality.cornerMean == 0);
    BOOST_TEST(quality.foldMean == 0);
    BOOST_TEST(quality.loops == 3U);
    BOOST_TEST(quality.inLoops == 1);
    BOOST_TEST(quality.aspect == 1);
}

BOOST_AUTO_TEST_CASE(rings_of_a_tube_are_loops_and_its_staves_are_not)
{
    const report::QuadQuality tube = report::quadQuality(grid(6, 5, 2, true));
    BOOST_TEST(tube.loops == 5U);
    BOOST_TEST(tube.inLoops == 1);
    BOOST_TEST(tube.aspect == 2, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(tube.irregular == 2.0 / 6); // those on both rims have three edges
    BOOST_TEST(report::quadQuality(grid(6, 5, 1, false)).loops == 0U);
    BOOST_TEST(report::quadQuality(grid(6, 5, 1, false)).inLoops == 0);
    // 30 quads in one ring are more than 4 times the root of 30.
    BOOST_TEST(report::quadQuality(grid(30, 1, 1, true)).loops == 0U);
}

BOOST_AUTO_TEST_CASE(a_triangle_ends_a_polychord)
{
    Mesh mesh = cube();
    const openvdb::Vec4I cut = mesh.quads.back();
    mesh.quads.pop_back();
    mesh.triangles = {{cut[0], cut[1], cut[2]}, {cut[0], cut[2], cut[3]}};
    const report::QuadQuality quality = report::quadQuality(mesh);
    BOOST_TEST(quality.loops == 1U);
    BOOST_TEST(quality.inLoops == 4.0 / 5);
    BOOST_TEST(quality.share == 5.0 / 7);
    BOOST_TEST(quality.valences.at(4) == 2U);
}

BOOST_AUTO_TEST_CASE(corners_and_folds_are_measured)
{
    // A rhombus of 60 degrees, and a square bent by 90 degrees about a diagonal.
    Mesh mesh;
    const double h = std::sqrt(0.75), d = std::sqrt(0.5);
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {1.5, h, 0}, {0.5, h, 0}};
    mesh.quads = {{0, 1, 2, 3}};
    const report::QuadQuality rhombus = report::quadQuality(mesh);
    BOOST_TEST(rhombus.cornerMean == 30, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(rhombus.corner95th == 30, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(rhombus.fold95th < 1e-6);
    mesh.points = {{-d, 0, 0}, {0, -d, 0}, {d, 0, 0}, {0, 0, d}};
    BOOST_TEST(report::quadQuality(mesh).foldMean == 90, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(without_quads_all_is_zero_but_vertices)
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
    mesh.triangles = {{0, 1, 2}};
    const report::QuadQuality quality = report::quadQuality(mesh);
    BOOST_TEST(quality.valences.at(2) == 3U);
    BOOST_TEST(quality.irregular == 1);
    BOOST_TEST(quality.share == 0);
    BOOST_TEST(quality.inLoops == 0);
    BOOST_TEST(report::quadQuality({}).valences.empty());
}

BOOST_AUTO_TEST_SUITE_END()
