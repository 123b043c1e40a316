#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

#include <deform/cages.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/distortion.h>

using namespace vdbcage;
using openvdb::Vec3d;

namespace {

std::vector<Vec3d> posedBy(const openvdb::Mat3d& map, const Mesh& model)
{
    return test::mapped(model.points, [&](const Vec3d& p) { return map * p + Vec3d(3, -2, 1); });
}

/// A square in the xy plane, of four triangles of different shapes.
Mesh square()
{
    Mesh mesh;
    mesh.points = {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(1, 1, 0), Vec3d(0, 1, 0), Vec3d(0.3, 0.6, 0)};
    mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(distortion)

BOOST_AUTO_TEST_CASE(motions_distort_nothing)
{
    openvdb::Mat3d turn;
    turn.setToRotation(Vec3d(1, 2, 3).unit(), 1.1);
    const Mesh model = test::randomCage(test::Kind::both, 3);
    const Distortion result = poseDistortion(model, posedBy(turn, model));
    BOOST_TEST(std::abs(result.mean - 1) < 1e-12);
    BOOST_TEST(std::abs(result.percentile99 - 1) < 1e-12);
    BOOST_REQUIRE(result.volume.has_value());
    BOOST_TEST(std::abs(*result.volume - 1) < 1e-12);
}

BOOST_AUTO_TEST_CASE(stretches_along_two_axes)
{
    openvdb::Mat3d turn;
    turn.setToRotation(Vec3d(1, -2, 0.5).unit(), 0.7);
    const Mesh model = square();
    const Distortion result =
        poseDistortion(model, posedBy(turn * openvdb::Mat3d(2.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 9.0), model));
    BOOST_TEST(std::abs(result.mean - 2 * (4 + 0.25) / 4) < 1e-12);
    BOOST_TEST(std::abs(result.percentile99 - 2 * (4 + 0.25) / 4) < 1e-12);
    BOOST_TEST(!result.volume.has_value()); // it is open
}

BOOST_AUTO_TEST_CASE(mean_and_percentile_are_by_area)
{
    Mesh model; // a hundred squares in a row, of which the last is stretched, then the last two
    for (int i = 0; i <= 100; ++i) {
        model.points.emplace_back(i, 0, 0);
        model.points.emplace_back(i, 1, 0);
        if (i == 100) break;
        const auto at = static_cast<openvdb::Index32>(2 * i);
        model.quads.emplace_back(at, at + 2, at + 3, at + 1);
    }
    const auto stretched = [&](int count) {
        std::vector<Vec3d> posed = model.points;
        for (Vec3d& p : posed) p.x() += std::max(0.0, p.x() - (100 - count)); // twice as wide
        return poseDistortion(model, posed);
    };
    const double energy = (4 + 1 + 0.25 + 1) / 4;
    BOOST_TEST(std::abs(stretched(1).mean - (0.99 + 0.01 * energy)) < 1e-12);
    BOOST_TEST(std::abs(stretched(1).percentile99 - 1) < 1e-12);
    BOOST_TEST(std::abs(stretched(2).percentile99 - energy) < 1e-12);
}

BOOST_AUTO_TEST_CASE(scaling_changes_the_volume)
{
    const Mesh model = test::randomCage(test::Kind::triangles, 4);
    const Distortion result =
        poseDistortion(model, posedBy(openvdb::Mat3d(2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0), model));
    BOOST_REQUIRE(result.volume.has_value());
    BOOST_TEST(std::abs(*result.volume - 8) < 1e-12);
    BOOST_TEST(std::abs(result.mean - (8 + 0.5) / 4) < 1e-12);
}

BOOST_AUTO_TEST_CASE(what_has_no_area)
{
    Mesh model = square();
    model.triangles.emplace_back(0, 1, 1); // left out
    std::vector<Vec3d> posed = model.points;
    BOOST_TEST(std::abs(poseDistortion(model, posed).mean - 1) < 1e-12);
    posed[4] = Vec3d(0.5, 0, 0); // the first triangle is posed flat
    BOOST_TEST(std::isinf(poseDistortion(model, posed).mean));
    posed.pop_back();
    BOOST_CHECK_THROW(poseDistortion(model, posed), InputError);
    posed.emplace_back(0, 0, std::numeric_limits<double>::infinity());
    BOOST_CHECK_THROW(poseDistortion(model, posed), InputError);
    for (Vec3d& p : model.points) p = Vec3d(p.x(), 0, 0);
    BOOST_CHECK_THROW(poseDistortion(model, model.points), InputError);
    BOOST_CHECK_THROW(poseDistortion(Mesh(), {}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
