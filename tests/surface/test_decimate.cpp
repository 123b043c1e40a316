#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <tbb/global_control.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/volume/extract.h>

#include "support/solids.h"
#include "support/stop_at.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::test;

namespace {

Mesh decimateTo(const Mesh& mesh, std::size_t faces)
{
    DecimateOptions options;
    options.faces = faces;
    return decimate(mesh, options);
}

Mesh voxelSurface(int resolution, bool (*inside)(const Vec3d&), int iterations = 3)
{
    SmoothOptions options;
    options.iterations = iterations;
    return smooth(extractSurface(*sample(resolution, inside)), options);
}

bool inBall(const Vec3d& p)
{
    return inSphere(p);
}

bool inBox(const Vec3d& p)
{
    return std::max({std::abs(p.x()), std::abs(p.y()), std::abs(p.z())}) < 0.5;
}

/// A sphere of radius 1, `rings` quads from pole to pole.
Mesh sphere(unsigned rings)
{
    Mesh mesh;
    const unsigned around = 2 * rings;
    for (unsigned i = 1; i < rings; ++i) {
        for (unsigned j = 0; j < around; ++j) {
            const double a = detail::pi * i / rings, b = 2 * detail::pi * j / around;
            mesh.points.emplace_back(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
        }
    }
    const unsigned north = unsigned(mesh.points.size()), south = north + 1;
    mesh.points.emplace_back(0, 0, 1);
    mesh.points.emplace_back(0, 0, -1);
    for (unsigned j = 0; j < around; ++j) {
        const unsigned k = (j + 1) % around, last = (rings - 2) * around;
        mesh.triangles.emplace_back(north, j, k);
        mesh.triangles.emplace_back(south, last + k, last + j);
        for (unsigned i = 0; i + 2 < rings; ++i) {
            mesh.quads.emplace_back(i * around + j, (i + 1) * around + j, (i + 1) * around + k, i * around + k);
        }
    }
    return mesh;
}

/// n x n squares of two triangles each in the plane z = 0, side 1.
Mesh sheet(unsigned n)
{
    Mesh mesh;
    for (unsigned i = 0; i <= n; ++i) {
        for (unsigned j = 0; j <= n; ++j) mesh.points.emplace_back(double(i) / n, double(j) / n, 0);
    }
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            const unsigned a = i * (n + 1) + j, b = a + n + 1;
            mesh.quads.emplace_back(a, b, b + 1, a + 1);
        }
    }
    return mesh;
}

double minAngle(const Mesh& mesh)
{
    return sortedAngles(mesh).front();
}

double firstPercentileAngle(const Mesh& mesh)
{
    const auto angles = sortedAngles(mesh);
    return angles[angles.size() / 100];
}

/// The largest angle between the normals of two neighbouring triangles.
double sharpestFold(const Mesh& mesh)
{
    std::map<std::pair<unsigned, unsigned>, Vec3d> normals;
    double sharpest = 0;
    for (const auto& t : mesh.triangles) {
        Vec3d normal = (mesh.points[t[1]] - mesh.points[t[0]]).cross(mesh.points[t[2]] - mesh.points[t[0]]);
        normal.normalize();
        for (int i = 0; i < 3; ++i) {
            normals[{t[i], t[(i + 1) % 3]}] = normal;
            const auto other = normals.find({t[(i + 1) % 3], t[i]});
            if (other == normals.end()) continue;
            sharpest = std::max(sharpest, std::acos(std::clamp(normal.dot(other->second), -1.0, 1.0)));
        }
    }
    return sharpest * 180 / detail::pi;
}

} // namespace

BOOST_AUTO_TEST_SUITE(decimation)

BOOST_DATA_TEST_CASE(reaches_the_count_and_keeps_the_topology,
                     boost::unit_test::data::make({20U, 50U, 100U, 400U, 1000U}), faces)
{
    const Mesh ball = voxelSurface(40, inBall), torus = voxelSurface(40, inTorus),
               animal = voxelSurface(64, inCreature);
    for (const Mesh* mesh : {&ball, &torus, &animal}) {
        if (mesh == &animal && faces < 100) continue;
        const Mesh result = decimateTo(*mesh, faces);
        const TopologyCount count = countTopology(result);
        BOOST_TEST(result.triangles.size() == faces);
        BOOST_TEST(result.quads.empty());
        BOOST_TEST(count.closedManifold());
        BOOST_TEST(count.genus() == (mesh == &torus ? 1 : 0));
        BOOST_TEST(count.parts == 1U);
        BOOST_TEST(count.points == result.points.size());
        BOOST_TEST(count.volume > 0);
    }
}

BOOST_AUTO_TEST_CASE(many_parts_with_cavities_stay_what_they_are)
{
    const Mesh mesh = extractSurface(*randomSolid(5, 14, 0.35, openvdb::Coord(0, 0, 0)));
    const TopologyCount before = countTopology(mesh);
    const Mesh result = decimateTo(mesh, 4);
    const TopologyCount after = countTopology(result);
    BOOST_TEST(after.closedManifold());
    BOOST_TEST(after.parts == before.parts);
    BOOST_TEST(after.genus() == before.genus());
    BOOST_TEST(result.triangles.size() < mesh.quads.size());
}

BOOST_AUTO_TEST_CASE(stops_at_the_tetrahedron_and_at_the_smallest_torus)
{
    const Mesh ball = decimateTo(voxelSurface(24, inBall), 4);
    BOOST_TEST(ball.triangles.size() == 4U);
    BOOST_TEST(countTopology(ball).closedManifold());
    BOOST_TEST((decimateTo(ball, 4).points == ball.points));
    const Mesh torus = decimateTo(voxelSurface(24, inTorus), 4);
    BOOST_TEST(torus.triangles.size() >= 14U); // no triangulated torus has less
    BOOST_TEST(torus.triangles.size() <= 24U);
    BOOST_TEST(countTopology(torus).closedManifold());
    BOOST_TEST(countTopology(torus).genus() == 1);
}

BOOST_AUTO_TEST_CASE(enough_faces_already_changes_nothing)
{
    const Mesh mesh = sphere(8);
    const Mesh result = decimateTo(mesh, 1000);
    BOOST_TEST((result.points == mesh.points));
    BOOST_TEST((result.triangles == triangulate(mesh)));
}

BOOST_AUTO_TEST_CASE(a_sphere_stays_a_sphere_of_even_triangles)
{
    const Mesh result = decimateTo(sphere(50), 200); // from 9,800
    BOOST_TEST(result.triangles.size() == 200U);
    double sum = 0, largest = 0;
    for (const Vec3d& p : result.points) {
        sum += p.length() - 1;
        largest = std::max(largest, std::abs(p.length() - 1));
    }
    BOOST_TEST(std::abs(sum) / double(result.points.size()) < 0.02); // a ring of edges is about 0.27 long
    BOOST_TEST(largest < 0.03);
    BOOST_TEST(std::abs(countTopology(result).volume / countTopology(sphere(50)).volume - 1) < 0.03);
    BOOST_TEST(firstPercentileAngle(result) > 20);
    BOOST_TEST(minAngle(result) > 12);
    BOOST_TEST(sharpestFold(result) < 45);
}

BOOST_AUTO_TEST_CASE(voxel_surfaces_give_no_slivers_folds_or_spikes)
{
    const Mesh animal = voxelSurface(96, inCreature);
    const Mesh result = decimateTo(animal, 400);
    BOOST_TEST(result.triangles.size() == 400U);
    BOOST_TEST(firstPercentileAngle(result) > 12);
    BOOST_TEST(minAngle(result) > 5);
    BOOST_TEST(sharpestFold(result) < 144);
    openvdb::BBoxd box = boundingBox(animal);
    box.expand(0.02);
    for (const Vec3d& p : result.points) BOOST_REQUIRE(box.isInside(p));
    BOOST_TEST(std::abs(countTopology(result).volume / countTopology(animal).volume - 1) < 0.08);
    BOOST_TEST(minAngle(decimateTo(voxelSurface(64, inCreature, 0), 400)) > 3);
}

BOOST_AUTO_TEST_CASE(a_box_of_voxels_becomes_its_twelve_triangles)
{
    const Mesh box = extractSurface(*sample(42, inBox)); // about 10,000 squares
    BOOST_TEST(box.quads.size() > 10000U);
    const Mesh result = decimateTo(box, 12);
    BOOST_TEST(result.triangles.size() == 12U);
    BOOST_TEST(result.points.size() == 8U);
    const openvdb::BBoxd bounds = boundingBox(box);
    for (const Vec3d& p : result.points) {
        for (int axis = 0; axis < 3; ++axis) {
            const double off = std::min(std::abs(p[axis] - bounds.min()[axis]), std::abs(p[axis] - bounds.max()[axis]));
            BOOST_TEST(off < 1e-11);
        }
    }
    const Mesh even = decimateTo(box, 200); // on the faces only the spread decides
    BOOST_TEST(std::abs(countTopology(even).volume / countTopology(box).volume - 1) < 1e-9);
    BOOST_TEST(firstPercentileAngle(even) > 12);
}

BOOST_AUTO_TEST_CASE(a_boundary_stays_where_it_is)
{
    const Mesh result = decimateTo(sheet(40), 30);
    BOOST_TEST(result.triangles.size() <= 30U);
    BOOST_TEST(std::abs(countTopology(result).area - 1) < 1e-6);
    const openvdb::BBoxd box = boundingBox(result);
    BOOST_TEST((box.min() - Vec3d(0, 0, 0)).length() < 1e-6);
    BOOST_TEST((box.max() - Vec3d(1, 1, 0)).length() < 1e-6);
    BOOST_TEST(decimateTo(sheet(20), 4).triangles.size() <= 4U);
}

BOOST_AUTO_TEST_CASE(size_and_place_do_not_matter)
{
    const Mesh mesh = voxelSurface(40, inCreature);
    const Mesh result = decimateTo(mesh, 300);
    for (const double scale : {std::ldexp(1, -20), std::ldexp(1, 20)}) { // exact
        Mesh scaled = mesh;
        for (Vec3d& p : scaled.points) p *= scale;
        Mesh expected = result;
        for (Vec3d& p : expected.points) p *= scale;
        const Mesh got = decimateTo(scaled, 300);
        BOOST_TEST((got.triangles == expected.triangles));
        BOOST_TEST((got.points == expected.points));
    }
    for (const auto& [scale, offset] : {std::pair(1e-6, 0.0), {1e6, 0.0}, {1.0, -1000.0}, {1e-12, 0.0}}) {
        Mesh moved = mesh;
        for (Vec3d& p : moved.points) p = p * scale + Vec3d(offset);
        const Mesh got = decimateTo(moved, 300);
        BOOST_TEST(got.triangles.size() == 300U);
        BOOST_TEST(countTopology(got).closedManifold());
        BOOST_TEST(std::abs(countTopology(got).volume / countTopology(moved).volume - 1) < 0.08);
        BOOST_TEST(firstPercentileAngle(got) > 10);
    }
}

BOOST_AUTO_TEST_CASE(threads_do_not_matter)
{
    const Mesh mesh = voxelSurface(48, inCreature);
    const Mesh many = decimateTo(mesh, 400);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Mesh single = decimateTo(mesh, 400);
    BOOST_TEST((single.points == many.points && single.triangles == many.triangles));
}

BOOST_AUTO_TEST_CASE(refuses_what_is_not_an_oriented_manifold)
{
    BOOST_CHECK_THROW(decimateTo(sphere(8), 3), InputError);
    Mesh twoFans; // two tetrahedra with one corner in common
    twoFans.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
    twoFans.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}};
    BOOST_CHECK_THROW(decimateTo(twoFans, 4), InputError);
    Mesh openFans = twoFans; // and with boundary
    openFans.triangles = {{0, 1, 2}, {0, 4, 5}};
    BOOST_CHECK_THROW(decimateTo(openFans, 4), InputError);
    Mesh threeAtAnEdge = twoFans;
    threeAtAnEdge.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    BOOST_CHECK_THROW(decimateTo(threeAtAnEdge, 4), InputError);
    Mesh turned = twoFans;
    turned.triangles = {{0, 1, 2}, {0, 1, 3}};
    BOOST_CHECK_THROW(decimateTo(turned, 4), InputError);
    Mesh repeated = twoFans;
    repeated.triangles = {{0, 1, 2}, {3, 3, 4}};
    BOOST_CHECK_THROW(decimateTo(repeated, 4), InputError);
    BOOST_CHECK_THROW(decimateTo(Mesh(), 4), InputError);
}

BOOST_AUTO_TEST_CASE(points_without_faces_are_dropped)
{
    Mesh mesh = sphere(8);
    mesh.points.insert(mesh.points.begin(), Vec3d(std::nan(""), 9, 9));
    for (auto& t : mesh.triangles) t += openvdb::Vec3I(1);
    for (auto& q : mesh.quads) q += openvdb::Vec4I(1);
    const Mesh result = decimateTo(mesh, 1000);
    BOOST_TEST((result.points == sphere(8).points));
}

BOOST_AUTO_TEST_CASE(cancelled_at_any_question)
{
    const Mesh mesh = voxelSurface(24, inTorus);
    StopAt never(1 << 20);
    decimate(mesh, {}, &never);
    const int asked = questions(never, 1 << 20);
    BOOST_TEST(asked >= 5);
    for (int k = 0; k < asked; ++k) {
        StopAt stop(k);
        BOOST_CHECK_THROW(decimate(mesh, {}, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
