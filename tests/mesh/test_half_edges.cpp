#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include <vdbcage/mesh/detail/half_edges.h>

using namespace vdbcage;
using detail::EdgeTable;
using detail::HalfEdges;

namespace {

/// Any faces on few points: edges of one face and of many, either way, faces that repeat corners.
Mesh randomFaces(unsigned seed, unsigned points, std::size_t triangles, std::size_t quads)
{
    std::mt19937 random(seed);
    std::uniform_int_distribution<openvdb::Index32> any(0, points - 1);
    Mesh mesh;
    mesh.points.resize(points);
    for (std::size_t i = 0; i < triangles; ++i) mesh.triangles.emplace_back(any(random), any(random), any(random));
    for (std::size_t i = 0; i < quads; ++i) {
        mesh.quads.emplace_back(any(random), any(random), any(random), any(random));
    }
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(half_edges)

BOOST_AUTO_TEST_CASE(they_run_around_their_faces)
{
    const Mesh mesh = randomFaces(1, 50, 7, 5);
    const HalfEdges halfEdges(mesh);
    BOOST_REQUIRE(halfEdges.size() == 7U * 3 + 5 * 4);
    std::size_t h = 0;
    const auto expect = [&](const auto& face, int size, std::size_t number) {
        for (int i = 0; i < size; ++i, ++h) {
            BOOST_TEST(halfEdges.face(h) == number);
            BOOST_TEST(halfEdges.from(h) == face[i]);
            BOOST_TEST(halfEdges.to(h) == face[(i + 1) % size]);
            BOOST_TEST(halfEdges.before(h) == face[(i + size - 1) % size]);
            BOOST_TEST(halfEdges.next(h) == h + std::size_t((i + 1) % size) - std::size_t(i));
        }
    };
    for (std::size_t t = 0; t < 7; ++t) expect(mesh.triangles[t], 3, t);
    for (std::size_t q = 0; q < 5; ++q) expect(mesh.quads[q], 4, 7 + q);
}

BOOST_AUTO_TEST_CASE(edges_are_those_that_a_search_finds)
{
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Mesh mesh = randomFaces(seed, 2 + seed % 23, seed % 31, seed % 17);
        const HalfEdges halfEdges(mesh);
        std::map<std::pair<HalfEdges::Index, HalfEdges::Index>, std::vector<std::size_t>> expected;
        for (std::size_t h = 0; h < halfEdges.size(); ++h) {
            const auto ends = std::minmax({halfEdges.from(h), halfEdges.to(h)});
            if (ends.first != ends.second) expected[ends].push_back(h);
        }
        const EdgeTable edges(halfEdges, mesh.points.size());
        BOOST_REQUIRE(edges.size() == expected.size());
        std::size_t edge = 0;
        for (const auto& [ends, all] : expected) {
            BOOST_TEST(std::vector<std::size_t>(edges[edge].begin(), edges[edge].end()) == all,
                       boost::test_tools::per_element());
            for (const std::size_t h : all) BOOST_TEST(edges.edgeOf(h) == edge);
            ++edge;
        }
        for (std::size_t h = 0; h < halfEdges.size(); ++h) {
            std::size_t opposite = EdgeTable::none;
            std::size_t users = 0;
            for (std::size_t other = 0; other < halfEdges.size(); ++other) {
                const bool against =
                    halfEdges.from(other) == halfEdges.to(h) && halfEdges.to(other) == halfEdges.from(h);
                const bool along = halfEdges.from(other) == halfEdges.from(h) && halfEdges.to(other) == halfEdges.to(h);
                users += against || along ? 1 : 0;
                if (against) opposite = other;
            }
            const bool isEdge = halfEdges.from(h) != halfEdges.to(h);
            BOOST_TEST(edges.opposite(h) == (isEdge && users == 2 ? opposite : EdgeTable::none));
            if (!isEdge) BOOST_TEST(edges.edgeOf(h) == EdgeTable::none);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_mesh_without_faces_has_no_edges)
{
    const Mesh mesh = randomFaces(0, 3, 0, 0);
    BOOST_TEST(EdgeTable(HalfEdges(mesh), 3).size() == 0U);
    BOOST_TEST(EdgeTable(HalfEdges(Mesh()), 0).size() == 0U);
}

BOOST_AUTO_TEST_SUITE_END()
