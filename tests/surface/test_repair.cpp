#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <set>

#include <tbb/global_control.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/surface/repair.h>

#include "support/shapes.h"
#include "support/stop_at.h"

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::Index32;
using openvdb::Vec3d;
using openvdb::Vec3I;

namespace {

/// Where the build has no repair, none is to be tested.
boost::test_tools::assertion_result withRepair(boost::unit_test::test_unit_id)
{
    return hasRepair();
}

CageCheck verdict(const Mesh& cage)
{
    return checkCage(cage, box({-.1, -.1, -.1}, {.1, .1, .1}));
}

Mesh triangulated(Mesh mesh)
{
    mesh.triangles = triangulate(mesh);
    mesh.quads.clear();
    return mesh;
}

/// The places of each face's corners, whatever the order of points and faces.
std::multiset<std::set<std::vector<double>>> placesOfFaces(const Mesh& mesh)
{
    std::multiset<std::set<std::vector<double>>> faces;
    const auto add = [&](const auto& corners, int size) {
        std::set<std::vector<double>> places;
        for (int i = 0; i < size; ++i) {
            const Vec3d& p = mesh.points[corners[i]];
            places.insert({p[0], p[1], p[2]});
        }
        faces.insert(places);
    };
    for (const Vec3I& t : mesh.triangles) add(t, 3);
    for (const openvdb::Vec4I& q : mesh.quads) add(q, 4);
    return faces;
}

/// A mended cage that the check takes for valid; its report is held to what the check says.
RepairedCage mended(const Mesh& cage)
{
    RepairedCage result = repair(cage);
    const CageCheck check = verdict(result.cage);
    BOOST_TEST(check.valid());
    BOOST_TEST(result.report.selfIntersectionsAfter == check.selfIntersections);
    BOOST_TEST(result.report.after.faces == faceCount(result.cage));
    BOOST_TEST(result.report.after.parts == check.components);
    BOOST_TEST(result.report.before.faces == faceCount(cage));
    BOOST_TEST(std::abs(result.report.after.volume / check.cageVolume - 1) < 1e-3); // quads: the mean of both diagonals
    return result;
}

/// A sphere of which some points were pulled through the other side.
Mesh pulledThrough(const Mesh& sphere, int count)
{
    Mesh cage = sphere;
    std::mt19937 random(3);
    std::vector<std::size_t> order(cage.points.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    for (std::size_t i = order.size(); i-- > 1;) std::swap(order[i], order[random() % (i + 1)]);
    for (int i = 0; i < count; ++i) cage.points[order[static_cast<std::size_t>(i)]] *= -1.3;
    return cage;
}

} // namespace

BOOST_AUTO_TEST_SUITE(repairing, *boost::unit_test::precondition(withRepair))

BOOST_AUTO_TEST_CASE(a_valid_cage_comes_back_as_it_came)
{
    Mesh withUnused = sphere({0, 0, 0}, 1, 8);
    withUnused.points.emplace_back(7, 7, 7);
    const Mesh nested = joined(sphere({0, 0, 0}, 1, 8), sphere({0, 0, 0}, .5, 6));
    for (const Mesh& cage : {sphere({0, 0, 0}, 1, 8), box({0, 0, 0}, {1, 2, 3}), withUnused, nested}) {
        const RepairedCage result = mended(cage);
        BOOST_TEST(sameMesh(result.cage, cage));
        BOOST_TEST(result.report.before.area == result.report.after.area);
    }
}

BOOST_AUTO_TEST_CASE(points_that_were_pulled_through_go_back)
{
    for (const Mesh& whole : {sphere({0, 0, 0}, 1, 12), triangulated(sphere({0, 0, 0}, 1, 12))}) {
        const double volume = verdict(whole).cageVolume;
        for (const int count : {1, 12, 40}) {
            Mesh cage = pulledThrough(whole, count);
            cage.triangles.push_back(cage.triangles[7]); // and a face is there twice
            const RepairedCage result = mended(cage);
            BOOST_TEST_CONTEXT(count << " points")
            {
                BOOST_TEST(result.report.removedFaces == 1U);
                BOOST_TEST(result.cage.quads.size() == whole.quads.size());
                BOOST_TEST(faceCount(result.cage) == faceCount(whole));
                BOOST_TEST(result.report.movedPoints >= std::size_t(count));
                BOOST_TEST(result.report.movedPoints <= std::size_t(2 * count));
                BOOST_TEST(result.report.selfIntersectionsBefore > 0U);
                BOOST_TEST(verdict(result.cage).cageVolume > (1 - .002 * count) * volume);
                BOOST_TEST(verdict(result.cage).cageVolume < 1.001 * volume);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(other_faces_stay_where_they_are)
{
    const Mesh far = sphere({9, 0, 0}, 1, 8);
    const Mesh cage = joined(far, joined(sphere({0, 0, 0}, 1, 8), sphere({1.2, .1, .2}, 1, 8)));
    const auto before = placesOfFaces(far), after = placesOfFaces(mended(cage).cage);
    BOOST_TEST(std::includes(after.begin(), after.end(), before.begin(), before.end()));
}

BOOST_AUTO_TEST_CASE(boxes_that_overlap_become_their_union)
{
    struct Case {
        Vec3d low, high; // of a box beside the unit cube
        double volume, area;
    };
    const Case cases[] = {
        {{.5, .25, .25}, {1.5, .75, .75}, 1.125, 7},  // into it
        {{.5, .5, .5}, {1.5, 1.5, 1.5}, 1.875, 10.5}, // at a corner
        {{.5, 0, 0}, {2, 1, 1}, 2, 10},               // sides in a plane
        {{1, .25, .25}, {2, .75, .75}, 1.25, 8},      // on one of its sides
        {{-1, .25, .25}, {2, .75, .75}, 1.5, 10},     // through it
        {{0, 0, 0}, {1, 1, 1}, 1, 6},                 // the same again
    };
    for (const Case& c : cases) {
        for (const bool inTriangles : {false, true}) {
            Mesh cage = joined(box({0, 0, 0}, {1, 1, 1}), box(c.low, c.high));
            if (inTriangles) cage = triangulated(cage);
            const RepairedCage result = mended(cage);
            BOOST_TEST_CONTEXT("a box from " << c.low << " to " << c.high)
            {
                BOOST_TEST(result.report.after.parts == 1U);
                BOOST_TEST(result.report.after.volume == c.volume, boost::test_tools::tolerance(1e-12));
                BOOST_TEST(result.report.after.area == c.area, boost::test_tools::tolerance(1e-12));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_chain_of_spheres_becomes_one_part)
{
    Mesh cage;
    for (int i = 0; i < 5; ++i) cage = joined(cage, sphere({1.2 * i, .1 * i, .03 * i}, 1, 8));
    const RepairedCage result = mended(cage);
    BOOST_TEST(result.report.before.parts == 5U);
    BOOST_TEST(result.report.after.parts == 1U);
    BOOST_TEST(result.report.after.volume > .8 * result.report.before.volume);
    BOOST_TEST(result.report.cutFaces > 0U);
}

BOOST_AUTO_TEST_CASE(parts_that_touch_stay_apart)
{
    for (const Vec3d& low : {Vec3d(1, 1, 0), Vec3d(1, 1, 1)}) { // at an edge, at a corner
        const RepairedCage result = mended(joined(box({0, 0, 0}, {1, 1, 1}), box(low, low + Vec3d(1))));
        BOOST_TEST(result.report.after.parts == 2U);
        BOOST_TEST(result.report.after.volume > 1.998);
    }
}

BOOST_AUTO_TEST_CASE(what_hangs_in_edges_is_taken_out)
{
    const Mesh ball = sphere({0, 0, 0}, 1, 8);
    Mesh fin = ball;
    fin.points.emplace_back(2, 2, 2);
    fin.triangles.emplace_back(ball.quads[5][0], ball.quads[5][1], Index32(fin.points.size() - 1));
    Mesh wall = ball; // at the equator
    wall.points.emplace_back(0, 0, 0);
    for (Index32 i = 0; i < 16; ++i) {
        wall.triangles.emplace_back(1 + 3 * 16 + i, 1 + 3 * 16 + (i + 1) % 16, Index32(wall.points.size() - 1));
    }
    BOOST_TEST(mended(fin).report.hangingFaces == 1U);
    BOOST_TEST(mended(wall).report.hangingFaces == 16U);
    BOOST_TEST((placesOfFaces(mended(fin).cage) == placesOfFaces(ball)));
    BOOST_TEST((placesOfFaces(mended(wall).cage) == placesOfFaces(ball)));
}

BOOST_AUTO_TEST_CASE(holes_are_filled_and_faces_turned)
{
    const Mesh ball = sphere({0, 0, 0}, 1, 8);
    Mesh open = ball;
    open.quads.resize(open.quads.size() - 3);
    for (std::size_t i = 0; i < open.quads.size(); i += 3) std::swap(open.quads[i][1], open.quads[i][3]);
    const RepairedCage result = mended(open);
    BOOST_TEST(result.report.filledHoles == 1U);
    BOOST_TEST(result.report.reoriented);
    BOOST_TEST(result.cage.quads.size() == open.quads.size());
    for (openvdb::Vec3I& t : open.triangles) std::swap(t[1], t[2]);
    for (openvdb::Vec4I& q : open.quads) std::swap(q[1], q[3]);
    mended(open);
}

BOOST_AUTO_TEST_CASE(degenerate_faces_leave_no_gap)
{
    // Each corner of the first triangle is a corner of a face beside it, but the middle one lies on its long side.
    Mesh cage = triangulated(box({0, 0, 0}, {1, 1, 1}));
    const Vec3I last = cage.triangles.back();
    const auto middle = static_cast<Index32>(cage.points.size());
    cage.points.push_back((cage.points[last[0]] + cage.points[last[1]]) / 2);
    cage.triangles.back() = {middle, last[1], last[2]};
    cage.triangles.emplace_back(last[0], middle, last[2]);
    cage.triangles.emplace_back(middle, last[0], last[1]);
    const RepairedCage result = mended(cage);
    BOOST_TEST(result.report.removedFaces == 1U);
    BOOST_TEST(result.report.filledHoles == 0U);
    BOOST_TEST(result.report.after.volume == 1., boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(no_soup_is_made_worse)
{
    constexpr unsigned soups = 40;
    unsigned valid = 0;
    for (unsigned seed = 0; seed < soups; ++seed) {
        std::mt19937 random(seed);
        const auto number = [&](double most) { return most * (double(random()) / 2147483648.0 - 1); };
        Mesh cage;
        for (unsigned part = 0; part < 1 + seed % 3; ++part) {
            const Vec3d centre(number(1), number(1), number(1));
            cage = joined(cage, seed % 2 ? sphere(centre, 1, 4) : box(centre, centre + Vec3d(1)));
        }
        for (unsigned i = 0; i < seed % 5; ++i) {
            Vec3d& point = cage.points[random() % cage.points.size()];
            point = i % 2 ? point * -1.3 : cage.points[random() % cage.points.size()];
        }
        for (unsigned i = 0; i < seed % 4; ++i) {
            const auto corner = [&] { return Index32(random() % cage.points.size()); };
            cage.triangles.emplace_back(corner(), corner(), corner());
        }
        if (seed % 7 == 0) cage.quads.pop_back();
        const CageCheck before = verdict(cage);
        const RepairedCage result = repair(cage);
        const CageCheck after = verdict(result.cage);
        BOOST_TEST_CONTEXT("seed " << seed)
        {
            BOOST_TEST(after.selfIntersections == result.report.selfIntersectionsAfter);
            BOOST_TEST(after.selfIntersections <= result.report.selfIntersectionsBefore);
            BOOST_TEST((sameMesh(result.cage, cage) || !before.valid()));
        }
        valid += after.valid();
    }
    BOOST_TEST(valid + 3 >= soups); // boxes of which half the points were moved may be beyond help
}

BOOST_AUTO_TEST_CASE(what_cannot_be_mended_is_told)
{
    // Two cones, tip to tip, where eight points are at one place but for rounding.
    Mesh cage = sphere({0, 0, 0}, 1, 4);
    for (Vec3d& p : cage.points) p = Vec3d(p[0] * p[2], p[1] * p[2], p[2]);
    const RepairedCage result = repair(cage);
    BOOST_TEST(result.report.selfIntersectionsAfter > 0U);
    BOOST_TEST(result.report.selfIntersectionsAfter <= result.report.selfIntersectionsBefore);
    BOOST_TEST(result.report.selfIntersectionsAfter == verdict(result.cage).selfIntersections);
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    const Mesh cage = joined(pulledThrough(sphere({0, 0, 0}, 1, 12), 12), sphere({1.2, .1, .2}, 1, 12));
    const Mesh one = [&] {
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        return repair(cage).cage;
    }();
    BOOST_TEST(sameMesh(one, repair(cage).cage));
}

BOOST_AUTO_TEST_CASE(it_can_be_cancelled_anywhere)
{
    const Mesh cage = joined(pulledThrough(sphere({0, 0, 0}, 1, 6), 2), sphere({1.2, .1, .2}, 1, 6));
    constexpr int never = 1 << 30;
    StopAt watcher(never);
    repair(cage, &watcher);
    const int asked = questions(watcher, never);
    BOOST_TEST(asked > 100);
    for (int k = 0; k < asked; k += 1 + asked / 30) {
        StopAt stop(k);
        BOOST_CHECK_THROW(repair(cage, &stop), Cancelled);
    }
    BOOST_CHECK_THROW(repair(Mesh{}), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
