#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "cages.h"
#include "meshes.h"
#include <support/topology_count.h>
#include <tools/edit/soft.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec3d;

namespace {

/// By Floyd and Warshall, and the curve as it is written down.
std::vector<double> reference(const Mesh& mesh, const std::vector<Index>& selected, double radius)
{
    const std::size_t n = mesh.points.size();
    const double infinite = std::numeric_limits<double>::infinity();
    std::vector<std::vector<double>> distance(n, std::vector<double>(n, infinite));
    for (std::size_t i = 0; i < n; ++i) distance[i][i] = 0;
    for (const auto& face : test::polygons(mesh)) {
        for (const Index a : face) {
            for (const Index b : face) distance[a][b] = (mesh.points[a] - mesh.points[b]).length();
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                distance[i][j] = std::min(distance[i][j], distance[i][k] + distance[k][j]);
            }
        }
    }
    std::vector<double> weights(n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        double nearest = infinite;
        for (const Index point : selected) nearest = std::min(nearest, distance[i][point]);
        const double t = nearest / radius;
        if (nearest < radius) weights[i] = 1 - 3 * t * t + 2 * t * t * t;
        if (nearest == 0) weights[i] = 1;
    }
    return weights;
}

} // namespace

BOOST_AUTO_TEST_SUITE(soft)

BOOST_AUTO_TEST_CASE(weights_are_those_of_all_shortest_paths)
{
    std::vector<Mesh> meshes{test::sphere({0, 0, 0}, 1, 5), test::torus(2, 0.5, 9, 5)};
    for (unsigned seed = 0; seed < 40; ++seed) meshes.push_back(test::randomFaces(seed));
    std::mt19937 random(1);
    std::size_t between = 0;
    for (const Mesh& mesh : meshes) {
        const Elements elements(mesh);
        for (const double radius : {0.0, 0.3, 1.0, 5.0}) {
            const auto selected = test::someOf(elements, Element::point, random, 8).ids;
            const auto weights = softWeights(elements, mesh.points, selected, radius);
            const auto expected = reference(mesh, selected, radius);
            for (std::size_t i = 0; i < weights.size(); ++i) {
                BOOST_TEST(std::abs(weights[i] - expected[i]) < 1e-12);
                between += weights[i] > 0 && weights[i] < 1;
            }
            for (const Index point : selected) BOOST_TEST(weights[point] == 1);
            if (radius == 0) {
                BOOST_TEST(std::accumulate(weights.begin(), weights.end(), 0.0) == double(selected.size()));
            }
        }
    }
    BOOST_TEST(between > 300U);
}

BOOST_AUTO_TEST_CASE(nothing_jumps_to_another_part_nearby)
{
    const Mesh legs = test::joined(test::box({0, 0, 0}, {1, 1, 5}), test::box({1.01, 0, 0}, {2, 1, 5}));
    const auto weights = softWeights(Elements(legs), legs.points, {1}, 3);
    BOOST_TEST(weights[0] > 0.5);
    BOOST_TEST(weights[3] > 0.5);
    for (std::size_t i = 8; i < 16; ++i) BOOST_TEST(weights[i] == 0);
}

BOOST_AUTO_TEST_CASE(one_leg_of_the_creature_moves_no_other)
{
    const Mesh& cage = test::caged("creature").cage(400);
    const Elements elements(cage);
    const openvdb::BBoxd box = boundingBox(cage);
    const double height = box.extents().y(), knee = box.min().y() + 0.18 * height;
    // The legs: what hangs together below the knees.
    std::vector<Index> leg(cage.points.size(), none);
    Index legs = 0;
    for (Index start = 0; start < leg.size(); ++start) {
        if (leg[start] != none || cage.points[start].y() >= knee || !elements.isUsed(start)) continue;
        std::vector<Index> open{start};
        leg[start] = legs;
        while (!open.empty()) {
            const Index point = open.back();
            open.pop_back();
            for (const Index edge : elements.edgesOfPoint(point)) {
                const auto [a, b] = elements.edges()[edge];
                const Index other = a == point ? b : a;
                if (leg[other] != none || cage.points[other].y() >= knee) continue;
                leg[other] = legs;
                open.push_back(other);
            }
        }
        ++legs;
    }
    BOOST_TEST(legs == 4u);
    const double radius = 0.2 * height;
    std::size_t near = 0; // in space
    for (Index i = 0; i < leg.size(); ++i) {
        // From the feet; from the hip the way to the other leg is as short.
        if (leg[i] == none || cage.points[i].y() >= box.min().y() + 0.1 * height) continue;
        const auto weights = softWeights(elements, cage.points, {i}, radius);
        std::size_t moved = 0;
        for (Index k = 0; k < leg.size(); ++k) {
            if (weights[k] > 0) ++moved;
            if (leg[k] == none || leg[k] == leg[i]) continue;
            BOOST_TEST(weights[k] == 0);
            if ((cage.points[k] - cage.points[i]).length() < radius) ++near;
        }
        BOOST_TEST(moved > 1u);
    }
    BOOST_TEST(near > 0u);
}

BOOST_AUTO_TEST_CASE(bad_numbers_are_refused)
{
    const Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    const Elements elements(mesh);
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
    for (const double radius : {-1.0, nan, infinite}) {
        BOOST_CHECK_THROW(softWeights(elements, mesh.points, {0}, radius), InputError);
    }
    BOOST_CHECK_THROW(softWeights(elements, {}, {0}, 1), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
