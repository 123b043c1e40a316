// Quads in a row between triangles, against a walk over the polygons of the mesh; and what is left when they are split.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/bounding/detail/quads/pairing/limited_growth.h>
#include <vdbcage/bounding/detail/quads/pairing/polychord.h>
#include <vdbcage/check/check.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "bounding/support/manifold.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

const Mesh model = test::box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});

/// A surface of quads, a ball mostly, of which some are split into triangles.
GuardedMesh start(const BoundingGuard& guard, unsigned seed, const Mesh& ball = test::ball(7))
{
    std::mt19937 random(seed);
    GuardedMesh surface(guard.symmetry() ? guard.symmetrized(ball, 0.03) : ball, modelOf(guard),
                        GuardedMesh::Quads::keep);
    std::size_t left = seed % 2 == 0 ? surface.quads() / 4 : 1;
    while (left > 0) {
        const auto f = static_cast<std::uint32_t>(random() % surface.faces());
        if (!surface.isFace(f) || !surface.isInQuad(f)) continue;
        surface.splitQuad(f);
        --left;
    }
    return surface;
}

using Ring = std::vector<std::uint32_t>;

/// The polygon with a side from a to b, from a on, by looking at all; empty if there is none.
Ring polygonAt(const GuardedMesh& surface, std::uint32_t a, std::uint32_t b)
{
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (!surface.isFace(f)) continue;
        const Vec3I& t = surface.face(f);
        Ring ring{t[0], t[1], t[2]};
        if (surface.isInQuad(f)) {
            const Vec4I q = surface.quadOf(f);
            ring = {q[0], q[1], q[2], q[3]};
        }
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (ring[i] != a || ring[(i + 1) % ring.size()] != b) continue;
            std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(i), ring.end());
            return ring;
        }
    }
    return {};
}

/// How many quads there are on the way from a side of a triangle; none where the way meets itself.
std::optional<std::size_t> lengthFrom(const GuardedMesh& surface, const Vec3I& triangle, int i)
{
    std::set<std::set<std::uint32_t>> passed{{triangle[0], triangle[1], triangle[2]}};
    std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
    for (std::size_t length = 0;; ++length) {
        const Ring next = polygonAt(surface, b, a);
        if (next.empty()) return length; // the plane
        if (!passed.insert({next.begin(), next.end()}).second) return std::nullopt;
        if (next.size() == 3) return length;
        a = next[2];
        b = next[3];
    }
}

} // namespace

BOOST_AUTO_TEST_SUITE(polychord)

BOOST_AUTO_TEST_CASE(polychords_are_walks_from_triangle_to_triangle_or_to_the_plane)
{
    int found = 0, toPlane = 0;
    for (const bool isSymmetric : {false, true}) {
        for (unsigned seed = 1; seed <= 8; ++seed) {
            const test::Lump lump(seed); // rows of quads on it meet themselves
            const BoundingGuard guard = test::guardOf(isSymmetric ? model : lump.model, isSymmetric);
            const GuardedMesh surface = isSymmetric ? start(guard, seed) : start(guard, seed, lump.surface);
            for (const std::uint32_t f : trianglesOf(surface)) {
                for (int i = 0; i < 3; ++i) {
                    const auto expected = lengthFrom(surface, surface.face(f), i);
                    const auto polychord = polychordFrom(surface, f, i, 1000);
                    BOOST_REQUIRE(polychord.has_value() == expected.has_value());
                    if (!expected) continue;
                    ++found;
                    BOOST_TEST(polychord->quads.size() == *expected);
                    BOOST_TEST(polychord->sides.size() == *expected + 1);
                    BOOST_TEST(polychordFrom(surface, f, i, *expected).has_value());
                    if (*expected > 0) BOOST_TEST(!polychordFrom(surface, f, i, *expected - 1));
                    for (std::size_t k = 0; k < polychord->quads.size(); ++k) {
                        const auto [g, h] = polychord->quads[k];
                        BOOST_TEST(surface.partnerOf(g) == h);
                        const auto &in = polychord->sides[k], &out = polychord->sides[k + 1];
                        const Ring quad = polygonAt(surface, in[1], in[0]);
                        BOOST_REQUIRE(quad.size() == 4U);
                        BOOST_TEST((out[0] == quad[2] && out[1] == quad[3]));
                    }
                    const auto& last = polychord->sides.back();
                    const bool isAtPlane = surface.isOnPlane(last[0]) && surface.isOnPlane(last[1]);
                    toPlane += isAtPlane;
                    BOOST_TEST(polygonAt(surface, last[1], last[0]).size() == (isAtPlane ? 0U : 3U));
                }
            }
        }
    }
    BOOST_TEST(found > 100);
    BOOST_TEST(toPlane > 3);
}

BOOST_AUTO_TEST_CASE(a_split_polychord_is_two_rows_of_quads)
{
    std::map<std::size_t, int> split; // by length
    int refused = 0, besidePlane = 0, inPlane = 0;
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const CageChecker checker(model);
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const GuardedMesh before = start(guard, seed);
            for (const std::uint32_t f : trianglesOf(before)) {
                for (int i = 0; i < 3; ++i) {
                    const auto polychord = polychordFrom(before, f, i, 6);
                    if (!polychord) continue;
                    const bool isAtPlane =
                        faceAt(before, polychord->sides.back()[1], polychord->sides.back()[0]) == GuardedMesh::none;
                    const std::size_t n = polychord->quads.size(), ends = isAtPlane ? 1 : 2;
                    inPlane += isAtPlane && n == 0; // a side on the plane: nothing to split
                    for (const double most : {-1.0, 1.0}) {
                        GuardedMesh surface = before;
                        if (!splitPolychord(surface, *polychord, most)) {
                            ++refused;
                            BOOST_TEST(test::sameSurface(surface, before));
                            continue;
                        }
                        BOOST_TEST(most == 1);
                        BOOST_TEST((n > 0 || !isAtPlane));
                        ++split[n];
                        besidePlane += isAtPlane;
                        // A vertex for each side; each quad is two, each end a quad.
                        BOOST_TEST(surface.vertices() == before.vertices() + n + 1);
                        BOOST_TEST(surface.quads() == before.quads() + n + ends);
                        BOOST_TEST(trianglesOf(surface).size() + ends == trianglesOf(before).size());
                        BOOST_TEST(enclosedVolume(surface) - enclosedVolume(before) <= most);
                        const Mesh mesh = surface.mesh();
                        BOOST_TEST(test::isClosedManifold(mesh));
                        BOOST_TEST(test::listsAreRight(surface));
                        if (split[n] % 8 == 1) BOOST_TEST(checker.check(mesh).bounding());
                        if (isSymmetric) BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
                    }
                }
            }
        }
    }
    BOOST_TEST(refused > 20);
    BOOST_TEST(besidePlane > 0);
    BOOST_TEST(inPlane > 0);
    BOOST_TEST(split[0] + split[1] > 10);
    BOOST_TEST(split[2] + split[3] + split[4] > 10);
}

BOOST_AUTO_TEST_SUITE_END()
