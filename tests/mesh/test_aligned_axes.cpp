#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include <openvdb/math/Quat.h>
#include <support/shapes.h>
#include <vdbcage/mesh/detail/aligned_axes.h>

using namespace vdbcage;
using detail::AlignedAxes;
using detail::alignedAxes;
using openvdb::Mat3d;
using openvdb::Vec3d;

namespace {

Mat3d randomRotation(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    openvdb::math::Quat<double> q(normal(random), normal(random), normal(random), normal(random));
    q.normalize();
    return Mat3d(q);
}

Mesh rotated(Mesh mesh, const Mat3d& rotation)
{
    for (Vec3d& p : mesh.points) p = rotation * p;
    return mesh;
}

/// What the faces are seen of, from the three axes.
double seenArea(const Mesh& mesh, const Mat3d& rows)
{
    double sum = 0;
    for (const openvdb::Vec3I& t : triangulate(mesh)) {
        const Vec3d &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
        const Vec3d seen = rows * (b - a).cross(c - a);
        sum += std::abs(seen[0]) + std::abs(seen[1]) + std::abs(seen[2]);
    }
    return sum;
}

Mesh figure()
{
    const Mesh body = test::sphere({0, 0, 0}, 1, 8);
    return test::joined(test::joined(body, test::box({0.5, -0.2, -0.2}, {2, 0.2, 0.2})), test::torus(2, 0.2, 20, 6));
}

} // namespace

BOOST_AUTO_TEST_SUITE(aligned_axes)

BOOST_AUTO_TEST_CASE(no_axes_of_many_are_better)
{
    std::mt19937 random(1);
    for (const Mesh& shape : {figure(), test::torus(1, 0.3, 20, 8), test::box({0, 0, 0}, {1, 2, 3})}) {
        const Mesh model = rotated(shape, randomRotation(random));
        const AlignedAxes axes = alignedAxes(model);
        BOOST_CHECK(axes.rows.det() > 0);
        BOOST_CHECK((axes.rows * axes.rows.transpose()).eq(Mat3d::identity(), 1e-12));
        const double area = seenArea(model, axes.rows);
        BOOST_TEST(area / seenArea(model, Mat3d::identity()) == axes.share, boost::test_tools::tolerance(1e-3));
        for (int i = 0; i < 2000; ++i) BOOST_TEST(area <= seenArea(model, randomRotation(random)) * (1 + 1e-3));
    }
}

BOOST_AUTO_TEST_CASE(boxes_are_square_to_their_axes)
{
    std::mt19937 random(2);
    const Mesh boxes = test::joined(test::box({0, 0, 0}, {3, 1, 0.1}), test::box({0, 0, 0}, {0.1, 2.5, 1}));
    for (int i = 0; i < 50; ++i) {
        const Mesh model = rotated(boxes, randomRotation(random));
        const AlignedAxes axes = alignedAxes(model);
        const Vec3d size = boundingBox(rotated(model, axes.rows)).extents();
        BOOST_TEST(size[0] * size[1] * size[2] == 3 * 2.5 * 1, boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_CASE(axes_of_slivers_are_axes)
{
    std::mt19937 random(4);
    for (const double width : {1e-6, 1e-12, 1e-30, 1e-200}) { // their areas are smaller still
        Mesh sliver;
        sliver.points = {{0, 0, 0}, {1, 0, 0}, {0.5, width, 0}};
        sliver.triangles = {{0, 1, 2}};
        const AlignedAxes axes = alignedAxes(rotated(sliver, randomRotation(random)));
        BOOST_CHECK((axes.rows * axes.rows.transpose()).eq(Mat3d::identity(), 1e-9));
    }
}

BOOST_AUTO_TEST_CASE(an_axis_that_is_kept_stays)
{
    std::mt19937 random(3);
    const Mesh model = rotated(figure(), randomRotation(random));
    for (const int kept : {0, 1, 2}) {
        const AlignedAxes axes = alignedAxes(model, kept);
        BOOST_CHECK(axes.rows.row(kept) == Mat3d::identity().row(kept));
        const double area = seenArea(model, axes.rows);
        for (int i = 0; i < 360; ++i) {
            const Mat3d turn = openvdb::math::rotation<Mat3d>(static_cast<openvdb::math::Axis>(kept), 0.01 * i);
            BOOST_TEST(area <= seenArea(model, turn) * (1 + 1e-3));
        }
    }
}

BOOST_AUTO_TEST_CASE(what_lies_along_the_axes_stays_so)
{
    Mesh twice = test::box({-1, 0, 5}, {1, 2, 8});
    const Mesh inward = twice;
    for (openvdb::Vec4I q : inward.quads) twice.quads.emplace_back(q[3], q[2], q[1], q[0]); // both sides: a soup
    for (const Mesh& model : {test::box({0, 0, 0}, {1, 1, 1}), twice}) {
        const AlignedAxes axes = alignedAxes(model);
        BOOST_TEST(axes.share == 1);
        BOOST_CHECK(axes.rows == Mat3d::identity());
    }
}

BOOST_AUTO_TEST_SUITE_END()
