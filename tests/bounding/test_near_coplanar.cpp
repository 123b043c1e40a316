#include <boost/test/unit_test.hpp>

#include <cmath>
#include <map>
#include <utility>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/near_coplanar.h>
#include <vdbcage/bounding/tighten.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh.h>

#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using openvdb::Vec3d;

namespace {

constexpr double flatPart = 3e-5; // of the model's longest side

/// How many edges of a closed surface are neither flat nor bent: by less than 0.11 degrees, with both corners across
/// from the edge off the other triangle's plane by more than `flat`.
int between(const Mesh& mesh, double flat)
{
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, openvdb::Index32> acrossFrom;
    for (const auto& t : mesh.triangles) {
        for (int i = 0; i < 3; ++i) acrossFrom[{t[i], t[(i + 1) % 3]}] = t[(i + 2) % 3];
    }
    int count = 0;
    for (const auto& [edge, corner] : acrossFrom) {
        if (edge.first > edge.second) continue;
        const Vec3d &a = mesh.points[edge.first], &b = mesh.points[edge.second], &c = mesh.points[corner];
        const Vec3d& d = mesh.points[acrossFrom.at({edge.second, edge.first})];
        Vec3d one = (b - a).cross(c - a), other = (d - a).cross(b - a);
        one.normalize();
        other.normalize();
        const double degrees = std::atan2(one.cross(other).length(), one.dot(other)) * 180 / std::acos(-1.0);
        count += degrees < 0.1099 && std::abs(one.dot(d - a)) > flat && std::abs(other.dot(c - a)) > flat;
    }
    return count;
}

/// A low roof over a box, its ridge where x = 0, its sides bent by twice `slope` there.
Mesh roof(double slope)
{
    Mesh mesh;
    for (const double y : {-0.5, 0.5}) {
        for (const double x : {-0.5, 0.0, 0.5}) mesh.points.emplace_back(x, y, 0.3 - slope * std::abs(x));
        for (const double x : {-0.5, 0.0, 0.5}) mesh.points.emplace_back(x, y, -0.3);
    }
    // Points 0 1 2 are on top in front, 3 4 5 below them, 6 7 8 and 9 10 11 behind. A half, and its mirror image.
    mesh.triangles = {{0, 1, 7}, {0, 7, 6}, {3, 10, 4}, {3, 9, 10}, {0, 3, 4}, {0, 4, 1}, {6, 10, 9}, {6, 7, 10}};
    const auto across = [](openvdb::Index32 v) { return v % 3 == 0 ? v + 2 : v % 3 == 2 ? v - 2 : v; };
    for (std::size_t i = 0; i < 8; ++i) {
        const auto t = mesh.triangles[i];
        mesh.triangles.emplace_back(across(t[0]), across(t[2]), across(t[1]));
    }
    using openvdb::Vec3I;
    for (const Vec3I& t : {Vec3I(0, 6, 9), Vec3I(0, 9, 3), Vec3I(2, 11, 8), Vec3I(2, 5, 11)}) {
        mesh.triangles.push_back(t);
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(near_coplanar)

BOOST_AUTO_TEST_CASE(edges_over_flat_parts_are_flat_or_bent)
{
    const Mesh box = test::box({-0.3, -0.25, -0.2}, {0.3, 0.25, 0.2});
    const Mesh plates = test::joined(test::box({-0.35, -0.2, -0.15}, {0.35, 0.2, -0.1}),
                                     test::box({-0.35, -0.2, 0.1}, {0.35, 0.2, 0.15}));
    int found = 0;
    for (const Mesh& model : {box, plates}) {
        const double flat = 1.01 * flatPart * boundingBox(model).extents()[0];
        const CageChecker checker(model);
        for (const bool isSymmetric : {false, true}) {
            const BoundingGuard guard = test::guardOf(model, isSymmetric);
            const Mesh start = isSymmetric ? guard.symmetrized(test::ball(24), 0.25 / 24) : test::ball(24);
            for (const Effort effort : {Effort::fast, Effort::fair}) {
                const Mesh tight =
                    tighten(decimate(start, guard, test::to(300, effort)), guard, tightenOptions(effort));
                const Mesh bent = bendNearCoplanarEdges(tight, guard);
                found += between(tight, flat);
                BOOST_TEST(between(bent, flat) == 0);
                BOOST_TEST(bent.triangles == tight.triangles, boost::test_tools::per_element());
                const CageCheck before = checker.check(tight), after = checker.check(bent);
                BOOST_TEST(before.bounding());
                BOOST_TEST(after.bounding());
                BOOST_TEST(after.meanDistance < before.meanDistance + 1.5e-4 * before.diagonal);
                if (isSymmetric) BOOST_CHECK(test::isSymmetric(bent, *guard.symmetry()));
            }
        }
    }
    BOOST_TEST(found > 20);
}

BOOST_AUTO_TEST_CASE(the_edges_on_the_plane_of_symmetry_are_flat_or_bent_as_well)
{
    const double degree = std::acos(-1.0) / 180;
    TightenOptions none;
    none.sweeps = 0;
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(test::box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2}), isSymmetric);
        const double flat = 1.01 * flatPart * 0.4;
        const Mesh low = roof(std::tan(0.03 * degree));
        BOOST_TEST(between(low, flat) == 1);
        const Mesh bent = bendNearCoplanarEdges(low, guard);
        BOOST_TEST(between(bent, flat) == 0);
        if (isSymmetric) BOOST_CHECK(test::isSymmetric(bent, *guard.symmetry()));
        // Flat or bent already.
        for (const double angle : {0.0, 0.0005, 0.06, 30.0}) {
            const Mesh other = roof(std::tan(angle * degree));
            BOOST_TEST(between(other, flat) == 0);
            BOOST_TEST(bendNearCoplanarEdges(other, guard).points == tighten(other, guard, none).points,
                       boost::test_tools::per_element());
        }
    }
}

BOOST_AUTO_TEST_CASE(the_guard_is_obeyed)
{
    // The model is so near below all of the roof that the clearance leaves no room to lay its sides flat.
    const double slope = std::tan(0.03 * std::acos(-1.0) / 180), gap = 1e-3;
    Mesh model = roof(slope);
    for (Vec3d& p : model.points) p *= 1 - gap;
    GuardOptions options;
    options.clearance = 0.2 * gap;
    const BoundingGuard guard(model, options);
    const Mesh bent = bendNearCoplanarEdges(roof(slope), guard);
    BOOST_TEST(between(bent, 1.01 * flatPart) == 0);
    BOOST_TEST(checkCage(bent, model).bounding());
    BOOST_TEST(guard.facesTooNear(bent).empty());
}

BOOST_AUTO_TEST_CASE(quads_are_refused)
{
    Mesh withQuad = test::box(Vec3d(-0.5), Vec3d(0.5));
    withQuad.quads = {{0, 1, 2, 3}};
    const BoundingGuard guard(test::sphere(Vec3d(0.0), 0.2, 6));
    BOOST_CHECK_THROW((void)bendNearCoplanarEdges(withQuad, guard), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
