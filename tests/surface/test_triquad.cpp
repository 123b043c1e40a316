#include <boost/test/data/monomorphic.hpp>
#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/surface/decimate.h>
#include <vdbcage/surface/smooth.h>
#include <vdbcage/surface/triquad.h>
#include <vdbcage/volume/extract.h>

#include "support/solids.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::test;
using openvdb::Vec4I;

namespace {

Mesh merge(const Mesh& mesh, double degrees)
{
    TriquadOptions options;
    options.mergeAngleDegrees = degrees;
    return triquad(mesh, options);
}

Mesh triangleGrid(unsigned n)
{
    Mesh mesh;
    for (unsigned i = 0; i <= n; ++i) {
        for (unsigned j = 0; j <= n; ++j) mesh.points.emplace_back(i, j, 0.01 * i * j);
    }
    for (unsigned i = 0; i < n; ++i) {
        for (unsigned j = 0; j < n; ++j) {
            const unsigned a = i * (n + 1) + j, b = a + n + 1;
            mesh.triangles.emplace_back(a, b, b + 1);
            mesh.triangles.emplace_back(a, b + 1, a + 1);
        }
    }
    return mesh;
}

Mesh animal()
{
    static const Mesh mesh = decimate(smooth(extractSurface(*sample(64, inCreature))));
    return mesh;
}

Vec3d doubledArea(const Mesh& mesh, unsigned a, unsigned b, unsigned c)
{
    return (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
}

/// Convex: the four triangles that the two diagonals make look the same way.
bool unfolded(const Mesh& mesh, const Vec4I& q)
{
    const Vec3d n[4] = {doubledArea(mesh, q[0], q[1], q[2]), doubledArea(mesh, q[0], q[2], q[3]),
                        doubledArea(mesh, q[0], q[1], q[3]), doubledArea(mesh, q[1], q[2], q[3])};
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < i; ++j) {
            if (!(n[i].dot(n[j]) > 0)) return false;
        }
    }
    return true;
}

double dihedral(const Mesh& mesh, const Vec4I& q)
{
    const Vec3d a = doubledArea(mesh, q[0], q[1], q[2]), b = doubledArea(mesh, q[0], q[2], q[3]);
    return std::atan2(a.cross(b).length(), a.dot(b)) * 180 / detail::pi;
}

std::size_t facesThatShareTwoEdges(const Mesh& mesh)
{
    std::map<std::pair<unsigned, unsigned>, std::vector<std::size_t>> edges;
    const auto faces = polygons(mesh);
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t i = 0; i < faces[f].size(); ++i) {
            edges[std::minmax(faces[f][i], faces[f][(i + 1) % faces[f].size()])].push_back(f);
        }
    }
    std::map<std::pair<std::size_t, std::size_t>, int> shared;
    for (const auto& [edge, users] : edges) {
        if (users.size() == 2) ++shared[std::minmax(users[0], users[1])];
    }
    std::size_t count = 0;
    for (const auto& [pair, times] : shared) count += times > 1;
    return count;
}

std::size_t leastValence(const Mesh& mesh)
{
    std::map<unsigned, std::size_t> faces;
    for (const auto& face : polygons(mesh)) {
        for (const unsigned corner : face) ++faces[corner];
    }
    std::size_t least = 1000;
    for (const auto& [point, valence] : faces) least = std::min(least, valence);
    return least;
}

} // namespace

BOOST_AUTO_TEST_SUITE(tri_quad)

BOOST_AUTO_TEST_CASE(a_grid_of_triangles_pairs_fully)
{
    const Mesh mesh = triangleGrid(9);
    const Mesh result = merge(mesh, 10);
    BOOST_TEST(result.triangles.empty());
    BOOST_TEST(result.quads.size() == 81U);
    BOOST_TEST((result.points == mesh.points));
}

BOOST_DATA_TEST_CASE(quads_are_good_faces, boost::unit_test::data::make({0.0, 2.0, 10.0, 30.0, 90.0, 180.0}), degrees)
{
    for (const Mesh& mesh : {animal(), decimate(extractSurface(*sample(32, inTorus)), {60}),
                             decimate(extractSurface(*sample(24, [](const Vec3d& p) { return inSphere(p); })), {12})}) {
        const Mesh result = merge(mesh, degrees);
        for (const Vec4I& quad : result.quads) {
            BOOST_REQUIRE(unfolded(result, quad));
            BOOST_REQUIRE(dihedral(result, quad) <= degrees + 1e-5);
        }
        BOOST_TEST(facesThatShareTwoEdges(result) == 0U);
        BOOST_TEST(leastValence(result) >= 3U);
        BOOST_TEST(2 * result.quads.size() + result.triangles.size() == mesh.triangles.size());
        BOOST_TEST(countTopology(result).closedManifold());
        BOOST_TEST(countTopology(result).genus() == countTopology(mesh).genus());
        // The merged edge is the diagonal of corners 0 and 2: split again it is the same surface.
        BOOST_TEST(std::abs(countTopology(result).volume / countTopology(mesh).volume - 1) < 1e-12);
        BOOST_TEST(std::abs(countTopology(result).area / countTopology(mesh).area - 1) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(a_wider_angle_gives_more_quads)
{
    const Mesh mesh = animal();
    BOOST_TEST(merge(mesh, 10).quads.size() > 20U);
    BOOST_TEST(merge(mesh, 40).quads.size() > 2 * merge(mesh, 5).quads.size());
}

BOOST_AUTO_TEST_CASE(concave_pairs_and_tetrahedra_stay_triangles)
{
    Mesh dart;
    dart.points = {{0, 0, 0}, {2, -2, 0}, {0.5, 0, 0}, {2, 2, 0}};
    dart.triangles = {{0, 1, 2}, {0, 2, 3}};
    BOOST_TEST(merge(dart, 180).quads.empty());
    dart.points[2] = {4, 0, 0};
    BOOST_TEST(merge(dart, 0).quads.size() == 1U);
    dart.points[2] = {2, 0, 0}; // straight at one corner
    BOOST_TEST(merge(dart, 180).quads.empty());
    Mesh tetrahedron;
    tetrahedron.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    BOOST_TEST(merge(tetrahedron, 180).quads.empty());
}

BOOST_AUTO_TEST_CASE(flat_and_square_pairs_come_first)
{
    // A polychord of three triangles: the first two make a square, the last two a parallelogram.
    Mesh polychord;
    polychord.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 0, 0}};
    polychord.triangles = {{1, 4, 3}, {1, 3, 2}, {0, 1, 2}};
    const Mesh result = merge(polychord, 10);
    BOOST_TEST_REQUIRE(result.quads.size() == 1U);
    BOOST_TEST((result.triangles == std::vector<openvdb::Vec3I>{{1, 4, 3}}));
}

BOOST_AUTO_TEST_CASE(quads_of_the_input_stay)
{
    Mesh mesh = merge(animal(), 10);
    const std::size_t before = mesh.quads.size();
    const Mesh more = merge(mesh, 40);
    BOOST_TEST(more.quads.size() > before);
    BOOST_TEST(std::equal(mesh.quads.begin(), mesh.quads.end(), more.quads.begin()));
    BOOST_TEST(facesThatShareTwoEdges(more) == 0U);
    BOOST_TEST(leastValence(more) >= 3U);
}

BOOST_AUTO_TEST_CASE(bad_input)
{
    BOOST_CHECK_THROW(merge(animal(), -1), InputError);
    BOOST_CHECK_THROW(merge(animal(), 181), InputError);
    BOOST_CHECK_THROW(merge(animal(), std::nan("")), InputError);
    BOOST_CHECK_THROW(merge(Mesh(), 10), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
