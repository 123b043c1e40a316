#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "cages.h"
#include <support/shapes.h>
#include <tbb/global_control.h>
#include <tools/edit/carry.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec3d;

namespace {

/// Bends upwards of the lower end of `box`, around the x axis, by `radians` at its upper end.
std::vector<Vec3d> bent(std::vector<Vec3d> points, const openvdb::BBoxd& box, double radians)
{
    const double height = box.extents().y(), middle = box.getCenter().z();
    for (Vec3d& p : points) {
        const double angle = radians * (p.y() - box.min().y()) / height, radius = height / radians;
        const double reach = radius - (p.z() - middle);
        p = {p.x(), box.min().y() + reach * std::sin(angle), middle + radius - reach * std::cos(angle)};
    }
    return points;
}

double meanDistance(const std::vector<Vec3d>& a, const std::vector<Vec3d>& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).length();
    return sum / double(a.size());
}

Vec3d affine(const Vec3d& p)
{
    return {1.5 * p.x() - 0.3 * p.y() + 2, 0.2 * p.x() + 0.8 * p.y() - 1, p.z() + 0.1 * p.x() + 3};
}

std::vector<Vec3d> carriedPose(const Mesh& rest, const std::vector<Vec3d>& posed, const Mesh& other)
{
    return carriedPoses(rest, {posed}, other).front();
}

} // namespace

BOOST_AUTO_TEST_SUITE(carry)

BOOST_AUTO_TEST_CASE(poses_that_are_carried_together_come_out_as_alone)
{
    const Mesh rest = test::sphere({0, 0, 0}, 1, 6), other = test::torus(0.5, 0.1, 40, 15); // more than a block
    const openvdb::BBoxd box = boundingBox(rest);
    const std::vector<std::vector<Vec3d>> poses{bent(rest.points, box, 1), rest.points, bent(rest.points, box, -0.5)};
    const auto together = carriedPoses(rest, poses, other);
    BOOST_TEST_REQUIRE(together.size() == 3u);
    for (std::size_t i = 0; i < 3; ++i) BOOST_CHECK(together[i] == carriedPose(rest, poses[i], other));
    BOOST_CHECK(together[1] == other.points);
    BOOST_CHECK(together[0] != together[2]);
    BOOST_TEST(carriedPoses(rest, {}, other).empty());
}

BOOST_AUTO_TEST_CASE(another_cage_poses_the_model_alike)
{
    auto& creature = test::caged("creature");
    const openvdb::BBoxd box = boundingBox(creature.model());
    const double diagonal = box.extents().length();
    const Mesh fine = creature.cage(400), coarse = creature.cage(300);
    BOOST_REQUIRE(fine.points != coarse.points);
    const Binding byFine(fine, creature.model().points, Coordinates::meanValue);
    const Binding byCoarse(coarse, creature.model().points, Coordinates::meanValue);
    const auto posedFine = bent(fine.points, box, 1), posedCoarse = bent(coarse.points, box, 1);
    const auto carried = carriedPose(fine, posedFine, coarse);
    const auto there = byFine.pose(posedFine), here = byCoarse.pose(carried);
    BOOST_TEST(meanDistance(there, creature.model().points) > 0.1 * diagonal);
    const double mean = meanDistance(there, here) / diagonal;
    BOOST_TEST_MESSAGE("carried from 400 to 300 faces: " << 100 * mean << " % of the diagonal");
    BOOST_TEST(mean < 0.01);
    const auto back = carriedPose(coarse, posedCoarse, fine);
    BOOST_TEST(meanDistance(byCoarse.pose(posedCoarse), byFine.pose(back)) < 0.01 * diagonal);
}

BOOST_AUTO_TEST_CASE(affine_poses_are_carried_exactly)
{
    const Mesh rest = test::sphere({0, 0, 0}, 1, 6);
    // The torus has more points than a block.
    for (const Mesh& other : {test::box({-2, -2, -2}, {2, 2, 2}), test::torus(0.5, 0.1, 40, 15)}) {
        std::vector<Vec3d> posed;
        for (const Vec3d& p : rest.points) posed.push_back(affine(p));
        const auto carried = carriedPose(rest, posed, other);
        for (std::size_t i = 0; i < carried.size(); ++i) {
            BOOST_TEST((carried[i] - affine(other.points[i])).length() < 1e-10);
        }
    }
}

BOOST_AUTO_TEST_CASE(points_at_the_same_place_keep_their_pose_bit_for_bit)
{
    Mesh rest = test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::box({1, 0, 0}, {2, 1, 1})); // touching
    rest.points.insert(rest.points.begin(), Vec3d(0, 0, 0));                                    // used by no face
    for (auto& quad : rest.quads) quad += openvdb::Vec4I(1);
    std::vector<Vec3d> posed = rest.points;
    for (std::size_t i = 0; i < posed.size(); ++i) posed[i] += Vec3d(0.1 * double(i), 0.01 * double(i * i), 1.0 / 3);
    Mesh other = rest;
    other.points.push_back({0.5, 0.5, 0.5});
    std::reverse(other.points.begin(), other.points.end());
    const auto carried = carriedPose(rest, posed, other);
    for (std::size_t i = 0; i < other.points.size(); ++i) {
        std::size_t first = 1; // point 0 does not count
        while (first < rest.points.size() && rest.points[first] != other.points[i]) ++first;
        if (first < rest.points.size()) BOOST_CHECK(carried[i] == posed[first]);
    }
    BOOST_TEST((carried[0] - other.points[0]).length() > 0.3);
}

BOOST_AUTO_TEST_CASE(where_nothing_moved_all_stays_bit_for_bit)
{
    Mesh rest = test::sphere({0, 0, 0}, 1, 6);
    rest.points.push_back({5, 5, 5}); // used by no face
    std::vector<Vec3d> posed = rest.points;
    posed.back() = {7, 7, 7};
    const Mesh other = test::box({-0.3, -1.0 / 3, -0.0}, {0.7, 0.2, 1e-300});
    const auto carried = carriedPose(rest, posed, other);
    BOOST_REQUIRE(carried.size() == other.points.size());
    BOOST_TEST(std::memcmp(carried.data(), other.points.data(), carried.size() * sizeof(Vec3d)) == 0);
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    const Mesh rest = test::sphere({0, 0, 0}, 1, 8), other = test::sphere({0, 0, 0}, 1.1, 24); // more than a block
    const auto posed = bent(rest.points, boundingBox(rest), 1);
    const auto result = carriedPose(rest, posed, other);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(carriedPose(rest, posed, other) == result);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_carried_is_refused)
{
    const Mesh rest = test::sphere({0, 0, 0}, 1, 6);
    auto posed = bent(rest.points, boundingBox(rest), 1);
    Mesh open = rest;
    open.quads.pop_back();
    BOOST_CHECK_THROW(carriedPose(open, posed, test::box({0, 0, 0}, {1, 1, 1})), InputError);
    posed[0].x() = std::numeric_limits<double>::quiet_NaN();
    BOOST_CHECK_THROW(carriedPose(rest, posed, rest), InputError);
    posed.pop_back();
    BOOST_CHECK_THROW(carriedPose(rest, posed, rest), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
