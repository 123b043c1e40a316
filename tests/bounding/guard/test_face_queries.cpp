// What is next to what, against all faces looked at one by one.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/surface_models.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

/// Some surfaces with triangles and quads: whole ones and a half.
struct Surfaces {
    Surfaces() : lump(4), guard(test::guardOf(test::soup(2, 10, 0.1), true))
    {
        std::mt19937 random(1);
        list.emplace_back(lump.surface, modelOf(lump.guard), GuardedMesh::Quads::keep);
        list.emplace_back(lump.surface, modelOf(lump.guard));
        test::makeSomeQuads(list.back(), random, 3);
        list.emplace_back(guard.symmetrized(test::ball(6), 0.04), modelOf(guard));
        test::makeSomeQuads(list.back(), random, 2);
    }

    test::Lump lump;
    BoundingGuard guard;
    std::vector<GuardedMesh> list;
};

/// The live face with a side from a to b, by looking at all.
std::uint32_t faceBySearch(const GuardedMesh& surface, std::uint32_t a, std::uint32_t b)
{
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (!surface.isFace(f)) continue;
        const Vec3I& t = surface.face(f);
        if ((t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b)) return f;
    }
    return GuardedMesh::none;
}

} // namespace

BOOST_AUTO_TEST_SUITE(face_queries)

BOOST_AUTO_TEST_CASE(the_face_at_a_side_is_the_one_that_has_it)
{
    const Surfaces surfaces;
    for (const GuardedMesh& surface : surfaces.list) {
        std::size_t sides = 0, missing = 0;
        for (std::uint32_t a = 0; a < surface.vertices(); ++a) {
            for (std::uint32_t b = 0; b < surface.vertices(); ++b) {
                const std::uint32_t f = faceAt(surface, a, b);
                BOOST_TEST(f == faceBySearch(surface, a, b));
                if (f == GuardedMesh::none) {
                    missing += faceAt(surface, b, a) != GuardedMesh::none;
                    continue;
                }
                ++sides;
                const int i = sideOf(surface, f, a, b);
                BOOST_REQUIRE((i >= 0 && i < 3));
                BOOST_TEST((surface.face(f)[i] == a && surface.face(f)[(i + 1) % 3] == b));
                BOOST_TEST(sideOf(surface, f, b, a) == -1);
                const std::uint32_t c = cornerOpposite(surface, f, a, b);
                BOOST_TEST((c != a && c != b && test::hasCorner(surface.face(f), c)));
            }
        }
        BOOST_TEST(sides == 3 * surface.liveFaces());
        BOOST_TEST((missing > 0) == surface.guard().symmetry().has_value()); // the half ends there
    }
}

BOOST_AUTO_TEST_CASE(across_a_side_is_the_face_that_goes_back_along_it)
{
    const Surfaces surfaces;
    for (const GuardedMesh& surface : surfaces.list) {
        int ends = 0, diagonals = 0;
        for (const std::uint32_t f : test::facesAndAlternates(surface)) {
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t a = surface.face(f)[i], b = surface.face(f)[(i + 1) % 3];
                const std::uint32_t g = faceAcross(surface, f, i), found = faceBySearch(surface, b, a);
                BOOST_TEST(g == (found == GuardedMesh::none ? f : found));
                if (g != f) continue;
                const bool isOnPlane = surface.isOnPlane(a) && surface.isOnPlane(b);
                ++(isOnPlane ? ends : diagonals);
                if (!isOnPlane) BOOST_TEST(!surface.isFace(f));
            }
        }
        BOOST_TEST(diagonals == static_cast<int>(2 * surface.quads()));
        BOOST_TEST((ends > 0) == surface.guard().symmetry().has_value());
    }
}

BOOST_AUTO_TEST_CASE(triangles_are_the_faces_in_no_quad_and_polygons_have_one_number)
{
    const Surfaces surfaces;
    for (const GuardedMesh& surface : surfaces.list) {
        const std::vector<std::uint32_t> triangles = trianglesOf(surface);
        BOOST_TEST(std::is_sorted(triangles.begin(), triangles.end()));
        BOOST_TEST(triangles.size() + 2 * surface.quads() == surface.liveFaces());
        std::set<std::uint32_t> polygons;
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            const bool isListed = std::binary_search(triangles.begin(), triangles.end(), f);
            BOOST_TEST(isListed == isTriangle(surface, f));
            BOOST_TEST(isListed == (surface.isFace(f) && surface.partnerOf(f) == GuardedMesh::none));
            if (!surface.isFace(f)) continue;
            polygons.insert(polygonOf(surface, f));
            if (!isListed) BOOST_TEST(polygonOf(surface, f) == polygonOf(surface, surface.partnerOf(f)));
        }
        BOOST_TEST(polygons.size() == surface.liveFaces() - surface.quads());
    }
}

BOOST_AUTO_TEST_CASE(places_and_normals_are_those_of_the_corners)
{
    const Surfaces surfaces;
    for (const GuardedMesh& surface : surfaces.list) {
        double area = 0;
        for (const std::uint32_t f : test::facesAndAlternates(surface)) {
            const Corners t = surface.corners(f);
            const Vec3d normal = areaNormal(surface, f);
            for (std::size_t i = 0; i < 3; ++i) BOOST_TEST(std::abs(normal.dot(t[(i + 1) % 3] - t[i])) < 1e-9);
            if (surface.isFace(f)) area += 0.5 * normal.length();
            if (!surface.isInQuad(f)) continue;
            const Vec4I q = surface.quadOf(f);
            const auto places = pointsOf(surface, q);
            for (int i = 0; i < 4; ++i) BOOST_TEST(places[static_cast<std::size_t>(i)] == surface.point(q[i]));
        }
        BOOST_TEST(area == test::countTopology(test::triangleMesh(surface)).area, boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_SUITE_END()
