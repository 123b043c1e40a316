#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <set>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <support/symmetric.h>
#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/guard_model.h>
#include <vdbcage/bounding/quad_loops.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>

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

GuardOptions with(const std::vector<Joint>& joints)
{
    GuardOptions options;
    options.joints = joints;
    options.minAngleDegrees = 1;
    return options;
}

QuadLoopsOptions to(std::size_t faces)
{
    QuadLoopsOptions options;
    options.faces = faces;
    return options;
}

/// How many rings of vertices around the x axis a cage of a bar has at this place: groups that lie about in one plane.
std::size_t ringsOfVertices(const Mesh& cage, double from, double to)
{
    std::vector<double> places;
    for (const Vec3d& p : cage.points) {
        if (p[0] > from && p[0] < to) places.push_back(p[0]);
    }
    std::sort(places.begin(), places.end());
    std::size_t groups = 0;
    double last = -std::numeric_limits<double>::infinity();
    for (const double place : places) {
        if (place - last > 0.4) ++groups;
        last = place;
    }
    return groups;
}

} // namespace

BOOST_AUTO_TEST_SUITE(joints)

BOOST_AUTO_TEST_CASE(loops_get_three_rings_at_a_joint)
{
    const Bar bar;
    const Mesh surface = extractSurface(*bar.voxels);
    for (const double place : {-9.0, 0.0, 6.5}) {
        for (const bool hasAxis : {false, true}) {
            const Joint joint{{place, 0, 0}, hasAxis ? std::optional(Vec3d(1, 0, 0)) : std::nullopt};
            const BoundingGuard guard(bar.model, with({joint})), plain(bar.model, with({}));
            const Mesh cage = quadLoops(surface, guard, to(60)), other = quadLoops(surface, plain, to(60));
            BOOST_TEST(cage.triangles.empty());
            BOOST_TEST(faceCount(cage) <= 60U);
            BOOST_TEST(checkCage(cage, bar.model).bounding());
            // Three rings of quads have four rings of vertices; their radius is 3 or more.
            BOOST_TEST(ringsOfVertices(cage, place - 3.5, place + 3.5) >= 4U, "at " << place);
            BOOST_TEST(ringsOfVertices(other, place - 3.5, place + 3.5) < 4U, "without a joint at " << place);
        }
    }
}

BOOST_AUTO_TEST_CASE(symmetric_loops_get_them_on_both_sides)
{
    const Bar bar;
    GuardOptions options = with({{{-8, 0, 0}, std::nullopt}});
    options.symmetry = SymmetryPlane{0, 0};
    const BoundingGuard guard(bar.model, options);
    const Mesh surface = guard.symmetrized(extractSurface(*bar.voxels), 0.25);
    const Mesh cage = quadLoops(surface, guard, to(80));
    BOOST_TEST(test::isSymmetric(cage, *guard.symmetry()));
    for (const double place : {-8.0, 8.0}) BOOST_TEST(ringsOfVertices(cage, place - 3.5, place + 3.5) >= 4U);
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
        GuardOptions options = with({{{8, 0, 0}, std::nullopt}});
        if (isSymmetric) options.symmetry = SymmetryPlane{1, 0};
        const BoundingGuard guard(bar.model, options);
        options.joints.clear();
        const BoundingGuard plain(bar.model, options);
        const Mesh start = isSymmetric ? guard.symmetrized(surface, 0.25) : surface;
        BoundingTriquadOptions pairing;
        pairing.faces = 80;
        const Mesh cage = triquad(start, guard, pairing), other = triquad(start, plain, pairing);
        BOOST_TEST(checkCage(cage, bar.model).bounding());
        BOOST_TEST(near(cage, 8) > near(other, 8));
    }
}

BOOST_AUTO_TEST_CASE(density_around_joints_counts_once_however_many_there_are)
{
    const Bar bar;
    GuardOptions options = with({{{8, 0, 0}, std::nullopt}, {{8.2, 0, 0}, std::nullopt}, {{-8, 0, 0}, std::nullopt}});
    options.symmetry = SymmetryPlane{0, 0};
    const BoundingGuard guard(bar.model, options);
    const detail::GuardModel& model = detail::modelOf(guard);
    const double at = model.distanceWeight(model.scaled({8, 2.4, 0})),
                 far = model.distanceWeight(model.scaled({0, 2.4, 0}));
    BOOST_TEST(at == 8); // the cube of 2
    BOOST_TEST(far == 1);
}

BOOST_AUTO_TEST_CASE(bad_joints_are_refused)
{
    const Bar bar;
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    const Joint bad[] = {{{nan, 0, 0}, std::nullopt},
                         {{0, 30, 0}, std::nullopt},
                         {{0, 0, 0}, Vec3d(0.0)},
                         {{0, 0, 0}, Vec3d(0, infinite, 0)}};
    for (const Joint& joint : bad) BOOST_CHECK_THROW(BoundingGuard(bar.model, with({joint})), InputError);
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter_and_every_question_can_cancel)
{
    const Bar bar;
    const Mesh surface = extractSurface(*bar.voxels);
    const BoundingGuard guard(bar.model, with({{{3, 0, 0}, std::nullopt}}));
    const Mesh many = quadLoops(surface, guard, to(60));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Mesh single = quadLoops(surface, guard, to(60));
    BOOST_TEST((many.points == single.points && many.quads == single.quads));
    constexpr int start = 1000000;
    test::StopAt watcher(start);
    quadLoops(surface, guard, to(60), &watcher);
    const int all = test::questions(watcher, start);
    for (const int k : {0, all / 7, all / 3, all / 2, all - 1}) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(quadLoops(surface, guard, to(60), &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
