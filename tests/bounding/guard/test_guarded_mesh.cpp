// The connectivity of a surface that only changes under a guard, against the faces looked at one by one.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/core/error.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "bounding/support/manifold.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

using Quads = GuardedMesh::Quads;

std::uint32_t randomVertex(const GuardedMesh& surface, std::mt19937& random)
{
    for (;;) {
        const auto v = static_cast<std::uint32_t>(random() % surface.vertices());
        if (surface.isVertex(v)) return v;
    }
}

/// A change of a kind taken at random, at a place taken at random: one that the guard allows, or none.
bool findChange(const GuardedMesh& surface, std::mt19937& random, StarChange& star, Vec3d& place)
{
    const auto change = test::randomChange(surface, randomVertex(surface, random), random);
    if (!change) return false;
    star = change->star;
    place = rounded(surface, star, change->start + test::randomVector(random, 0.3 * change->size));
    return allows(surface, star, place);
}

/// Whether a quad is another one, or that turned by two corners.
bool sameQuad(const Vec4I& a, const Vec4I& b)
{
    return a == b || a == Vec4I(b[2], b[3], b[0], b[1]);
}

} // namespace

BOOST_AUTO_TEST_SUITE(guarded_mesh)

BOOST_AUTO_TEST_CASE(what_comes_in_goes_out_rounded)
{
    for (unsigned seed = 1; seed <= 10; ++seed) {
        const test::Lump lump(seed);
        const GuardModel& model = modelOf(lump.guard);
        Mesh given = lump.surface;
        std::mt19937 random(seed);
        for (Vec3d& p : given.points) p += test::randomVector(random, 0.1);
        const Mesh split = GuardedMesh(given, model).mesh();
        BOOST_TEST(split.quads.empty());
        BOOST_TEST((split.triangles == triangulate(given)));
        BOOST_TEST(split.points.size() == given.points.size());
        for (std::size_t i = 0; i < given.points.size(); ++i) {
            BOOST_TEST(split.points[i] == model.unscaled(model.rounded(model.scaled(given.points[i]))));
            BOOST_TEST((split.points[i] - given.points[i]).length() < 1e-6);
        }
        const Mesh kept = GuardedMesh(given, model, Quads::keep).mesh();
        BOOST_TEST(kept.triangles.size() + 2 * kept.quads.size() == split.triangles.size());
        BOOST_TEST(kept.points == split.points);
        std::size_t at = 0;
        for (const Vec4I& q : kept.quads) { // a quad that is left out was split
            while (at < given.quads.size() && !sameQuad(given.quads[at], q)) ++at;
            BOOST_TEST(at < given.quads.size());
        }
        const Mesh again = GuardedMesh(kept, model, Quads::keep).mesh();
        BOOST_TEST(again.quads.size() == kept.quads.size());
        BOOST_TEST(again.points == kept.points);
    }
}

BOOST_AUTO_TEST_CASE(vertices_know_their_faces_and_their_neighbours)
{
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        std::size_t quads = 0;
        for (const Quads kind : {Quads::split, Quads::keep}) {
            const GuardedMesh surface(lump.surface, modelOf(lump.guard), kind);
            BOOST_TEST(test::listsAreRight(surface));
            BOOST_TEST(test::treeIsRight(surface));
            for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
                const auto list = surface.neighbours(v);
                BOOST_TEST(std::vector<std::uint32_t>(list.begin(), list.end()) == test::neighboursByFaces(surface, v));
            }
            quads = surface.quads();
        }
        BOOST_TEST(quads > 0U);
    }
}

BOOST_AUTO_TEST_CASE(any_row_of_changes_leaves_a_closed_manifold_of_the_same_genus)
{
    int made = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const test::Lump lump(seed);
        GuardedMesh surface(lump.surface, modelOf(lump.guard));
        const test::TopologyCount before = test::countTopology(lump.surface);
        std::mt19937 random(seed);
        for (int i = 0; i < 600; ++i) {
            StarChange star;
            Vec3d place;
            if (!findChange(surface, random, star, place)) continue;
            const std::size_t faces = surface.liveFaces() + star.link.size() - star.oldFaces.size();
            surface.apply(star, place);
            ++made;
            BOOST_TEST(surface.liveFaces() == faces);
            BOOST_TEST(surface.point(star.centre) == place);
            if (star.removed != GuardedMesh::none) BOOST_TEST(!surface.isVertex(star.removed));
            if (i % 10 != 0) continue;
            BOOST_TEST(test::listsAreRight(surface));
            BOOST_TEST(test::treeIsRight(surface));
            const test::TopologyCount now = test::countTopology(surface.mesh());
            BOOST_TEST(now.closedManifold());
            BOOST_TEST(now.parts == before.parts);
            BOOST_TEST(now.genus() == before.genus());
            BOOST_TEST(now.faces == surface.liveFaces());
        }
    }
    BOOST_TEST(made > 500);
}

BOOST_AUTO_TEST_CASE(changes_taken_back_in_turn_leave_no_trace)
{
    int longest = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        GuardedMesh surface(lump.surface, modelOf(lump.guard));
        std::mt19937 random(seed);
        for (int round = 0; round < 10; ++round) {
            std::vector<GuardedMesh> before;
            std::vector<GuardedMesh::Saved> saved;
            for (int i = 0; i < 20; ++i) {
                StarChange star;
                Vec3d place;
                if (!findChange(surface, random, star, place)) continue;
                before.push_back(surface);
                saved.push_back(surface.saved(star));
                surface.apply(star, place);
                BOOST_TEST(!test::sameSurface(surface, before.back()));
            }
            longest = std::max(longest, static_cast<int>(saved.size()));
            for (std::size_t i = saved.size(); i-- > 0;) {
                surface.restore(saved[i]);
                BOOST_TEST(test::sameSurface(surface, before[i]));
            }
            BOOST_TEST(test::listsAreRight(surface));
            BOOST_TEST(test::treeIsRight(surface));
        }
    }
    BOOST_TEST(longest > 5);
}

BOOST_AUTO_TEST_CASE(quads_are_made_flipped_and_split_as_a_list_of_them_says)
{
    int made = 0, flipped = 0, split = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        GuardedMesh surface(lump.surface, modelOf(lump.guard));
        std::mt19937 random(seed);
        std::map<std::uint32_t, std::uint32_t> partners; // of faces
        const auto areaOf = [&](std::uint32_t f, std::uint32_t g) {
            return test::countTopology({{surface.corners(f)[0], surface.corners(f)[1], surface.corners(f)[2],
                                         surface.corners(g)[0], surface.corners(g)[1], surface.corners(g)[2]},
                                        {{0, 1, 2}, {3, 4, 5}},
                                        {}})
                .area;
        };
        for (int i = 0; i < 400; ++i) {
            const auto f = static_cast<std::uint32_t>(random() % surface.faces());
            if (!surface.isFace(f)) continue;
            const auto known = partners.find(f);
            BOOST_TEST(surface.isInQuad(f) == (known != partners.end()));
            BOOST_TEST(surface.weight(f) == (known != partners.end() ? 0.5 : 1));
            if (known == partners.end()) {
                for (std::uint32_t g = 0; g < surface.faces(); ++g) {
                    if (!surface.isFace(g) || surface.isInQuad(g) || f == g) continue;
                    int shared = 0;
                    for (int k = 0; k < 3; ++k) shared += test::hasCorner(surface.face(f), surface.face(g)[k]);
                    if (shared != 2 || !makeQuad(surface, f, g)) continue;
                    ++made;
                    partners[f] = g;
                    partners[g] = f;
                    break;
                }
            } else if (random() % 2 == 0) {
                const std::uint32_t g = known->second;
                const auto alternates = surface.alternatesIn(f);
                const Vec4I before = surface.quadOf(f);
                const double area = areaOf(f, g);
                surface.flipQuad(f);
                ++flipped;
                BOOST_TEST((!surface.isFace(f) && !surface.isFace(g)));
                BOOST_TEST((surface.isFace(alternates[0]) && surface.isFace(alternates[1])));
                const Vec4I now = surface.quadOf(alternates[0]);
                BOOST_TEST((sameQuad(now, {before[1], before[2], before[3], before[0]})));
                BOOST_TEST(std::abs(areaOf(alternates[0], alternates[1]) - area) < 1e-9 * area); // they are flat here
                partners.erase(f);
                partners.erase(g);
                partners[alternates[0]] = alternates[1];
                partners[alternates[1]] = alternates[0];
            } else {
                const auto alternates = surface.alternatesIn(f);
                surface.splitQuad(f);
                ++split;
                for (const std::uint32_t o : alternates) BOOST_TEST((!surface.isFace(o) && !surface.isInQuad(o)));
                partners.erase(known->second);
                partners.erase(f);
            }
            BOOST_TEST(2 * surface.quads() == partners.size());
        }
        BOOST_TEST(test::listsAreRight(surface));
        BOOST_TEST(test::treeIsRight(surface));
        const Mesh mesh = surface.mesh();
        BOOST_TEST(2 * mesh.quads.size() == partners.size());
        BOOST_TEST(test::isClosedManifold(mesh));
        for (const auto& [f, g] : partners) {
            BOOST_TEST(surface.partnerOf(f) == g);
            for (const std::uint32_t o : surface.alternatesIn(f)) {
                BOOST_TEST(surface.areAlternatives(f, o));
                BOOST_TEST(surface.areAlternatives(o, g));
                BOOST_TEST(surface.partnerOf(o) != f);
                const Vec4I q = surface.quadOf(f);
                BOOST_TEST((test::hasCorner(surface.face(o), q[1]) && test::hasCorner(surface.face(o), q[3])));
                BOOST_TEST((sameQuad(surface.quadOf(o), q)));
            }
            BOOST_TEST(!surface.areAlternatives(f, g));
        }
    }
    BOOST_TEST(made > 100);
    BOOST_TEST(flipped > 50);
    BOOST_TEST(split > 50);
}

BOOST_AUTO_TEST_CASE(half_of_a_symmetric_surface_is_kept_and_both_are_given)
{
    for (const int resolution : {6, 9}) {
        const BoundingGuard guard = test::guardOf(test::soup(1, 20, 0.1), true);
        const Mesh whole = guard.symmetrized(test::ball(resolution), 0.25 / resolution);
        for (const Quads kind : {Quads::split, Quads::keep}) {
            GuardedMesh half(whole, modelOf(guard), kind);
            BOOST_TEST(half.copies() == 2U);
            BOOST_TEST(2 * half.liveFaces() == triangulate(whole).size());
            BOOST_TEST(test::listsAreRight(half));
            std::size_t onPlane = 0;
            for (std::uint32_t v = 0; v < half.vertices(); ++v) {
                if (!half.isVertex(v)) continue;
                BOOST_TEST(half.point(v)[0] >= 0);
                BOOST_TEST(half.isOnPlane(v) == (half.point(v)[0] == 0));
                onPlane += half.isOnPlane(v);
                const auto list = half.neighbours(v);
                BOOST_TEST(std::vector<std::uint32_t>(list.begin(), list.end()) == test::neighboursByFaces(half, v));
            }
            BOOST_TEST(onPlane > 3U);
            const Mesh both = half.mesh();
            BOOST_TEST(both.points.size() == whole.points.size());
            BOOST_TEST(both.triangles.size() + 2 * both.quads.size() == 2 * half.liveFaces());
            BOOST_TEST((kind == Quads::keep) == !both.quads.empty());
            BOOST_TEST(test::isClosedManifold(both));
            BOOST_CHECK(test::isSymmetric(both, *guard.symmetry()));
            const auto volume = test::countTopology(both).volume;
            BOOST_TEST(volume == test::countTopology(whole).volume, boost::test_tools::tolerance(1e-5));
            if (kind == Quads::keep) continue;
            std::mt19937 random(1);
            for (int i = 0; i < 300; ++i) {
                StarChange star;
                Vec3d place;
                if (!findChange(half, random, star, place)) continue;
                half.apply(star, place);
                BOOST_TEST(test::isClosedManifold(half.mesh()));
            }
            BOOST_CHECK(test::isSymmetric(half.mesh(), *guard.symmetry()));
            BOOST_TEST(test::treeIsRight(half));
        }
    }
}

BOOST_AUTO_TEST_CASE(exactly_what_is_no_closed_manifold_is_refused)
{
    int refused = 0, taken = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const test::Lump lump(seed);
        Mesh whole;
        whole.points = lump.surface.points;
        whole.triangles = triangulate(lump.surface);
        std::mt19937 random(seed);
        for (int i = 0; i < 80; ++i) {
            Mesh mesh = whole;
            auto& faces = mesh.triangles;
            auto& face = faces[random() % faces.size()];
            const auto kind = random() % 5;
            if (kind == 0) std::swap(face[0], face[1]);
            if (kind == 1) faces.push_back(Vec3I(face[1], face[2], face[0]));
            if (kind == 2) face = faces[random() % faces.size()];
            if (kind == 3) { // two points become one, which may pinch
                const auto a = static_cast<openvdb::Index32>(random() % mesh.points.size()),
                           b = static_cast<openvdb::Index32>(random() % mesh.points.size());
                const bool isDegenerate = std::any_of(faces.begin(), faces.end(), [&](const Vec3I& t) {
                    return test::hasCorner(t, a) && test::hasCorner(t, b);
                });
                if (isDegenerate) continue;
                for (Vec3I& t : faces) {
                    for (int k = 0; k < 3; ++k) t[k] = t[k] == a ? b : t[k];
                }
            }
            if (kind == 4) std::shuffle(faces.begin(), faces.end(), random);
            const bool isClosed = test::countTopology(mesh).closedManifold();
            bool isTaken = true;
            try {
                GuardedMesh(mesh, modelOf(lump.guard));
            } catch (const InputError&) {
                isTaken = false;
            }
            BOOST_TEST(isTaken == isClosed);
            ++(isTaken ? taken : refused);
        }
    }
    BOOST_TEST(refused > 100);
    BOOST_TEST(taken > 50);
}

BOOST_AUTO_TEST_SUITE_END()
