// Stars that take the place of faces, against the same change made by hand to a list of triangles.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <vdbcage/bounding/decimate.h>
#include <vdbcage/bounding/detail/guard/star_change.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "bounding/support/manifold.h"
#include "bounding/support/targets.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"
#include "support/topology_count.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

const Mesh speck = test::box({-0.02, -0.02, -0.02}, {0.02, 0.02, 0.02});

/// Surfaces of triangles: of voxels, and with few faces, where most is refused. They outlive what is made of them.
std::vector<Mesh> surfaces()
{
    std::vector<Mesh> list{test::ball(5), test::torus(0.4, 0.1, 7, 4)};
    const BoundingGuard guard(speck);
    for (const std::size_t faces : {4U, 5U, 6U, 8U, 10U, 14U, 24U})
        list.push_back(decimate(test::ball(8), guard, test::to(faces, Effort::fast)));
    for (unsigned seed = 1; seed <= 3; ++seed) list.push_back(test::Lump(seed).surface);
    return list;
}

Vec3I turned(const Vec3I& t)
{
    if (t[0] < t[1] && t[0] < t[2]) return t;
    return t[1] < t[2] ? Vec3I(t[1], t[2], t[0]) : Vec3I(t[2], t[0], t[1]);
}

/// The faces without their order and first corners.
std::multiset<Vec3I> faceSet(const std::vector<Vec3I>& triangles)
{
    std::multiset<Vec3I> set;
    for (const Vec3I& t : triangles) set.insert(turned(t));
    return set;
}

/// The faces after a change, as the star says: old ones go, and there is one at each link edge.
std::multiset<Vec3I> facesAfter(const GuardedMesh& surface, const StarChange& star)
{
    std::multiset<Vec3I> set;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        const bool isOld = std::find(star.oldFaces.begin(), star.oldFaces.end(), f) != star.oldFaces.end();
        if (surface.isFace(f) && !isOld) set.insert(turned(surface.face(f)));
    }
    for (const auto& edge : star.link) set.insert(turned({star.centre, edge[0], edge[1]}));
    return set;
}

/// All points of a whole surface and its triangles: of half a surface with the mirror image, whose points have numbers
/// after those of the half; points on the plane have one.
struct Whole {
    explicit Whole(const GuardedMesh& surface) : mesh(test::triangleMesh(surface)), image(mesh.points.size())
    {
        const auto count = static_cast<std::uint32_t>(mesh.points.size());
        for (std::uint32_t v = 0; v < count; ++v) {
            image[v] = surface.isOnPlane(v) || !surface.guard().symmetry() ? v : v + count;
        }
        if (!surface.guard().symmetry()) return;
        for (std::uint32_t v = 0; v < count; ++v) mesh.points.push_back(surface.guard().mirrored(mesh.points[v]));
        const std::vector<Vec3I> half = mesh.triangles;
        for (const Vec3I& t : half) mesh.triangles.emplace_back(image[t[0]], image[t[2]], image[t[1]]);
    }
    /// a becomes b everywhere; faces that have both go.
    void identify(std::uint32_t a, std::uint32_t b)
    {
        for (Vec3I& t : mesh.triangles) {
            for (int i = 0; i < 3; ++i) t[i] = t[i] == a ? b : t[i];
        }
        const auto isGone = [](const Vec3I& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
        mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), isGone),
                             mesh.triangles.end());
    }

    Mesh mesh;
    std::vector<std::uint32_t> image;
};

/// Whether faces are one disk, and which vertices are inside of it: by Euler's formula, and a walk around the rim.
struct Patch {
    Patch(const GuardedMesh& surface, const StarChange::Faces& faces)
    {
        std::set<std::pair<std::uint32_t, std::uint32_t>> sides, edges;
        std::set<std::uint32_t> vertices;
        for (const std::uint32_t f : faces) {
            const Vec3I& t = surface.face(f);
            for (int i = 0; i < 3; ++i) {
                sides.emplace(t[i], t[(i + 1) % 3]);
                edges.insert(std::minmax(t[i], t[(i + 1) % 3]));
                vertices.insert(t[i]);
            }
        }
        std::map<std::uint32_t, std::uint32_t> next;
        std::size_t rim = 0;
        for (const auto& [a, b] : sides) {
            if (sides.count({b, a}) > 0) continue;
            next[a] = b;
            ++rim;
        }
        inside = vertices;
        for (const auto& step : next) inside.erase(step.first);
        if (next.empty() || next.size() != rim) return; // closed, or the rim meets itself
        std::uint32_t at = next.begin()->first;
        std::size_t steps = 0;
        do {
            at = next.at(at);
            ++steps;
        } while (at != next.begin()->first && steps <= rim);
        isDisk = steps == rim && vertices.size() + faces.size() == edges.size() + 1;
    }

    bool isDisk = false;
    std::set<std::uint32_t> inside;
};

/// Faces that hang together over edges, from one taken at random on.
StarChange::Faces connectedFaces(const GuardedMesh& surface, std::mt19937& random, std::size_t most)
{
    StarChange::Faces faces;
    const std::vector<std::uint32_t> all = test::facesAndAlternates(surface);
    faces.push_back(all[random() % all.size()]);
    for (std::size_t tries = 0; faces.size() < most && tries < 4 * most; ++tries) {
        const Vec3I& t = surface.face(faces[random() % faces.size()]);
        const int i = static_cast<int>(random() % 3);
        for (const std::uint32_t f : surface.facesOf(t[i])) {
            if (!test::hasCorner(surface.face(f), t[(i + 1) % 3])) continue;
            if (std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
        }
    }
    return faces;
}

} // namespace

BOOST_AUTO_TEST_SUITE(star_change)

BOOST_AUTO_TEST_CASE(the_star_of_a_vertex_changes_nothing_but_its_place)
{
    const BoundingGuard guard(speck);
    for (const Mesh& mesh : surfaces()) {
        const GuardedMesh surface(mesh, modelOf(guard));
        const std::multiset<Vec3I> before = faceSet(test::triangleMesh(surface).triangles);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            BOOST_TEST(star.centre == v);
            BOOST_TEST(star.removed == StarChange::none);
            BOOST_TEST(!star.onPlane);
            BOOST_TEST(star.oldFaces.size() == surface.neighbours(v).size());
            BOOST_CHECK(star.oldFaces == star.keptFaces);
            BOOST_CHECK(facesAfter(surface, star) == before);
            for (std::size_t i = 0; i < star.link.size(); ++i) {
                const Corners t = starCorners(surface, star, i, surface.point(v));
                BOOST_CHECK(faceSet({Vec3I(v, star.link[i][0], star.link[i][1])}) ==
                            faceSet({surface.face(star.keptFaces[i])}));
                BOOST_CHECK(t[0] == surface.point(v));
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_star_knows_the_alternates_around_it)
{
    const test::Lump lump(2);
    const GuardedMesh surface(lump.surface, modelOf(lump.guard), GuardedMesh::Quads::keep);
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        const StarChange star = starOf(surface, v);
        std::set<std::uint32_t> expected;
        std::size_t alternates = 0;
        for (const std::uint32_t f : test::facesAndAlternates(surface)) {
            if (!test::hasCorner(surface.face(f), v)) continue;
            expected.insert(f);
            alternates += !surface.isFace(f);
        }
        BOOST_CHECK(std::set<std::uint32_t>(star.oldFaces.begin(), star.oldFaces.end()) == expected);
        BOOST_TEST(star.oldFaces.size() == expected.size());
        BOOST_TEST(star.alternates == alternates);
        for (std::size_t i = 0; i < star.oldFaces.size(); ++i) { // they are the last
            BOOST_TEST(surface.isFace(star.oldFaces[i]) == (i + alternates < star.oldFaces.size()));
        }
    }
}

BOOST_AUTO_TEST_CASE(edges_collapse_where_a_closed_manifold_is_left)
{
    int allowed = 0, refused = 0, small = 0;
    const BoundingGuard guard(speck);
    for (const Mesh& mesh : surfaces()) {
        const GuardedMesh surface(mesh, modelOf(guard));
        for (std::uint32_t keep = 0; keep < surface.vertices(); ++keep) {
            for (const std::uint32_t remove : surface.neighbours(keep)) {
                Whole byHand(surface);
                byHand.identify(remove, keep);
                const bool isManifold = test::isClosedManifold(byHand.mesh);
                StarChange star;
                const bool may = starOfCollapse(surface, keep, remove, star);
                // Where three edges would be left at the vertex it is not collapsed either.
                const std::size_t left = surface.neighbours(keep).size() + surface.neighbours(remove).size() - 4;
                BOOST_TEST(may == (isManifold && left > 3));
                small += isManifold && left <= 3;
                ++(may ? allowed : refused);
                if (!may) continue;
                BOOST_TEST(star.centre == keep);
                BOOST_TEST(star.removed == remove);
                BOOST_TEST(star.link.size() == left);
                BOOST_TEST(star.oldFaces.size() == left + 2);
                BOOST_CHECK(facesAfter(surface, star) == faceSet(byHand.mesh.triangles));
            }
        }
    }
    BOOST_TEST(allowed > 500);
    BOOST_TEST(refused > 50);
    BOOST_TEST(small > 0);
}

BOOST_AUTO_TEST_CASE(half_a_surface_collapses_as_the_whole_does)
{
    int allowed = 0, refused = 0, ontoPlane = 0, alongPlane = 0;
    const BoundingGuard guard = test::guardOf(speck, true);
    std::vector<Mesh> wholes;
    for (const int resolution : {4, 5, 8}) wholes.push_back(guard.symmetrized(test::ball(resolution), 0.05));
    for (const std::size_t faces : {8U, 12U, 20U, 32U})
        wholes.push_back(decimate(wholes.back(), guard, test::to(faces, Effort::fast)));
    for (const Mesh& mesh : wholes) {
        const GuardedMesh surface(mesh, modelOf(guard));
        const auto edgesOnPlane = [&](const Whole& whole, const std::set<std::uint32_t>& onPlane) {
            // Of which the two triangles are on one side.
            std::map<std::pair<std::uint32_t, std::uint32_t>, std::set<bool>> sides;
            std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles;
            for (const Vec3I& t : whole.mesh.triangles) {
                for (int i = 0; i < 3; ++i) {
                    const std::uint32_t a = t[i], b = t[(i + 1) % 3], c = t[(i + 2) % 3];
                    if (onPlane.count(a) == 0 || onPlane.count(b) == 0) continue;
                    if (onPlane.count(c) > 0) return true; // a triangle in the plane
                    sides[std::minmax(a, b)].insert(c >= surface.vertices());
                    ++triangles[std::minmax(a, b)];
                }
            }
            return std::any_of(sides.begin(), sides.end(), [](const auto& side) { return side.second.size() < 2; });
        };
        for (std::uint32_t keep = 0; keep < surface.vertices(); ++keep) {
            if (!surface.isVertex(keep)) continue;
            for (const std::uint32_t remove : surface.neighbours(keep)) {
                StarChange star;
                const bool may = starOfCollapse(surface, keep, remove, star);
                ++(may ? allowed : refused);
                if (!may) continue;
                Whole byHand(surface);
                const bool isKeptOnPlane = surface.isOnPlane(keep), isRemovedOnPlane = surface.isOnPlane(remove);
                byHand.identify(remove, keep);
                if (byHand.image[remove] != remove) byHand.identify(byHand.image[remove], byHand.image[keep]);
                if (!isKeptOnPlane && isRemovedOnPlane) byHand.identify(byHand.image[keep], keep);
                BOOST_TEST(test::isClosedManifold(byHand.mesh));
                std::set<std::uint32_t> onPlane;
                for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
                    if (surface.isOnPlane(v)) onPlane.insert(v);
                }
                onPlane.erase(remove);
                if (isRemovedOnPlane) onPlane.insert(keep);
                BOOST_TEST(!edgesOnPlane(byHand, onPlane));
                BOOST_TEST(star.onPlane == (isKeptOnPlane || isRemovedOnPlane));
                ontoPlane += isKeptOnPlane != isRemovedOnPlane;
                alongPlane += isKeptOnPlane && isRemovedOnPlane;
                GuardedMesh changed = surface;
                const Vec3d& p = surface.point(isRemovedOnPlane ? remove : keep);
                changed.apply(star, p);
                BOOST_TEST(changed.isOnPlane(keep) == star.onPlane);
                BOOST_TEST(2 * changed.liveFaces() == byHand.mesh.triangles.size());
            }
        }
    }
    BOOST_TEST(allowed > 100);
    BOOST_TEST(refused > 40);
    BOOST_TEST(ontoPlane > 20);
    BOOST_TEST(alongPlane > 20);
}

BOOST_AUTO_TEST_CASE(a_split_puts_a_vertex_on_an_edge)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(speck, isSymmetric);
        const Mesh whole = isSymmetric ? guard.symmetrized(test::ball(6), 0.04) : test::ball(6);
        const GuardedMesh surface(whole, modelOf(guard));
        int onPlane = 0;
        for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
            if (!surface.isVertex(u)) continue;
            for (const std::uint32_t v : surface.neighbours(u)) {
                const StarChange star = starOfSplit(surface, u, v);
                BOOST_TEST(star.centre == surface.vertices());
                BOOST_TEST(star.onPlane == (surface.isOnPlane(u) && surface.isOnPlane(v)));
                onPlane += star.onPlane;
                std::vector<Vec3I> byHand; // each face with both ends is two
                for (const Vec3I& t : test::triangleMesh(surface).triangles) {
                    if (!test::hasCorner(t, u) || !test::hasCorner(t, v)) {
                        byHand.push_back(t);
                        continue;
                    }
                    for (const std::uint32_t end : {u, v}) {
                        Vec3I half = t;
                        for (int i = 0; i < 3; ++i) half[i] = half[i] == end ? star.centre : half[i];
                        byHand.push_back(half);
                    }
                }
                BOOST_CHECK(facesAfter(surface, star) == faceSet(byHand));
                GuardedMesh changed = surface;
                changed.apply(star, rounded(surface, star, 0.5 * (surface.point(u) + surface.point(v))));
                BOOST_CHECK(faceSet(test::triangleMesh(changed).triangles) == faceSet(byHand));
                BOOST_TEST(test::isClosedManifold(changed.mesh()));
            }
        }
        BOOST_TEST((onPlane > 0) == isSymmetric);
    }
}

BOOST_AUTO_TEST_CASE(faces_that_are_a_disk_without_a_vertex_inside_make_a_star)
{
    int disks = 0, others = 0;
    std::mt19937 random(3);
    const BoundingGuard guard(speck);
    for (const Mesh& mesh : surfaces()) {
        const GuardedMesh surface(mesh, modelOf(guard));
        for (int i = 0; i < 300; ++i) {
            const StarChange::Faces faces = connectedFaces(surface, random, 1 + random() % 9);
            const Patch patch(surface, faces);
            StarChange star;
            const bool isStar = starOfFaces(surface, faces, false, star);
            BOOST_TEST(isStar == (patch.isDisk && patch.inside.empty()));
            ++(isStar ? disks : others);
            if (!isStar) continue;
            GuardedMesh changed = surface;
            changed.apply(star, rounded(surface, star, surface.point(star.link[0][0])));
            BOOST_TEST(changed.liveFaces() == surface.liveFaces() + 2);
            BOOST_TEST(test::isClosedManifold(changed.mesh()));
            BOOST_TEST(test::listsAreRight(changed));
        }
    }
    BOOST_TEST(disks > 500);
    BOOST_TEST(others > 200);
}

BOOST_AUTO_TEST_CASE(faces_around_one_vertex_or_two_make_a_star)
{
    int made[2] = {}, refused[2] = {};
    std::mt19937 random(5);
    const BoundingGuard guard(speck);
    for (const Mesh& mesh : surfaces()) {
        const GuardedMesh surface(mesh, modelOf(guard));
        for (int i = 0; i < 300; ++i) {
            const auto centre = static_cast<std::uint32_t>(random() % surface.vertices());
            const bool hasRemoved = i % 2 != 0;
            const auto neighbours = surface.neighbours(centre);
            const std::uint32_t removed =
                hasRemoved ? neighbours[random() % neighbours.size()] : static_cast<std::uint32_t>(StarChange::none);
            StarChange::Faces faces;
            const auto add = [&](std::uint32_t f) {
                if (std::find(faces.begin(), faces.end(), f) == faces.end()) faces.push_back(f);
            };
            for (const std::uint32_t f : surface.facesOf(centre)) add(f);
            if (hasRemoved) {
                for (const std::uint32_t f : surface.facesOf(removed)) add(f);
            }
            for (auto more = random() % 3; more > 0; --more) { // and one across a side of these
                const Vec3I& t = surface.face(faces[random() % faces.size()]);
                const int side = static_cast<int>(random() % 3);
                for (const std::uint32_t f : surface.facesOf(t[side])) {
                    if (test::hasCorner(surface.face(f), t[(side + 1) % 3])) add(f);
                }
            }
            const Patch patch(surface, faces);
            std::set<std::uint32_t> expected{centre};
            if (hasRemoved) expected.insert(removed);
            StarChange star;
            const bool isStar = starOfPatch(surface, centre, removed, faces, star);
            BOOST_TEST(isStar == (patch.isDisk && patch.inside == expected));
            ++(isStar ? made : refused)[hasRemoved ? 1 : 0];
            if (!isStar) continue;
            GuardedMesh changed = surface;
            changed.apply(star, surface.point(centre));
            BOOST_TEST(changed.liveFaces() == surface.liveFaces() - (hasRemoved ? 2U : 0U));
            BOOST_TEST(test::isClosedManifold(changed.mesh()));
            if (hasRemoved) BOOST_TEST(!changed.isVertex(removed));
        }
    }
    for (const int i : {0, 1}) {
        BOOST_TEST(made[i] > 200);
        BOOST_TEST(refused[i] > 100);
    }
}

// The volume grows fastest that way.
BOOST_AUTO_TEST_CASE(outward_is_where_the_enclosed_volume_grows)
{
    for (const bool isSymmetric : {false, true}) {
        const BoundingGuard guard = test::guardOf(speck, isSymmetric);
        const Mesh ball = test::ball(7), whole = isSymmetric ? guard.symmetrized(ball, 0.03) : ball;
        const GuardedMesh surface(whole, modelOf(guard));
        const auto volumeAt = [&](const StarChange& star, const Vec3d& p) {
            double sum = 0;
            for (std::size_t i = 0; i < star.link.size(); ++i) {
                const Corners t = starCorners(surface, star, i, p);
                sum += t[0].dot(t[1].cross(t[2])) / 6;
            }
            return sum;
        };
        std::mt19937 random(1);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            if (!surface.isVertex(v)) continue;
            const StarChange star = starOf(surface, v);
            const Vec3d up = outward(surface, star), p = surface.point(v);
            BOOST_TEST(std::abs(up.length() - 1) < 1e-12);
            if (star.onPlane) BOOST_TEST(up[0] == 0);
            const double growth = volumeAt(star, p + up) - volumeAt(star, p);
            BOOST_TEST(growth > 0);
            for (int i = 0; i < 5; ++i) {
                Vec3d other = test::randomVector(random);
                if (star.onPlane) other[0] = 0;
                other.normalize();
                BOOST_TEST(std::abs(volumeAt(star, p + other) - volumeAt(star, p) - other.dot(up) * growth) < 1e-9);
            }
            const Vec3d place = rounded(surface, star, p + 0.01 * test::randomVector(random));
            BOOST_TEST(place == modelOf(guard).rounded(place));
            if (star.onPlane) BOOST_TEST(place[0] == 0);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
