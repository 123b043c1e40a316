// What the guard allows, against the definition: the change is made, and the surface that it leaves is judged by
// looking at every pair of triangles, every face of the model and every part of it.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/geometry/quad_shape.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "bounding/support/spacing.h"
#include "support/shapes.h"
#include "support/surface_models.h"
#include "support/symmetric.h"

using namespace vdbcage;
using namespace vdbcage::detail;
using openvdb::Vec4I;

namespace {

constexpr double leastAngle = 10 * pi / 180;

/// A lump around specks: a part of the model each, some near its surface.
struct Specks {
    explicit Specks(unsigned seed) : surface(test::Lump(seed).surface), guard(test::speckled(seed, 2), options()) {}
    static GuardOptions options()
    {
        GuardOptions options;
        options.clearance = 1e-3;
        options.minAngleDegrees = 10;
        options.spacing = 0.01;
        return options;
    }

    Mesh surface;
    BoundingGuard guard;
};

double smallestAngle(const Corners& t)
{
    double least = pi;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d u = t[(i + 1) % 3] - t[i], v = t[(i + 2) % 3] - t[i];
        least = std::min(least, std::acos(std::clamp(u.dot(v) / (u.length() * v.length()), -1.0, 1.0)));
    }
    return least;
}

/// Whether a ray from p, through some box about the surface, leaves it once more than it enters.
bool isInside(const Vec3d& p, const std::vector<Corners>& surface)
{
    const Vec3d ray(0.36271, 0.8127, 0.4561);
    int winding = 0;
    for (const Corners& t : surface) {
        const double volume = (t[1] - t[0]).cross(t[2] - t[0]).dot(ray);
        if (!((t[0] - p).dot((t[1] - t[0]).cross(t[2] - t[0])) * volume > 0)) continue; // behind
        bool isHit = true;
        for (std::size_t i = 0; i < 3; ++i)
            isHit = isHit && ((t[i] - p).cross(t[(i + 1) % 3] - p).dot(ray) > 0) == (volume > 0);
        if (isHit) winding += volume > 0 ? 1 : -1;
    }
    return winding == 1;
}

double longestEdge(const Corners& t)
{
    return std::max({(t[1] - t[0]).length(), (t[2] - t[1]).length(), (t[0] - t[2]).length()});
}

/// The distance of two triangles, or `enough` where balls around them are farther apart than that.
double distance(const Corners& s, const Corners& t, double enough)
{
    const Vec3d middle = (s[0] + s[1] + s[2]) / 3.0, other = (t[0] + t[1] + t[2]) / 3.0;
    if ((middle - other).length() > longestEdge(s) + longestEdge(t) + enough) return enough;
    return std::sqrt(nearness(s, t).squaredDistance);
}

/// Whether two triangles of the surface are nearer to each other than they may be.
bool areTooNear(const GuardedMesh& surface, std::uint32_t f, std::uint32_t g)
{
    const Spacing& spacing = surface.guard().spacing();
    const Corners s = surface.corners(f), t = surface.corners(g);
    int shared = 0;
    for (int i = 0; i < 3; ++i) shared += test::hasCorner(surface.face(g), surface.face(f)[i]);
    if (shared == 0) {
        const double least = std::min(spacing.distance, spacing.share * std::min(longestEdge(s), longestEdge(t)));
        return distance(s, t, least) < least;
    }
    if (shared == 1) return tooNear({surface.face(f), s}, {surface.face(g), t}, spacing);
    const Vec3d n = (s[1] - s[0]).cross(s[2] - s[0]), m = (t[1] - t[0]).cross(t[2] - t[0]);
    return shared == 3 || (n.dot(m) < 0 && n.cross(m).length() <= spacing.sine * n.length() * m.length());
}

/// What is wrong with the faces around a vertex.
struct Faults {
    bool shape = false, model = false, surface = false, swept = false;

    bool any() const { return shape || model || surface || swept; }
    bool only(bool Faults::*fault) const { return this->*fault && int(shape) + model + surface + swept == 1; }
};

Faults faultsAt(const GuardedMesh& surface, std::uint32_t v, double least)
{
    Faults faults;
    const std::vector<std::uint32_t> all = test::facesAndAlternates(surface);
    const GuardModel& guard = surface.guard();
    for (const std::uint32_t f : all) {
        if (!test::hasCorner(surface.face(f), v)) continue;
        const Corners t = surface.corners(f);
        faults.shape = faults.shape || hasNoArea(t) || !(smallestAngle(t) >= least);
        for (const TriangleBvh::Item& item : guard.tree().items()) {
            const double clearance = guard.clearance();
            faults.model = faults.model || distance(t, guard.tree().corners(item), clearance) < clearance;
        }
        for (const std::uint32_t g : all) {
            if (g == f || surface.areAlternatives(f, g)) continue;
            faults.surface = faults.surface || areTooNear(surface, f, g);
        }
        if (!surface.isInQuad(f)) continue;
        const Vec4I q = surface.quadOf(f);
        double deviation;
        faults.shape = faults.shape || !isConvexQuad({surface.point(q[0]), surface.point(q[1]), surface.point(q[2]),
                                                      surface.point(q[3])},
                                                     surface.leastQuadCosine(), deviation);
    }
    for (const bool isFirst : {true, false}) { // the quads split by one diagonal, then by the other
        std::vector<Corners> triangles;
        for (const std::uint32_t f : all) {
            if (!surface.isInQuad(f) || surface.isFace(f) == isFirst) triangles.push_back(surface.corners(f));
        }
        for (const TriangleBvh::Item& item : guard.tree().items()) {
            faults.swept = faults.swept || !isInside(guard.tree().corners(item)[0], triangles);
        }
    }
    return faults;
}

/// The star of a random change, one of the first of moves, collapses, splits and flips, and a place for it that is
/// often near what is in its way.
bool findStar(const GuardedMesh& surface, std::mt19937& random, StarChange& star, Vec3d& place, unsigned kinds = 4)
{
    const auto v = static_cast<std::uint32_t>(random() % surface.vertices());
    if (!surface.isVertex(v)) return false;
    const auto change = test::randomChange(surface, v, random, kinds);
    if (!change) return false;
    star = change->star;
    const double far = std::array<double, 4>{0.05, 0.2, 0.6, 2.0}[random() % 4];
    place = rounded(surface, star, change->start + test::randomVector(random, far * change->size));
    return true;
}

std::size_t tooNearPairs(const GuardedMesh& surface)
{
    const std::vector<std::uint32_t> all = test::facesAndAlternates(surface);
    std::size_t count = 0;
    for (const std::uint32_t f : all) {
        for (const std::uint32_t g : all) count += f < g && !surface.areAlternatives(f, g) && areTooNear(surface, f, g);
    }
    return count;
}

} // namespace

BOOST_AUTO_TEST_SUITE(admissible)

BOOST_AUTO_TEST_CASE(exactly_the_changes_that_leave_a_good_surface_are_allowed)
{
    int allowed = 0, shape = 0, model = 0, ofSurface = 0, swept = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Specks specks(seed);
        GuardedMesh surface(specks.surface, modelOf(specks.guard));
        BOOST_REQUIRE(specks.guard.facesTooNear(specks.surface).empty());
        BOOST_REQUIRE(tooNearPairs(surface) == 0);
        std::mt19937 random(seed);
        for (int i = 0; i < 250; ++i) {
            StarChange star;
            Vec3d place;
            if (!findStar(surface, random, star, place)) continue;
            GuardedMesh changed = surface;
            changed.apply(star, place);
            const Faults faults = faultsAt(changed, star.centre, leastAngle);
            const bool may = allows(surface, star, place);
            BOOST_TEST(may == !faults.any());
            allowed += may;
            shape += faults.only(&Faults::shape);
            model += faults.only(&Faults::model);
            ofSurface += faults.only(&Faults::surface);
            swept += faults.only(&Faults::swept);
            if (may && i % 4 == 0) surface = std::move(changed); // so that surfaces get rough
        }
    }
    BOOST_TEST(allowed > 100);
    for (const int alone : {shape, model, ofSurface, swept}) BOOST_TEST(alone > 10);
}

BOOST_AUTO_TEST_CASE(with_quads_exactly_the_moves_that_leave_both_diagonals_good_are_allowed)
{
    int allowed = 0, refused = 0, byAlternate = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Specks specks(seed);
        GuardedMesh surface(specks.surface, modelOf(specks.guard), GuardedMesh::Quads::keep);
        BOOST_REQUIRE(surface.quads() > 10U);
        BOOST_REQUIRE(tooNearPairs(surface) == 0);
        std::mt19937 random(seed);
        for (int i = 0; i < 150; ++i) {
            StarChange star;
            Vec3d place;
            if (!findStar(surface, random, star, place)) continue;
            GuardedMesh changed = surface;
            changed.apply(star, place);
            const bool isGood = !faultsAt(changed, star.centre, leastAngle).any();
            const bool may = allows(surface, star, place);
            BOOST_TEST(may == isGood);
            ++(may ? allowed : refused);
            if (!may) { // some only for the other diagonal
                const GuardedMesh split(surface.mesh(), modelOf(specks.guard));
                byAlternate += allows(split, starOf(split, star.centre), place);
            }
            if (may && i % 4 == 0) surface = std::move(changed);
        }
    }
    BOOST_TEST(allowed > 100);
    BOOST_TEST(refused > 100);
    BOOST_TEST(byAlternate > 10);
}

BOOST_AUTO_TEST_CASE(a_worse_angle_is_allowed_nowhere_but_what_is_bad_may_get_better)
{
    int better = 0, worse = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        Specks specks(seed);
        GuardOptions strict = Specks::options();
        strict.minAngleDegrees = 30;
        const BoundingGuard guard(test::speckled(seed, 2), strict);
        std::mt19937 random(seed);
        GuardedMesh surface(specks.surface, modelOf(specks.guard));
        for (int i = 0; i < 60; ++i) { // rough, with angles of 10 degrees and more
            StarChange star;
            Vec3d place;
            if (findStar(surface, random, star, place) && allows(surface, star, place)) surface.apply(star, place);
        }
        const GuardedMesh rough(surface.mesh(), modelOf(guard));
        for (std::uint32_t v = 0; v < rough.vertices(); ++v) {
            const StarChange star = starOf(rough, v);
            const auto leastAt = [&](const Vec3d& p) {
                double least = pi;
                for (std::size_t i = 0; i < star.link.size(); ++i)
                    least = std::min(least, smallestAngle(starCorners(rough, star, i, p)));
                return least;
            };
            for (int i = 0; i < 3; ++i) {
                const Vec3d place = rounded(rough, star, rough.point(v) + test::randomVector(random, 0.3));
                const double before = leastAt(rough.point(v)), after = leastAt(place);
                GuardedMesh changed = rough;
                changed.apply(star, place);
                const bool isGood = !faultsAt(changed, v, std::min(before, pi / 6)).any();
                BOOST_TEST(allows(rough, star, place) == isGood);
                if (before < pi / 6) (after < before ? worse : better) += isGood || after < before;
            }
        }
    }
    BOOST_TEST(better > 20);
    BOOST_TEST(worse > 20);
}

BOOST_AUTO_TEST_CASE(no_two_triangles_cross_after_many_changes)
{
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    const auto exact = [](const Corners& t) {
        const auto point = [](const Vec3d& p) { return Kernel::Point_3(p[0], p[1], p[2]); };
        return Kernel::Triangle_3(point(t[0]), point(t[1]), point(t[2]));
    };
    for (const bool isSymmetric : {false, true}) {
        const Mesh model = test::soup(5, 20, 0.15);
        const BoundingGuard guard = test::guardOf(model, isSymmetric);
        const Mesh start = isSymmetric ? guard.symmetrized(test::ball(9), 0.03) : test::ball(9);
        GuardedMesh surface(start, modelOf(guard));
        std::mt19937 random(9);
        int made = 0;
        for (int i = 0; i < 3000; ++i) {
            StarChange star;
            Vec3d place;
            if (!findStar(surface, random, star, place) || !allows(surface, star, place)) continue;
            surface.apply(star, place);
            ++made;
        }
        BOOST_TEST(made > 300);
        const Mesh mesh = surface.mesh();
        BOOST_TEST(checkCage(mesh, model).bounding());
        BOOST_TEST(guard.facesTooNear(mesh).empty());
        BOOST_TEST(test::pairsTooNear(mesh, guard, 0.99) == 0U);
        if (isSymmetric) {
            BOOST_CHECK(test::isSymmetric(mesh, *guard.symmetry()));
            BOOST_TEST(checkCage(mesh, test::mirrored(model, *guard.symmetry())).bounding());
        }
        std::size_t crossings = 0;
        for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
            for (std::size_t g = 0; g < f; ++g) {
                const Vec3I &s = mesh.triangles[f], &t = mesh.triangles[g];
                if (test::hasCorner(s, t[0]) || test::hasCorner(s, t[1]) || test::hasCorner(s, t[2])) continue;
                const auto corners = [&](const Vec3I& at) {
                    return Corners{mesh.points[at[0]], mesh.points[at[1]], mesh.points[at[2]]};
                };
                crossings += CGAL::do_intersect(exact(corners(s)), exact(corners(t)));
            }
        }
        BOOST_TEST(crossings == 0U);
    }
}

BOOST_AUTO_TEST_CASE(what_was_learned_of_an_obstacle_does_not_change_an_answer)
{
    int learned = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const Specks specks(seed);
        const GuardedMesh surface(specks.surface, modelOf(specks.guard));
        std::mt19937 random(seed);
        for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
            const StarChange star = starOf(surface, v);
            Obstacle obstacle;
            for (int i = 0; i < 10; ++i) {
                const Vec3d place = rounded(surface, star, surface.point(v) + test::randomVector(random, 0.5));
                learned += obstacle.item != TriangleBvh::none;
                BOOST_TEST(allows(surface, star, place, &obstacle) == allows(surface, star, place));
                // Its first triangles keep clear of the model, the next one does not.
                const auto isClear = [&](std::size_t k) {
                    return surface.guard().clear(starCorners(surface, star, k, place), TriangleBvh::none, nullptr);
                };
                for (std::size_t k = 0; k < obstacle.clear; ++k) BOOST_TEST(isClear(k));
            }
        }
    }
    BOOST_TEST(learned > 100);
}

BOOST_AUTO_TEST_CASE(quads_are_made_exactly_where_both_diagonals_are_good)
{
    int made = 0, refused = 0;
    for (unsigned seed = 1; seed <= 2; ++seed) {
        const Specks specks(seed);
        GuardedMesh surface(specks.surface, modelOf(specks.guard));
        std::mt19937 random(seed);
        for (int i = 0; i < 150; ++i) {
            StarChange star;
            Vec3d place;
            if (findStar(surface, random, star, place) && allows(surface, star, place)) surface.apply(star, place);
        }
        const double fold = seed % 2 == 0 ? 90 : 40;
        surface.limitQuadFold(fold);
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            for (std::uint32_t g = f + 1; g < surface.faces(); ++g) {
                if (!surface.isFace(f) || !surface.isFace(g) || surface.isInQuad(f) || surface.isInQuad(g)) continue;
                int shared = 0;
                for (int k = 0; k < 3; ++k) shared += test::hasCorner(surface.face(f), surface.face(g)[k]);
                if (shared != 2) continue;
                const Vec4I q = surface.quadOf(f, g);
                const std::vector<std::uint32_t> joined = test::neighboursByFaces(surface, q[1]);
                bool isGood = !std::binary_search(joined.begin(), joined.end(), q[3]);
                const GuardedMesh before = surface;
                if (isGood) { // as if it were made
                    GuardedMesh quad = surface;
                    quad.pair(f, g, {Vec3I(q[0], q[1], q[3]), Vec3I(q[1], q[2], q[3])});
                    for (const std::uint32_t v : {q[1], q[3]}) { // between them they have both alternates and all faces
                        const Faults faults = faultsAt(quad, v, leastAngle);
                        isGood = isGood && !faults.any();
                    }
                    const auto angle = [&](const Vec3I& s, const Vec3I& t) {
                        const auto normal = [&](const Vec3I& at) {
                            const Vec3d& p = surface.point(at[0]);
                            return (surface.point(at[1]) - p).cross(surface.point(at[2]) - p);
                        };
                        return angleDegrees(normal(s), normal(t));
                    };
                    isGood = isGood && angle({q[0], q[1], q[3]}, {q[1], q[2], q[3]}) < fold &&
                             angle(surface.face(f), surface.face(g)) < fold;
                }
                BOOST_TEST(makeQuad(surface, f, g) == isGood);
                ++(isGood ? made : refused);
                if (!isGood) BOOST_TEST(test::sameSurface(surface, before));
            }
        }
        BOOST_TEST(test::listsAreRight(surface));
        BOOST_TEST(tooNearPairs(surface) == 0);
    }
    BOOST_TEST(made > 100);
    BOOST_TEST(refused > 100);
}

// What a batch makes is good, though each change was decided before all of them.
BOOST_AUTO_TEST_CASE(changes_of_a_batch_are_good_together)
{
    int made = 0, left = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Specks specks(seed);
        GuardedMesh surface(specks.surface, modelOf(specks.guard));
        std::mt19937 random(seed);
        for (int round = 0; round < 6; ++round) {
            std::vector<std::pair<StarChange, Vec3d>> changes;
            for (int i = 0; i < 60; ++i) {
                StarChange star;
                Vec3d place;
                if (!findStar(surface, random, star, place, 2) || !allows(surface, star, place)) continue;
                changes.emplace_back(star, place);
            }
            std::vector<std::uint32_t> moved;
            {
                Batch batch(surface);
                for (const auto& [star, place] : changes) {
                    const auto isMoved = [&](std::uint32_t v) {
                        return std::find(moved.begin(), moved.end(), v) != moved.end();
                    };
                    bool isTouched = isMoved(star.centre) || isMoved(star.removed);
                    for (const auto& edge : star.link) isTouched = isTouched || isMoved(edge[0]) || isMoved(edge[1]);
                    const bool isMade = batch.apply(star, place);
                    if (isTouched) BOOST_TEST(!isMade);
                    ++(isMade ? made : left);
                    if (!isMade) continue;
                    moved.push_back(star.centre);
                    if (star.removed != StarChange::none) moved.push_back(star.removed);
                    BOOST_TEST(surface.point(star.centre) == place);
                }
            }
            BOOST_TEST(test::listsAreRight(surface));
            BOOST_TEST(test::treeIsRight(surface));
            BOOST_TEST(tooNearPairs(surface) == 0);
            for (const std::uint32_t v : moved) {
                if (surface.isVertex(v)) BOOST_TEST(!faultsAt(surface, v, leastAngle).any());
            }
        }
    }
    BOOST_TEST(made > 300);
    BOOST_TEST(left > 100);
}

BOOST_AUTO_TEST_CASE(the_first_height_that_is_allowed_is_taken)
{
    constexpr std::array<double, 4> heights{0.0, 0.05, 0.2, 0.5};
    std::array<int, 5> taken{};
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const Specks specks(seed);
        const GuardedMesh surface(specks.surface, modelOf(specks.guard));
        std::mt19937 random(seed);
        for (int i = 0; i < 200; ++i) {
            StarChange star;
            Vec3d place;
            if (!findStar(surface, random, star, place)) continue;
            std::size_t first = 0;
            const auto at = [&](std::size_t k) {
                return rounded(surface, star, place + heights[k] * (2.0 * outward(surface, star)));
            };
            while (first < 4 && !allows(surface, star, at(first))) ++first;
            ++taken[first];
            GuardedMesh changed = surface;
            BOOST_TEST(applyNear(changed, star, place, 2, heights) == (first < 4));
            if (first < 4) {
                BOOST_TEST(changed.point(star.centre) == at(first));
            } else {
                BOOST_TEST(test::sameSurface(changed, surface));
            }
        }
    }
    for (const int count : taken) BOOST_TEST(count > 5);
}

BOOST_AUTO_TEST_SUITE_END()
