#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <support/symmetric.h>
#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/quads/joint_rings.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

#include "bounding/support/targets.h"

using namespace vdbcage;
using openvdb::Vec3d;

namespace {

/// A round bar along x, 40 long and 5 wide, and voxels of it.
struct Bar {
    Mesh model = test::sphere({0, 0, 0}, 1, 24);
    openvdb::MaskGrid::Ptr voxels = openvdb::MaskGrid::create();

    Bar()
    {
        for (Vec3d& p : model.points) p = Vec3d(20 * std::cbrt(p[0]), 2.4 * p[1], 2.4 * p[2]);
        voxels->fill(openvdb::CoordBBox({-21, -3, -3}, {21, 3, 3}), true);
        voxels->tree().voxelizeActiveTiles();
    }
};

/// For slender triangles.
GuardOptions guarding(const std::optional<SymmetryPlane>& plane = {})
{
    GuardOptions options;
    options.minAngleDegrees = 1;
    options.symmetry = plane;
    return options;
}

FaceWishes with(const std::vector<Joint>& joints, const BoundingGuard& guard, double density = 2)
{
    return FaceWishes(guard, {{}, joints, density});
}

constexpr double radius = 2.4; // of the bar

/// How many rings of quads a cage of a bar has at this place: between two rings of vertices, groups that lie about in
/// one plane, that are at most twice as wide as the bar. The middle is at most its radius away.
std::size_t ringsAt(const Mesh& cage, double place)
{
    struct Group {
        double first, last, width;
    };
    std::vector<Vec3d> points = cage.points;
    std::sort(points.begin(), points.end(), [](const Vec3d& a, const Vec3d& b) { return a[0] < b[0]; });
    std::vector<Group> groups;
    for (const Vec3d& p : points) {
        if (groups.empty() || p[0] - groups.back().last > 0.4) groups.push_back({p[0], p[0], 0});
        groups.back().last = p[0];
        groups.back().width = std::max(groups.back().width, std::hypot(p[1], p[2]));
    }
    std::size_t rings = 0;
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
        const Group &a = groups[i], &b = groups[i + 1];
        const double middle = 0.25 * (a.first + a.last + b.first + b.last);
        rings += std::abs(middle - place) <= radius && std::max(a.width, b.width) <= 2 * radius;
    }
    return rings;
}

/// The rings that are counted at a joint of a surface of voxels.
std::size_t countedRings(const Bar& bar, const openvdb::CoordBBox& voxels, const Joint& joint)
{
    auto mask = openvdb::MaskGrid::create();
    mask->fill(voxels, true);
    mask->tree().voxelizeActiveTiles();
    const BoundingGuard guard(bar.model, guarding());
    const detail::GuardedMesh surface(extractSurface(*mask), detail::modelOf(guard), detail::GuardedMesh::Quads::split,
                                      with({joint}, guard));
    const detail::QuadTable table(surface);
    return detail::JointRings(surface, table).count().at(0);
}

} // namespace

BOOST_AUTO_TEST_SUITE(joints)

BOOST_AUTO_TEST_CASE(loops_get_three_rings_at_a_joint)
{
    const Bar bar;
    const Mesh surface = extractSurface(*bar.voxels);
    const BoundingGuard guard(bar.model, guarding());
    const Mesh other = quadLoops(surface, guard, test::loops(60));
    for (const double place : {-9.0, 0.0, 6.5}) {
        BOOST_TEST(ringsAt(other, place) < 3U, "without a joint at " << place);
        for (const bool hasAxis : {false, true}) {
            const Joint joint{{place, 0, 0}, hasAxis ? std::optional(Vec3d(1, 0, 0)) : std::nullopt};
            const Mesh cage = quadLoops(surface, guard, test::loops(60), with({joint}, guard));
            BOOST_TEST(cage.triangles.empty());
            BOOST_TEST(faceCount(cage) <= 60U);
            BOOST_TEST(checkCage(cage, bar.model).bounding());
            BOOST_TEST(ringsAt(cage, place) >= 3U, "at " << place);
        }
    }
}

BOOST_AUTO_TEST_CASE(rings_are_near_the_joint_and_about_as_wide_as_the_limb)
{
    const Bar bar;
    const openvdb::CoordBBox narrow({-21, -3, -3}, {21, 3, 3}), wide({-21, -6, -6}, {21, 6, 6});
    const Joint along{{0, 0, 0}, Vec3d(1, 0, 0)}, across{{0, 0, 0}, Vec3d(0.3, 1, 0)};
    BOOST_TEST(countedRings(bar, narrow, {{0, 0, 0}, std::nullopt}) == 5U); // at -2 to 2
    BOOST_TEST(countedRings(bar, narrow, along) == 5U);
    BOOST_TEST(countedRings(bar, narrow, {{0.45, 0, 0}, Vec3d(1, 0, 0)}) == 4U); // at -1 to 2
    BOOST_TEST(countedRings(bar, wide, along) == 0U);
    BOOST_TEST(countedRings(bar, narrow, across) == 0U);
}

BOOST_AUTO_TEST_CASE(a_limb_is_as_wide_as_the_model_across_its_axis)
{
    const Bar bar;
    const Vec3d slanted(3, 4, 0);
    const BoundingGuard guard(bar.model, guarding());
    const FaceWishes wishes = with({{{3, 0.5, 0}, std::nullopt}, {{3, 0, 0}, slanted}}, guard);
    const double unit = detail::modelOf(guard).scaled({1, 0, 0})[0];
    const auto& limbs = detail::wishesOf(wishes).limbs();
    const detail::Limb &found = limbs.at(0), &given = limbs.at(1);
    BOOST_TEST(std::abs(found.axis[0]) > 0.95);
    BOOST_TEST(found.radius == radius * unit, boost::test_tools::tolerance(0.1));
    BOOST_TEST((given.axis - 0.2 * slanted).length() < 1e-12);
    BOOST_TEST(given.radius > 1.2 * radius * unit);
}

BOOST_AUTO_TEST_CASE(symmetric_loops_get_them_on_both_sides)
{
    const Bar bar;
    const BoundingGuard guard(bar.model, guarding(SymmetryPlane{0, 0}));
    const Mesh surface = guard.symmetrized(extractSurface(*bar.voxels), 0.25);
    const Mesh cage = quadLoops(surface, guard, test::loops(80), with({{{-8, 0, 0}, std::nullopt}}, guard));
    BOOST_TEST(test::isSymmetric(cage, *guard.symmetry()));
    for (const double place : {-8.0, 8.0}) BOOST_TEST(ringsAt(cage, place) >= 3U);
}

BOOST_AUTO_TEST_CASE(other_cages_have_no_rings_but_more_faces)
{
    const Bar bar;
    const Mesh surface = extractSurface(*bar.voxels);
    const auto near = [](const Mesh& cage, double place) {
        std::size_t count = 0;
        for (const auto& t : triangulate(cage)) {
            const Vec3d middle = (cage.points[t[0]] + cage.points[t[1]] + cage.points[t[2]]) / 3;
            count += std::abs(middle[0] - place) < 4;
        }
        return count;
    };
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard(bar.model, guarding(isSymmetric ? std::optional(SymmetryPlane{1, 0}) : std::nullopt));
        const FaceWishes wishes = with({{{8, 0, 0}, std::nullopt}}, guard);
        const Mesh start = isSymmetric ? guard.symmetrized(surface, 0.25) : surface;
        BoundingTriquadOptions pairing;
        pairing.faces = 80;
        const Mesh cage = triquad(start, guard, pairing, wishes), other = triquad(start, guard, pairing);
        BOOST_TEST(checkCage(cage, bar.model).bounding());
        BOOST_TEST(near(cage, 8) > near(other, 8));
    }
}

BOOST_AUTO_TEST_CASE(density_around_joints_counts_once_however_many_there_are)
{
    const Bar bar;
    const std::vector<Joint> three{{{8, 0, 0}, std::nullopt}, {{8.2, 0, 0}, std::nullopt}, {{-8, 0, 0}, std::nullopt}};
    const BoundingGuard guard(bar.model, guarding(SymmetryPlane{0, 0}));
    const detail::GuardModel& model = detail::modelOf(guard);
    const FaceWishes wishes = with(three, guard);
    const double at = detail::wishesOf(wishes).distanceWeight(model.scaled({8, 2.4, 0})),
                 far = detail::wishesOf(wishes).distanceWeight(model.scaled({0, 2.4, 0}));
    BOOST_TEST(at == 8); // the cube of 2
    BOOST_TEST(far == 1);
    BOOST_TEST(detail::wishesOf(wishes).hasDensity());
    BOOST_TEST(!detail::wishesOf(with(three, guard, 1)).hasDensity());
    BOOST_TEST(!detail::wishesOf(FaceWishes()).hasDensity());
}

BOOST_AUTO_TEST_CASE(bad_joints_are_refused)
{
    const Bar bar;
    const BoundingGuard guard(bar.model, guarding());
    BOOST_CHECK_THROW(with({}, guard, 0.5), InputError);
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    const Joint bad[] = {{{nan, 0, 0}, std::nullopt},
                         {{0, 30, 0}, std::nullopt},
                         {{0, 0, 0}, Vec3d(0.0)},
                         {{0, 0, 0}, Vec3d(0, infinite, 0)}};
    for (const Joint& joint : bad) BOOST_CHECK_THROW(with({joint}, guard), InputError);
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter_and_every_question_can_cancel)
{
    const Bar bar;
    const Mesh surface = extractSurface(*bar.voxels);
    const BoundingGuard guard(bar.model, guarding());
    const FaceWishes wishes = with({{{3, 0, 0}, std::nullopt}}, guard);
    constexpr int start = 1000000;
    test::StopAt watcher(start);
    const Mesh many = quadLoops(surface, guard, test::loops(60), wishes, &watcher);
    const int all = test::questions(watcher, start);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Mesh single = quadLoops(surface, guard, test::loops(60), wishes);
    BOOST_TEST((many.points == single.points && many.quads == single.quads));
    for (const int k : {0, all / 7, all / 3, all / 2, all - 1}) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(quadLoops(surface, guard, test::loops(60), wishes, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
