// The operators under a guard that has a plane of symmetry.
#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>
#include <string>

#include <tbb/global_control.h>
#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/bounding/detail/quads/pairing/quad_pairing.h>
#include <vdbcage/bounding/smooth.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/bounding/triquad.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/mirror.h>

#include "bounding/support/manifold.h"
#include "bounding/support/spacing.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/solids.h"
#include "support/symmetric.h"

using namespace vdbcage;
using openvdb::Vec3d;
using test::quads;
using test::to;

namespace {

constexpr int resolution = 16;
constexpr double snap = 0.25 / resolution;

/// Small triangles in a ball of radius 0.4, each a part of its own; many near the plane x = 0.
Mesh dust(unsigned seed, int count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    Mesh mesh;
    while (int(mesh.triangles.size()) < count) {
        Vec3d centre(unit(random), unit(random), unit(random));
        if (centre.length() > 1) continue;
        if (mesh.triangles.size() % 2 == 0) centre[0] *= 0.05;
        const auto first = static_cast<openvdb::Index32>(mesh.points.size());
        for (int k = 0; k < 3; ++k) {
            mesh.points.push_back(0.38 * centre + 0.01 * Vec3d(unit(random), unit(random), unit(random)));
        }
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

/// What is symmetric and what is not, within a ball of radius 0.42.
std::vector<Mesh> models()
{
    return {test::sphere({0, 0, 0}, 0.4, 12),
            test::box({-0.3, -0.2, -0.1}, {0.2, 0.2, 0.2}),
            test::torus(0.3, 0.08, 24, 10),
            test::sphere({0.1, 0.12, -0.13}, 0.1, 8),
            dust(1, 100),
            test::joined(test::box({-0.25, -0.2, -0.2}, {-0.05, 0, 0}), test::box({0.05, 0, 0}, {0.2, 0.2, 0.2}))};
}

/// Planes in which the voxels of ball() can be symmetric: through their centres and between them.
SymmetryPlane planeOf(int axis, int sum)
{
    return {axis, 0.5 * sum / resolution};
}

BoundingGuard guardOf(const Mesh& model, const SymmetryPlane& plane)
{
    GuardOptions options;
    options.symmetry = plane;
    return BoundingGuard(model, options);
}

/// A surface with a clearance around everything in the ball of radius 0.42, and its mirror image.
Mesh ball(int axis, int sum)
{
    const auto mask = test::sample(resolution, [](const Vec3d& p) { return test::inSphere(p, 0.48); });
    return extractSurface(*makeWellComposed(*withMirrorImage(*mask, axis, sum)));
}

Mesh start(const BoundingGuard& guard, int axis, int sum)
{
    return guard.symmetrized(ball(axis, sum), snap);
}

/// Faces with corners on both sides of the plane, or none off it.
std::size_t facesNotOnOneSide(const Mesh& mesh, const SymmetryPlane& plane)
{
    std::size_t count = 0;
    const auto look = [&](const auto& face, int corners) {
        bool before = false, behind = false;
        for (int i = 0; i < corners; ++i) {
            before = before || mesh.points[face[i]][plane.axis] > plane.offset;
            behind = behind || mesh.points[face[i]][plane.axis] < plane.offset;
        }
        count += before == behind;
    };
    for (const auto& t : mesh.triangles) look(t, 3);
    for (const auto& q : mesh.quads) look(q, 4);
    return count;
}

/// A prism along x with five sides, its edges across cut in two by the plane x = 0; a pair of quad and triangle at each
/// end, all other faces are quads.
Mesh prism()
{
    constexpr openvdb::Index32 sides = 5;
    Mesh mesh;
    for (const double x : {0.0, 0.4, -0.4}) {
        for (openvdb::Index32 i = 0; i < sides; ++i) {
            const double angle = 2 * detail::pi * i / sides;
            mesh.points.emplace_back(x, 0.4 * std::cos(angle), 0.4 * std::sin(angle));
        }
    }
    mesh.triangles = {{5, 6, 9}};
    mesh.quads = {{6, 7, 8, 9}};
    for (openvdb::Index32 i = 0; i < sides; ++i) {
        const openvdb::Index32 next = (i + 1) % sides;
        mesh.quads.emplace_back(i, next, sides + next, sides + i);
    }
    const auto image = [](openvdb::Index32 i) { return i < sides ? i : i + sides; };
    const auto t = mesh.triangles.front();
    mesh.triangles.emplace_back(image(t[0]), image(t[2]), image(t[1]));
    const std::vector<openvdb::Vec4I> half = mesh.quads;
    for (const auto& q : half) mesh.quads.emplace_back(image(q[0]), image(q[3]), image(q[2]), image(q[1]));
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(symmetry)

BOOST_DATA_TEST_CASE(half_of_a_surface_and_its_image_are_closed, boost::unit_test::data::make({0, 1, 2}), axis)
{
    for (const int sum : {0, 1}) {
        const SymmetryPlane plane = planeOf(axis, sum);
        const BoundingGuard guard = guardOf(test::sphere({0, 0, 0}, 0.4, 8), plane);
        const Mesh surface = ball(axis, sum), both = guard.symmetrized(surface, snap);
        BOOST_TEST(guard.symmetry()->axis == axis);
        BOOST_TEST(std::abs(guard.symmetry()->offset - plane.offset) < 1e-7);
        BOOST_CHECK(test::isSymmetric(both, *guard.symmetry()));
        BOOST_TEST(test::isClosedManifold(both));
        BOOST_TEST(facesNotOnOneSide(both, *guard.symmetry()) == 0U);
        // Between voxels nothing is cut; through their centres every face across it becomes two.
        const std::size_t across = facesNotOnOneSide(surface, plane);
        BOOST_TEST((across == 0) == (sum == 1));
        BOOST_TEST(faceCount(both) == faceCount(surface) + across);
        BOOST_TEST(guard.facesTooNear(both).empty());
    }
}

BOOST_DATA_TEST_CASE(cages_are_symmetric_and_bound_the_model_and_its_image, boost::unit_test::data::make({0, 1, 2}),
                     axis)
{
    constexpr std::size_t faces = 60;
    const int sum = axis == 1;
    int reached = 0, cages = 0;
    for (const Mesh& model : models()) {
        const BoundingGuard guard = guardOf(model, planeOf(axis, sum));
        const SymmetryPlane plane = *guard.symmetry();
        const CageChecker checker(model), imageChecker(test::mirrored(model, plane));
        const Mesh surface = start(guard, axis, sum);
        const auto examine = [&](const Mesh& cage) {
            BOOST_CHECK(test::isSymmetric(cage, plane));
            BOOST_TEST(facesNotOnOneSide(cage, plane) == 0U);
            BOOST_TEST(checker.check(cage).bounding());
            BOOST_TEST(imageChecker.check(cage).bounding());
            BOOST_TEST(test::pairsTooNear(cage, guard, 0.99) == 0U);
            reached += faceCount(cage) <= faces;
            ++cages;
        };
        for (const Effort effort : {Effort::fast, Effort::best}) {
            const Mesh cage = decimate(surface, guard, to(faces, effort));
            const Mesh tight = tighten(cage, guard);
            BOOST_TEST(checker.check(tight).meanDistance < 1.05 * checker.check(cage).meanDistance);
            for (const Mesh& mesh : {cage, tight, smooth(tight, guard, {4})}) examine(mesh);
        }
        const Mesh twice = decimate(surface, guard, to(2 * faces, Effort::fast));
        for (const double degrees : {30.0, 90.0}) {
            BoundingTriquadOptions options = quads(faces, degrees);
            if (degrees == 90) options.quads = 0.9; // takes strips of quads that end on the plane, too
            const Mesh cage = triquad(twice, guard, options);
            BOOST_TEST(cage.quads.size() > 0U);
            for (const Mesh& mesh : {cage, tighten(cage, guard)}) examine(mesh);
        }
    }
    BOOST_TEST(reached >= 0.9 * cages); // the guard may lock some
}

BOOST_AUTO_TEST_CASE(vertices_keep_off_the_plane)
{
    // An octahedron and its mirror image; its points are numbered by axis, the lesser first.
    const SymmetryPlane plane{0, 0};
    Mesh octahedron;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-0.4, 0.4}) {
            Vec3d p(0.5, 0, 0);
            p[axis] += side;
            octahedron.points.push_back(p);
        }
    }
    octahedron.triangles = {{1, 3, 5}, {3, 0, 5}, {0, 2, 5}, {2, 1, 5}, {3, 1, 4}, {0, 3, 4}, {2, 0, 4}, {1, 2, 4}};
    const Mesh surface = test::joined(octahedron, test::mirrored(octahedron, plane));
    // The model and its mirror image are 1.2 long: half of two thousandths of it are asked on either side.
    const BoundingGuard guard = guardOf(test::box({0.4, -0.1, -0.1}, {0.6, 0.1, 0.1}), plane);
    const detail::GuardedMesh guarded(surface, detail::modelOf(guard));
    const auto mayGo = [&](double x) {
        const detail::StarChange star = starOf(guarded, 0);
        return allows(guarded, star, rounded(guarded, star, detail::modelOf(guard).scaled({x, 0, 0})));
    };
    BOOST_TEST(mayGo(0.00121));
    BOOST_TEST(!mayGo(0.00119));
}

BOOST_AUTO_TEST_CASE(they_are_about_as_tight_as_others)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.4, 40);
    const auto distance = [&](const Mesh& surface, const BoundingGuard& guard) {
        TightenOptions perturbed;
        perturbed.perturbations = 1;
        const Mesh cage = tighten(decimate(surface, guard, to(100, Effort::fair)), guard, perturbed);
        return checkCage(cage, model).meanDistance;
    };
    const BoundingGuard guard = guardOf(model, planeOf(0, 0));
    BOOST_TEST(distance(start(guard, 0, 0), guard) < 1.2 * distance(ball(0, 0), BoundingGuard(model)));
}

BOOST_AUTO_TEST_CASE(far_from_the_origin_and_at_any_size)
{
    for (const double scale : {1e-90, 1e-6, 1.0, 1e6, 1e90}) {
        for (const double far : {0.0, -0.1234567, 1000.0, 1e8}) { // the second puts images where floats are coarser
            const Vec3d move = scale * far * Vec3d(1, -2, 3);
            const Mesh model = test::transformed(dust(3, 30), scale, move);
            const BoundingGuard guard = guardOf(model, {0, move[0]});
            const Mesh surface = guard.symmetrized(test::transformed(ball(0, 0), scale, move), scale * snap);
            const Mesh cage = tighten(decimate(surface, guard, to(60, Effort::fast)), guard);
            BOOST_CHECK(test::isSymmetric(cage, *guard.symmetry()));
            BOOST_TEST(checkCage(cage, model).bounding());
            BOOST_TEST(cage.triangles.size() < surface.quads.size());
            if (!detail::fitsFloat(boundingBox(model))) continue;
            for (const Vec3d& p : cage.points) BOOST_TEST(double(float(p[0])) == p[0]); // images too
        }
    }
}

BOOST_AUTO_TEST_CASE(no_inner_edge_joins_two_points_of_the_plane)
{
    // A bar along the plane with next to nothing in it: collapses towards the plane are in no model's way.
    const Mesh model = test::box({-0.004, -0.004, -0.2}, {0.004, 0.004, 0.2});
    const auto mask = test::sample(resolution, [](const Vec3d& p) {
        return std::abs(p.x()) < 0.1 && std::abs(p.y()) < 0.1 && std::abs(p.z()) < 0.4;
    });
    const BoundingGuard guard = guardOf(model, {0, 0});
    const Mesh surface = guard.symmetrized(extractSurface(*mask), snap);
    for (std::size_t faces = 8; faces <= 40; faces += 4) {
        const Mesh cage = decimate(surface, guard, to(faces, Effort::fast));
        BOOST_TEST(test::isClosedManifold(cage));
        BOOST_CHECK(test::isSymmetric(cage, *guard.symmetry()));
        BOOST_TEST(faceCount(cage) <= faces);
    }
}

BOOST_AUTO_TEST_CASE(a_polychord_to_the_plane_is_split)
{
    // There is one triangle in each half: it can become a quad only by splitting the one quad between it and the plane.
    const Mesh model = test::sphere({0, 0, 0}, 0.2, 8);
    const BoundingGuard guard = guardOf(model, {0, 0});
    detail::GuardedMesh surface(prism(), detail::modelOf(guard), detail::GuardedMesh::Quads::keep);
    BOOST_REQUIRE(surface.quads() == 6U);
    BOOST_REQUIRE(surface.liveFaces() == 13U);
    detail::PairingOptions options{};
    options.mergeAngleDegrees = 90;
    options.share = 1;
    options.maxPathPairs = 1;
    options.maxLoss = 1;
    detail::pairUp(surface, options, nullptr);
    BOOST_TEST(surface.quads() == 6U);
    options.splits = true;
    detail::pairUp(surface, options, nullptr);
    BOOST_TEST(surface.quads() == 8U);
    const Mesh cage = surface.mesh();
    BOOST_TEST(cage.triangles.empty());
    BOOST_TEST(cage.points.size() == prism().points.size() + 3);
    BOOST_CHECK(test::isSymmetric(cage, *guard.symmetry()));
    BOOST_TEST(facesNotOnOneSide(cage, *guard.symmetry()) == 0U);
    BOOST_TEST(test::isClosedManifold(cage));
    BOOST_TEST(checkCage(cage, model).bounding());
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh model = dust(4, 60);
    const auto make = [&] {
        const BoundingGuard guard = guardOf(model, planeOf(0, 0));
        const Mesh cage = decimate(start(guard, 0, 0), guard, to(160, Effort::best));
        return smooth(tighten(triquad(cage, guard, quads(80, 30)), guard), guard, {2});
    };
    const Mesh many = make();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    BOOST_CHECK(test::sameMesh(many, make()));
}

BOOST_AUTO_TEST_CASE(surfaces_that_are_not_symmetric_are_refused)
{
    const Mesh model = test::sphere({0, 0, 0}, 0.1, 8);
    const BoundingGuard guard = guardOf(model, planeOf(0, 0));
    const Mesh good = start(guard, 0, 0);
    BOOST_CHECK_NO_THROW(tighten(good, guard));
    const auto isRefused = [&](const Mesh& surface, const std::string& why) {
        try {
            tighten(surface, guard);
        } catch (const InputError& error) {
            return std::string(error.what()).find(why) != std::string::npos;
        }
        return false;
    };
    BOOST_CHECK(isRefused(ball(0, 0), "across"));
    for (const double side : {-1.0, 1.0}) {
        Mesh moved = good;
        for (Vec3d& p : moved.points) {
            if (side * p[0] < 0.3) continue;
            p[1] += 1e-3;
            break;
        }
        BOOST_CHECK(isRefused(moved, "mirror image"));
    }
    Mesh turned = good;
    const auto q = turned.quads.back();
    turned.quads.back() = {q[1], q[2], q[3], q[0]}; // halves that are not each other's images
    BOOST_CHECK(isRefused(turned, "mirror image"));
    // Two boxes with a face of each on the plane: one surface in space, but not in its faces.
    Mesh halves = test::box({0, -0.3, -0.3}, {0.3, 0.3, 0.3});
    halves = test::joined(halves, test::mirrored(halves, {0, 0}));
    BOOST_CHECK(isRefused(halves, "in the plane"));
    // An edge on the plane from which two faces go off on each side.
    Mesh tent;
    tent.points = {{0, -0.3, 0}, {0, 0.3, 0}, {0.3, 0, 0.2}, {0.3, 0, -0.2}};
    tent.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    for (const double z : {0.2, -0.2}) tent.points.emplace_back(-0.3, 0, z);
    const std::vector<openvdb::Vec3I> half = tent.triangles;
    const auto image = [](openvdb::Index32 i) { return i < 2 ? i : i + 2; };
    for (const auto& t : half) tent.triangles.emplace_back(image(t[0]), image(t[2]), image(t[1]));
    BOOST_CHECK(isRefused(tent, "manifold"));
    GuardOptions bad;
    bad.symmetry = SymmetryPlane{3, 0};
    BOOST_CHECK_THROW(BoundingGuard(model, bad), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
