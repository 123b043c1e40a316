// Operators that move vertices only: what they measure, against sums over all triangles of the model; what they leave
// as it was; and that they bring a surface nearer.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include <tbb/global_control.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/guard/vertex_placement.h>
#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "support/shapes.h"
#include "support/stop_at.h"
#include "support/surface_models.h"
#include "support/symmetric.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

const Mesh model = test::soup(3, 30, 0.1);

GuardedMesh start(const BoundingGuard& guard, int resolution = 9, GuardedMesh::Quads quads = GuardedMesh::Quads::split)
{
    const Mesh ball = test::ball(resolution);
    return GuardedMesh(guard.symmetry() ? guard.symmetrized(ball, 0.25 / resolution) : ball, modelOf(guard), quads);
}

double perSampleOf(const GuardedMesh& surface)
{
    return areaPerSample(surface, surface.liveFaces(), 4);
}

/// The vertices that are elsewhere than before. Connectivity is the same.
std::set<std::uint32_t> movedBetween(const GuardedMesh& before, const GuardedMesh& after)
{
    BOOST_TEST((test::triangleMesh(before).triangles == test::triangleMesh(after).triangles));
    BOOST_TEST(before.quads() == after.quads());
    std::set<std::uint32_t> moved;
    for (std::uint32_t v = 0; v < before.vertices(); ++v) {
        if (before.point(v) != after.point(v)) moved.insert(v);
    }
    return moved;
}

struct Operator {
    const char* name;
    std::function<void(GuardedMesh&, Interrupter*)> run;
};

const std::vector<Operator> operators{
    {"shrink", [](GuardedMesh& at, Interrupter* i) { shrink(at, i); }},
    {"tighten", [](GuardedMesh& at, Interrupter* i) { tighten(at, 4, perSampleOf(at), i); }},
    {"relaxFinally", [](GuardedMesh& at, Interrupter* i) { relaxFinally(at, perSampleOf(at), i); }},
    {"inflate", [](GuardedMesh& at, Interrupter* i) { inflate(at, 0.05, i); }},
    {"inflateTriangles", [](GuardedMesh& at, Interrupter* i) { inflateTriangles(at, 0.05, i); }},
    {"perturb", [](GuardedMesh& at, Interrupter* i) { perturb(at, 1, 2, perSampleOf(at), i); }},
    {"roundOff", [](GuardedMesh& at, Interrupter* i) { roundOff(at, 2, i); }},
};

} // namespace

BOOST_AUTO_TEST_SUITE(relax)

BOOST_AUTO_TEST_CASE(areas_and_distances_are_sums_over_the_faces)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        for (const auto quads : {GuardedMesh::Quads::split, GuardedMesh::Quads::keep}) {
            const GuardedMesh surface = start(guard, 7, quads);
            double sum = 0, integral = 0;
            std::vector<double> middles;
            for (const std::uint32_t f : test::facesAndAlternates(surface)) {
                const Corners t = surface.corners(f);
                const double size = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
                const double middle = test::distanceByAll(modelOf(guard), (t[0] + t[1] + t[2]) / 3.0);
                integral += surface.weight(f) * size * middle;
                if (!surface.isFace(f)) continue;
                sum += size;
                middles.push_back(middle);
            }
            BOOST_TEST(area(surface) == sum, boost::test_tools::tolerance(1e-9));
            BOOST_TEST(areaPerSample(surface, 50, 3) == sum / 150, boost::test_tools::tolerance(1e-9));
            std::sort(middles.begin(), middles.end());
            BOOST_TEST(medianDistance(surface) == middles[middles.size() / 2], boost::test_tools::tolerance(1e-9));
            const double one = integratedDistance(surface, 1e9); // a sample a face, up to 3 % too far
            BOOST_TEST(one >= (1 - 1e-9) * integral);
            BOOST_TEST(one <= 1.03 * integral);
        }
    }
    const BoundingGuard guard(model);
    const GuardedMesh nothing(Mesh{}, modelOf(guard));
    BOOST_TEST(area(nothing) == 0);
    BOOST_TEST(medianDistance(nothing) == 0);
    BOOST_TEST(integratedDistance(nothing, 1) == 0);
}

BOOST_AUTO_TEST_CASE(every_operator_keeps_connectivity_and_bounds)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const CageChecker checker(model);
        for (const auto quads : {GuardedMesh::Quads::split, GuardedMesh::Quads::keep}) {
            GuardedMesh before = start(guard, 9, quads);
            std::mt19937 random(1);
            test::makeSomeQuads(before, random, 4); // so that some are triangles, some not
            tighten(before, 2, perSampleOf(before), nullptr);
            for (const Operator& of : operators) {
                GuardedMesh after = before;
                of.run(after, nullptr);
                const auto moved = movedBetween(before, after);
                BOOST_TEST_CONTEXT(of.name)
                {
                    if (quads == GuardedMesh::Quads::split || of.name != std::string("inflateTriangles"))
                        BOOST_TEST(!moved.empty());
                    const Mesh mesh = after.mesh();
                    BOOST_TEST(checker.check(mesh).bounding());
                    BOOST_TEST(guard.facesTooNear(mesh).empty());
                    BOOST_TEST(test::listsAreRight(after));
                    BOOST_TEST(test::treeIsRight(after));
                    if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(tightening_brings_every_sweep_nearer)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        GuardedMesh surface = start(guard);
        const double perSample = perSampleOf(surface);
        double last = integratedDistance(surface, perSample);
        const double first = last;
        for (int i = 0; i < 8; ++i) {
            tighten(surface, 1, perSample, nullptr);
            const double now = integratedDistance(surface, perSample);
            BOOST_TEST(now < 1.001 * last); // samples are few
            last = now;
        }
        BOOST_TEST(last < 0.5 * first);
        const GuardedMesh before = surface;
        relaxFinally(surface, perSample, nullptr);
        BOOST_TEST(integratedDistance(surface, perSample) < last);
        GuardedMesh same = before;
        tighten(same, 0, perSample, nullptr);
        BOOST_TEST(test::sameSurface(same, before));
    }
}

BOOST_AUTO_TEST_CASE(only_the_vertices_that_are_asked_for_move)
{
    const BoundingGuard guard(model);
    const GuardedMesh before = start(guard);
    std::mt19937 random(5);
    for (int round = 0; round < 4; ++round) {
        std::vector<std::uint32_t> some;
        for (std::uint32_t v = 0; v < before.vertices(); ++v) {
            if (random() % 3 == 0) some.push_back(v);
        }
        const auto areAmong = [&](const std::set<std::uint32_t>& moved) {
            return std::includes(some.begin(), some.end(), moved.begin(), moved.end());
        };
        GuardedMesh tight = before, wide = before;
        tighten(tight, some, 3, perSampleOf(before), nullptr, nullptr);
        inflate(wide, some, 0.03, nullptr);
        for (const GuardedMesh* after : {&tight, &wide}) {
            const auto moved = movedBetween(before, *after);
            BOOST_TEST(areAmong(moved));
            BOOST_TEST(2 * moved.size() > some.size());
        }
    }
}

BOOST_AUTO_TEST_CASE(inflating_moves_vertices_outward_as_far_as_asked)
{
    const BoundingGuard guard(model);
    const GuardedMesh before = start(guard);
    GuardedMesh after = before;
    constexpr double by = 0.01;
    inflate(after, by, nullptr);
    BOOST_TEST(test::countTopology(after.mesh()).volume > test::countTopology(before.mesh()).volume);
    int full = 0;
    for (std::uint32_t v = 0; v < before.vertices(); ++v) {
        const Vec3d step = after.point(v) - before.point(v);
        BOOST_TEST(step.length() < 1.0001 * by);
        if (step.length() > 0) BOOST_TEST(step.dot(before.point(v)) > 0); // away from the middle of the ball
        full += step.length() > 0.9999 * by;
    }
    BOOST_TEST(full > 0.9 * before.vertices());
}

BOOST_AUTO_TEST_CASE(only_corners_of_triangles_are_inflated_beside_quads)
{
    const BoundingGuard guard(model);
    std::mt19937 random(2);
    GuardedMesh before = start(guard);
    test::makeSomeQuads(before, random, 1);
    BOOST_REQUIRE(before.quads() > 20U);
    GuardedMesh after = before;
    inflateTriangles(after, 0.01, nullptr);
    std::set<std::uint32_t> corners;
    for (std::uint32_t f = 0; f < before.faces(); ++f) {
        if (!before.isFace(f) || before.isInQuad(f)) continue;
        for (int i = 0; i < 3; ++i) corners.insert(before.face(f)[i]);
    }
    const auto moved = movedBetween(before, after);
    BOOST_TEST(corners.size() < before.vertices());
    BOOST_TEST(std::includes(corners.begin(), corners.end(), moved.begin(), moved.end()));
    BOOST_TEST(moved.size() > 0.9 * double(corners.size()));
}

BOOST_AUTO_TEST_CASE(a_perturbation_is_kept_only_if_it_brings_the_surface_nearer)
{
    for (const int resolution : {4, 7}) {
        const BoundingGuard guard(model);
        GuardedMesh surface = start(guard, resolution);
        const double perSample = perSampleOf(surface);
        tighten(surface, 16, perSample, nullptr);
        for (int i = 0; i < 6; ++i) {
            const double before = integratedDistance(surface, perSample);
            const GuardedMesh old = surface;
            perturb(surface, 1, 6, perSample, nullptr);
            const double after = integratedDistance(surface, perSample);
            BOOST_TEST((after < before || test::sameSurface(surface, old)));
        }
    }
}

BOOST_AUTO_TEST_CASE(shrinking_and_rounding_off_make_a_rough_ball_even)
{
    // The model is a speck: nothing is in the way.
    const BoundingGuard guard(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}));
    std::mt19937 random(3);
    Mesh rough = test::ball(9);
    for (Vec3d& p : rough.points) p += test::randomVector(random, 0.015);
    const GuardedMesh before(rough, modelOf(guard));
    const auto roughness = [](const GuardedMesh& surface) { // by what vertices are off the mean of their neighbours
        double sum = 0;
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            Vec3d mean(0.0);
            const auto neighbours = test::neighboursByFaces(surface, v);
            for (const std::uint32_t w : neighbours) mean += surface.point(w);
            sum += (mean / double(neighbours.size()) - surface.point(v)).length();
        }
        return sum / std::sqrt(area(surface));
    };
    GuardedMesh round = before, small = before;
    roundOff(round, 3, nullptr);
    shrink(small, nullptr);
    BOOST_TEST(roughness(round) < 0.8 * roughness(before));
    const double volume = test::countTopology(before.mesh()).volume;
    BOOST_TEST(test::countTopology(round.mesh()).volume > 0.93 * volume);
    BOOST_TEST(test::countTopology(small.mesh()).volume < 0.5 * volume);
}

// Those that go first, among which no two are neighbours: their neighbours are where they were.
BOOST_AUTO_TEST_CASE(a_vertex_shrinks_towards_the_middle_of_its_neighbours_and_the_model)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(test::box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}), isSymmetric);
        const GuardedMesh before = start(guard);
        GuardedMesh after = before;
        shrink(after, nullptr);
        int onPlane = 0, full = 0, all = 0;
        const auto groups = independentGroups(before, allVertices(before));
        for (const std::uint32_t v : groups[0]) {
            std::vector<Vec3d> ring; // of the whole surface
            for (const std::uint32_t w : test::neighboursByFaces(before, v)) {
                ring.push_back(before.point(w));
                if (before.isOnPlane(v) && !before.isOnPlane(w))
                    ring.push_back(modelOf(guard).mirrored(before.point(w)));
            }
            Vec3d mean(0.0);
            for (const Vec3d& p : ring) mean += p / double(ring.size());
            Vec3d closest(1e9);
            const Vec3d p = before.point(v);
            for (const TriangleBvh::Item& item : modelOf(guard).tree().items()) {
                const Vec3d there = closestPointOnTriangle(p, modelOf(guard).tree().corners(item));
                if ((there - p).length() < (closest - p).length()) closest = there;
            }
            Vec3d goal = 0.5 * (mean + closest);
            if (before.isOnPlane(v)) goal[0] = 0;
            onPlane += before.isOnPlane(v);
            full += (after.point(v) - (p + 0.9 * (goal - p))).length() < 1e-6;
            ++all;
        }
        BOOST_TEST(full >= (isSymmetric ? all - onPlane / 2 : 0.9 * all)); // others may be in the way
        BOOST_TEST((onPlane > 3) == isSymmetric);
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter_and_operators_can_be_cancelled)
{
    const BoundingGuard guard(model);
    const GuardedMesh before = start(guard, 8);
    for (const Operator& of : operators) {
        BOOST_TEST_CONTEXT(of.name)
        {
            GuardedMesh many = before;
            test::StopAt never(1000000);
            of.run(many, &never);
            const int asked = test::questions(never, 1000000);
            BOOST_TEST(asked > 100);
            for (int i = 0; i < asked; i += asked / 3) {
                GuardedMesh surface = before;
                test::StopAt stop(i);
                BOOST_CHECK_THROW(of.run(surface, &stop), Cancelled);
                BOOST_TEST(test::listsAreRight(surface));
                BOOST_TEST(test::treeIsRight(surface));
            }
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            GuardedMesh alone = before;
            of.run(alone, nullptr);
            BOOST_TEST(test::sameSurface(many, alone));
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
