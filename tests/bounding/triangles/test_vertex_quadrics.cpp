// Costs of collapses, against sums over the faces around the two vertices.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>

#include "bounding/support/guarded_surface.h"
#include "bounding/support/lump.h"
#include "support/shapes.h"
#include "support/surface_models.h"

using namespace vdbcage;
using namespace vdbcage::detail;

namespace {

constexpr double spreadWeight = 1e-3;

/// A triangle of a surface, or its mirror image, with what it counts for at each of its corners.
struct Share {
    Corners corners;
    double weight;
};

/// What a place costs: of each triangle its share times the squared distance to its plane, and a little of that to its
/// middle.
double costByFaces(const std::vector<Share>& shares, const Vec3d& p)
{
    double sum = 0;
    for (const auto& [t, weight] : shares) {
        const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
        const double height = normal.unit().dot(p - t[0]);
        sum += weight * (height * height + spreadWeight * (p - (t[0] + t[1] + t[2]) / 3.0).lengthSqr());
    }
    return sum;
}

std::vector<Share> sharesAt(const GuardedMesh& surface, const std::vector<std::uint32_t>& vertices, double weight = 1)
{
    std::vector<Share> shares;
    for (const std::uint32_t v : vertices) {
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            if (!surface.isFace(f) || !test::hasCorner(surface.face(f), v)) continue;
            const Corners t = surface.corners(f);
            shares.push_back({t, weight * (t[1] - t[0]).cross(t[2] - t[0]).length() / 6});
        }
    }
    return shares;
}

} // namespace

BOOST_AUTO_TEST_SUITE(vertex_quadrics)

BOOST_AUTO_TEST_CASE(a_place_costs_its_distances_to_the_planes_of_the_faces)
{
    std::mt19937 random(1);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const test::Lump lump(seed);
        const GuardedMesh surface(lump.surface, modelOf(lump.guard));
        VertexQuadrics quadrics(surface);
        for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
            const std::uint32_t v = surface.neighbours(u)[0];
            const Vec3d p = surface.point(u) + test::randomVector(random, 5);
            const double expected = costByFaces(sharesAt(surface, {u, v}), p);
            BOOST_TEST(quadrics.cost(quadrics.sum(u, v), p) == expected, boost::test_tools::tolerance(1e-9));
        }
        // What is merged counts on.
        std::vector<std::uint32_t> merged{0};
        for (int i = 0; i < 10; ++i) {
            merged.push_back(static_cast<std::uint32_t>(random() % surface.vertices()));
            quadrics.merge(0, merged.back());
            const Vec3d p = surface.point(0) + test::randomVector(random, 5);
            BOOST_TEST(quadrics.cost(quadrics.of(0), p) == costByFaces(sharesAt(surface, merged), p),
                       boost::test_tools::tolerance(1e-9));
        }
        const Quadric before = quadrics.of(1);
        quadrics.merge(1, 2);
        quadrics.set(1, before);
        BOOST_TEST(quadrics.cost(quadrics.of(1), Vec3d(1, 2, 3)) == quadrics.cost(before, Vec3d(1, 2, 3)));
    }
}

BOOST_AUTO_TEST_CASE(on_the_plane_of_symmetry_both_halves_count)
{
    std::mt19937 random(2);
    const BoundingGuard guard = test::guardOf(test::soup(1, 20, 0.1), true);
    const GuardedMesh surface(guard.symmetrized(test::ball(7), 0.03), modelOf(guard));
    const VertexQuadrics quadrics(surface);
    int alongPlane = 0, ontoPlane = 0;
    for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
        if (!surface.isVertex(u)) continue;
        for (const std::uint32_t v : surface.neighbours(u)) {
            const int onPlane = int(surface.isOnPlane(u)) + surface.isOnPlane(v);
            if (onPlane == 0) continue;
            ++(onPlane == 2 ? alongPlane : ontoPlane);
            // An edge on the plane takes two faces away, others four: it is to cost as much a face.
            const double weight = onPlane == 2 ? 1 : 0.5;
            std::vector<Share> shares = sharesAt(surface, {u, v}, weight);
            const std::size_t half = shares.size();
            for (std::size_t i = 0; i < half; ++i) {
                Share image = shares[i];
                for (Vec3d& p : image.corners) p = modelOf(guard).mirrored(p);
                shares.push_back(image);
            }
            Vec3d p = surface.point(u) + test::randomVector(random, 0.5);
            p[0] = 0;
            BOOST_TEST(quadrics.cost(quadrics.sum(u, v), p) == costByFaces(shares, p),
                       boost::test_tools::tolerance(1e-9));
            const Vec3d best = quadrics.optimum(quadrics.sum(u, v), u, v);
            BOOST_TEST(std::abs(best[0]) < 1e-9);
        }
    }
    BOOST_TEST(alongPlane > 20);
    BOOST_TEST(ontoPlane > 20);
}

BOOST_AUTO_TEST_CASE(the_optimum_is_about_as_cheap_as_any_place_near_the_edge)
{
    std::mt19937 random(3);
    int atMiddle = 0, elsewhere = 0;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const test::Lump lump(seed);
        Mesh rough = lump.surface;
        for (Vec3d& p : rough.points) p += test::randomVector(random, 0.15);
        const GuardedMesh surface(rough, modelOf(lump.guard));
        const VertexQuadrics quadrics(surface);
        for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
            for (const std::uint32_t v : surface.neighbours(u)) {
                const Quadric q = quadrics.sum(u, v);
                const Vec3d a = surface.point(u), b = surface.point(v), middle = 0.5 * (a + b);
                const double length = (a - b).length();
                const Vec3d best = quadrics.optimum(q, u, v);
                BOOST_TEST((best - middle).length() <= 2.000001 * length);
                Vec3d free;
                const bool isFound = q.bestPlace(VertexQuadrics::stiffness, free);
                BOOST_TEST(quadrics.optimum(isFound, free, u, v) == best);
                BOOST_TEST(quadrics.optimum(false, free, u, v) == middle);
                ++(best == middle ? atMiddle : elsewhere);
                if (best == middle) continue;
                double cheapest = quadrics.cost(q, best);
                for (int i = 0; i < 20; ++i) {
                    const Vec3d p = best + (i % 2 == 0 ? 0.01 : 0.5) * length * test::randomVector(random);
                    cheapest = std::min(cheapest, quadrics.cost(q, p));
                }
                const double scale = quadrics.cost(q, best + Vec3d(length));
                BOOST_TEST(quadrics.cost(q, best) <= cheapest + 0.01 * scale);
            }
        }
    }
    BOOST_TEST(elsewhere > 1000);
    BOOST_TEST(atMiddle > 0);
}

BOOST_AUTO_TEST_CASE(a_place_that_is_found_is_allowed_and_sliding_makes_it_cheaper)
{
    int found = 0, none = 0, best = 0, cheaper = 0;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const BoundingGuard guard(test::speckled(seed, 3), test::Lump::close());
        const GuardedMesh surface(test::Lump(seed).surface, modelOf(guard));
        const VertexQuadrics quadrics(surface);
        for (std::uint32_t u = 0; u < surface.vertices(); ++u) {
            for (const std::uint32_t v : surface.neighbours(u)) {
                StarChange star;
                if (!starOfCollapse(surface, u, v, star)) continue;
                const Quadric q = quadrics.sum(u, v);
                const Vec3d optimum = rounded(surface, star, quadrics.optimum(q, u, v));
                const auto place = quadrics.findPlace(star, q, false), slid = quadrics.findPlace(star, q, true);
                BOOST_TEST(place.has_value() == slid.has_value());
                ++(place ? found : none);
                const bool mayBeBest = allows(surface, star, optimum);
                if (mayBeBest) BOOST_TEST((place && *place == optimum && *slid == optimum));
                best += mayBeBest;
                if (!place) continue;
                BOOST_TEST(allows(surface, star, *place));
                BOOST_TEST(allows(surface, star, *slid));
                BOOST_TEST(quadrics.cost(q, *slid) <= quadrics.cost(q, *place));
                cheaper += quadrics.cost(q, *slid) < quadrics.cost(q, *place);
            }
        }
    }
    for (const int count : {found, none, best, cheaper}) BOOST_TEST(count > 20);
}

BOOST_AUTO_TEST_CASE(a_density_counts_in_the_fifth_power)
{
    const BoundingGuard guard(test::sphere({0, 0, 0}, 0.4, 20));
    FaceWishOptions options;
    options.density.regions.push_back({FactorRegion::Shape::box, {0, -1, -1}, {1, 1, 1}, 0, 1.5});
    const FaceWishes wishes(guard, options);
    const GuardedMesh plain(test::ball(10), modelOf(guard)),
        dense(test::ball(10), modelOf(guard), GuardedMesh::Quads::split, wishes);
    const VertexQuadrics without(plain), with(dense);
    for (std::uint32_t v = 0; v < plain.vertices(); ++v) {
        const Vec3d p = plain.point(v);
        if (std::abs(p[0]) < 0.3) continue;
        const double weight = p[0] > 0 ? std::pow(1.5, 5) : 1;
        const Vec3d at = p + Vec3d(0.1, 0.2, 0.3);
        BOOST_TEST(with.cost(with.of(v), at) == weight * without.cost(without.of(v), at),
                   boost::test_tools::tolerance(1e-9));
    }
}

BOOST_AUTO_TEST_SUITE_END()
