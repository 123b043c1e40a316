#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cages.h"
#include "meshes.h"
#include <support/topology_count.h>
#include <tools/edit/topology.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>

using namespace vdbcage;
using namespace vdbcage::edit;
using openvdb::Vec3d;

namespace {

/// The faces, wherever they begin and in whatever order.
std::multiset<std::vector<Index>> facesOf(const Mesh& mesh)
{
    std::multiset<std::vector<Index>> faces;
    for (auto face : test::polygons(mesh)) {
        std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
        faces.insert(face);
    }
    return faces;
}

Index edgeOf(const Mesh& mesh, Index a, Index b)
{
    return Elements(mesh).edgeBetween(a, b);
}

std::size_t edgeCount(const Mesh& mesh)
{
    return Elements(mesh).count(Element::edge);
}

std::size_t leastValence(const Mesh& mesh)
{
    const Elements elements(mesh);
    std::size_t least = 100;
    for (Index point = 0; point < mesh.points.size(); ++point) {
        least = std::min(least, elements.edgesOfPoint(point).size());
    }
    return least;
}

bool hasFlatFace(const Mesh& mesh)
{
    const auto triangles = triangulate(mesh);
    return std::any_of(triangles.begin(), triangles.end(),
                       [&](const openvdb::Vec3I& t) { return detail::isDegenerate(mesh, t); });
}

void requireSameSurface(const Mesh& mesh, const test::TopologyCount& before)
{
    const test::TopologyCount count = test::countTopology(mesh);
    BOOST_REQUIRE(count.closedManifold());
    BOOST_REQUIRE(count.euler() == before.euler());
    BOOST_REQUIRE(count.parts == before.parts);
    BOOST_REQUIRE(count.points == mesh.points.size()); // none is left over
}

Mesh tetrahedron()
{
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

Mesh cutBox()
{
    Mesh mesh = test::box({0, 0, 0}, {1, 2, 3});
    mesh.triangles = triangulate(mesh);
    mesh.quads.clear();
    return mesh;
}

/// The message of what is refused; empty if it is not.
template <typename Work>
std::string refusal(const Work& work)
{
    try {
        work();
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// A way around a mesh by random edits. Returns how often each was done.
std::map<std::string, int> editAtRandom(Mesh mesh, unsigned seed, int edits)
{
    std::mt19937 random(seed);
    const test::TopologyCount before = test::countTopology(mesh);
    const std::size_t faces = faceCount(mesh), valence = leastValence(mesh);
    std::map<std::string, int> done;
    for (int i = 0; i < edits; ++i) {
        const auto edge = static_cast<Index>(random() % edgeCount(mesh));
        const std::size_t quad = random() % std::max<std::size_t>(mesh.quads.size(), 1);
        const auto face = static_cast<Index>(mesh.quads.empty() ? 0 : mesh.triangles.size() + quad);
        const std::size_t pick = random() % 5;
        std::string name;
        const std::string why = refusal([&] {
            if (pick == 0 && faceCount(mesh) < 2 * faces) {
                name = "split";
                mesh = splitEdge(mesh, edge);
            } else if (pick <= 1) {
                name = "collapse";
                mesh = collapseEdge(mesh, edge);
            } else if (pick == 2) {
                name = "flip";
                mesh = flipEdge(mesh, edge);
            } else if (pick == 3) {
                name = "merge";
                mesh = mergeFaces(mesh, edge);
            } else {
                name = "cut";
                mesh = cutQuad(mesh, face);
            }
        });
        ++done[why.empty() ? name : "refused"];
        if (!why.empty()) {
            BOOST_REQUIRE((contains(why, "edge ") || contains(why, "face ")) && !contains(why, "\n"));
            continue;
        }
        requireSameSurface(mesh, before);
        BOOST_REQUIRE(leastValence(mesh) >= std::min<std::size_t>(valence, 3));
        BOOST_REQUIRE(!hasFlatFace(mesh));
    }
    return done;
}

} // namespace

BOOST_AUTO_TEST_SUITE(topology)

BOOST_AUTO_TEST_CASE(a_split_edge_collapsed_again_is_as_before)
{
    for (const Mesh& mesh : {cutBox(), test::triangulatedTorus(9, 5), tetrahedron()}) {
        const test::TopologyCount before = test::countTopology(mesh);
        for (Index edge = 0; edge < edgeCount(mesh); ++edge) {
            const auto [low, high] = Elements(mesh).edges()[edge];
            const Mesh split = splitEdge(mesh, edge);
            requireSameSurface(split, before);
            BOOST_TEST(split.points.size() == mesh.points.size() + 1);
            BOOST_TEST(split.triangles.size() == mesh.triangles.size() + 2);
            BOOST_TEST(std::abs(test::countTopology(split).volume - before.volume) < 1e-12);
            const auto middle = static_cast<Index>(mesh.points.size());
            BOOST_TEST((split.points[middle] - (mesh.points[low] + mesh.points[high]) / 2).length() < 1e-15);
            for (const Index end : {low, high}) {
                const Mesh collapsed = collapseEdge(split, edgeOf(split, end, middle));
                BOOST_CHECK(facesOf(collapsed) == facesOf(mesh));
                for (Index i = 0; i < mesh.points.size(); ++i) {
                    if (i != end) BOOST_CHECK(collapsed.points[i] == mesh.points[i]);
                }
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(a_split_quad_becomes_three_triangles)
{
    const Mesh box = test::box({0, 0, 0}, {1, 2, 3});
    const test::TopologyCount before = test::countTopology(box);
    for (Index edge = 0; edge < 12; ++edge) {
        const Mesh split = splitEdge(box, edge);
        requireSameSurface(split, before);
        BOOST_TEST(split.triangles.size() == 6U);
        BOOST_TEST(split.quads.size() == 4U);
        BOOST_TEST(Elements(split).edgesOfPoint(8).size() == 6U);
        BOOST_TEST(std::abs(test::countTopology(split).volume - 6) < 1e-12);
    }
}

BOOST_AUTO_TEST_CASE(quads_beside_a_collapsed_edge_become_triangles)
{
    const Mesh mesh = test::torus(2, 0.5, 9, 5);
    const test::TopologyCount before = test::countTopology(mesh);
    for (Index edge = 0; edge < edgeCount(mesh); ++edge) {
        const auto [low, high] = Elements(mesh).edges()[edge];
        const Mesh collapsed = collapseEdge(mesh, edge);
        requireSameSurface(collapsed, before);
        BOOST_TEST(collapsed.triangles.size() == 2U);
        BOOST_TEST(collapsed.quads.size() == mesh.quads.size() - 2);
        BOOST_TEST((collapsed.points[low] - (mesh.points[low] + mesh.points[high]) / 2).length() < 1e-15);
        for (Index i = 0; i < mesh.points.size(); ++i) { // the others keep their order
            if (i != low && i != high) BOOST_CHECK(collapsed.points[i > high ? i - 1 : i] == mesh.points[i]);
        }
    }
}

BOOST_AUTO_TEST_CASE(an_edge_flipped_twice_is_as_before)
{
    const Mesh torus = test::triangulatedTorus(20, 12);
    const test::TopologyCount before = test::countTopology(torus);
    std::size_t flipped = 0;
    for (Index edge = 0; edge < edgeCount(torus); ++edge) {
        const auto ends = Elements(torus).edges()[edge];
        Mesh flip;
        if (!refusal([&] { flip = flipEdge(torus, edge); }).empty()) continue;
        ++flipped;
        requireSameSurface(flip, before);
        BOOST_TEST(edgeOf(flip, ends.first, ends.second) == none);
        std::vector<std::pair<Index, Index>> edges = Elements(torus).edges(), after = Elements(flip).edges();
        std::vector<std::pair<Index, Index>> fresh;
        std::set_difference(after.begin(), after.end(), edges.begin(), edges.end(), std::back_inserter(fresh));
        BOOST_REQUIRE(fresh.size() == 1U);
        const Mesh back = flipEdge(flip, edgeOf(flip, fresh[0].first, fresh[0].second));
        BOOST_CHECK(facesOf(back) == facesOf(torus));
    }
    BOOST_TEST(flipped > edgeCount(torus) / 4);
}

BOOST_AUTO_TEST_CASE(merging_and_cutting_undo_each_other)
{
    const Mesh box = test::box({0, 0, 0}, {1, 2, 3});
    for (Index face = 0; face < 6; ++face) {
        for (const Diagonal diagonal : {Diagonal::from0to2, Diagonal::from1to3}) {
            const Mesh cut = cutQuad(box, face, diagonal);
            requireSameSurface(cut, test::countTopology(box));
            const int first = diagonal == Diagonal::from0to2 ? 0 : 1;
            const Index edge = edgeOf(cut, box.quads[face][first], box.quads[face][first + 2]);
            BOOST_REQUIRE(edge != none);
            BOOST_CHECK(facesOf(mergeFaces(cut, edge)) == facesOf(box));
            // Another edge of the box's is a fold of 90 degrees.
            const Mesh all = cutBox();
            BOOST_TEST(contains(refusal([&] { mergeFaces(all, edgeOf(all, 0, 1)); }), "would not be convex"));
        }
    }
}

BOOST_AUTO_TEST_CASE(a_quad_is_cut_by_its_shorter_diagonal)
{
    Mesh box = test::box({0, 0, 0}, {1, 1, 1});
    box.points[7] += Vec3d(0.5, 0.5, 0.5);
    const Index face = 1; // of the points 1, 3, 7, 5
    BOOST_TEST(edgeOf(cutQuad(box, face), 3, 5) != none);
    BOOST_TEST(edgeOf(cutQuad(box, face, Diagonal::from0to2), 1, 7) != none);
    BOOST_TEST(edgeOf(cutQuad(test::box({0, 0, 0}, {1, 1, 1}), face), 1, 7) != none); // equal ones
}

BOOST_AUTO_TEST_CASE(what_remains_keeps_its_order)
{
    const Mesh mesh = test::sphere({0, 0, 0}, 1, 6);
    const Mesh split = splitEdge(mesh, edgeOf(mesh, 1, 13));
    const auto isSubsequence = [](const auto& part, const auto& of) {
        auto at = of.begin();
        return std::all_of(part.begin(), part.end(), [&](const auto& face) {
            at = std::find(at, of.end(), face);
            return at != of.end();
        });
    };
    BOOST_TEST(split.quads.size() == mesh.quads.size() - 2);
    BOOST_TEST(isSubsequence(split.quads, mesh.quads));
    BOOST_TEST(isSubsequence(mesh.triangles, split.triangles));
    BOOST_TEST((split.triangles.front() == mesh.triangles.front()));
}

BOOST_AUTO_TEST_CASE(what_would_break_the_surface_is_refused)
{
    const Mesh tetra = tetrahedron(), box = test::box({0, 0, 0}, {1, 1, 1}), neck = test::triangulatedTorus(9, 3);
    BOOST_TEST(contains(refusal([&] { collapseEdge(tetra, 0); }), "edges left"));
    BOOST_TEST(contains(refusal([&] { flipEdge(tetra, 0); }), "edges left"));
    BOOST_TEST(contains(refusal([&] { mergeFaces(tetra, 0); }), "edges left"));
    // Around the tube of the torus go three edges without a face between them.
    BOOST_TEST(contains(refusal([&] { collapseEdge(neck, edgeOf(neck, 0, 1)); }), "common neighbour"));
    BOOST_TEST(contains(refusal([&] { flipEdge(box, 3); }), "a quad is beside it"));
    BOOST_TEST(contains(refusal([&] { mergeFaces(box, 3); }), "a quad is beside it"));
    BOOST_TEST(contains(refusal([&] { splitEdge(box, 12); }), "edge 12: there are 12 edges"));
    BOOST_TEST(contains(refusal([&] { cutQuad(box, 6); }), "face 6: there are 6 faces"));
    BOOST_TEST(contains(refusal([&] { cutQuad(tetra, 0); }), "it is a triangle"));
    Mesh open = box;
    open.quads.pop_back();
    BOOST_TEST(contains(refusal([&] { splitEdge(open, 0); }), "no closed 2-manifold"));
    // The first flip joins the poles of an octahedron, so that the second one cannot.
    Mesh octahedron;
    octahedron.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    octahedron.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
    const Mesh joined = flipEdge(octahedron, edgeOf(octahedron, 0, 1));
    BOOST_TEST(contains(refusal([&] { flipEdge(joined, edgeOf(joined, 2, 3)); }), "have an edge already"));
    Mesh bad = cutBox();
    bad.triangles[0] = {0, 0, 99};
    BOOST_TEST(contains(refusal([&] { splitEdge(bad, 0); }), "99"));
}

BOOST_AUTO_TEST_CASE(what_would_turn_or_flatten_a_face_is_refused)
{
    // A dart: the corner 3 of the top lies behind the diagonal.
    Mesh dart = test::box({0, 0, 0}, {1, 1, 1});
    dart.points[7] = {0.3, 0.3, 1};
    dart.points[3] = {0.3, 0.3, 0};
    const Index top = 5; // of the points 4, 5, 7, 6
    BOOST_TEST(contains(refusal([&] { cutQuad(dart, top, Diagonal::from1to3); }), "turn over"));
    const Mesh cut = cutQuad(dart, top, Diagonal::from0to2);
    BOOST_TEST(contains(refusal([&] { mergeFaces(cut, edgeOf(cut, 4, 7)); }), "would not be convex"));
    BOOST_TEST(contains(refusal([&] { flipEdge(cut, edgeOf(cut, 4, 7)); }), "turn over"));
    Mesh flat = dart;
    flat.points[7] = {0.5, 0.5, 1}; // on the line from 5 to 6
    BOOST_TEST(contains(refusal([&] { cutQuad(flat, top, Diagonal::from1to3); }), "no area"));
    // Pulling a point over what lies beyond it turns that over.
    const Mesh torus = test::triangulatedTorus(9, 5);
    Mesh pulled = torus;
    pulled.points[0] = 3 * pulled.points[0] - 2 * pulled.points[1];
    const Index edge = edgeOf(pulled, 0, 1);
    pulled.points[1] = pulled.points[0] + 8 * (torus.points[2] - torus.points[1]);
    BOOST_TEST(refusal([&] { collapseEdge(torus, edge); }).empty());
    BOOST_TEST(contains(refusal([&] { collapseEdge(pulled, edge); }), "turn over"));
}

BOOST_AUTO_TEST_CASE(cages_stay_closed_manifolds_through_a_thousand_edits)
{
    std::map<std::string, int> total;
    unsigned seed = 0;
    for (const Mesh& cage : {test::caged("creature").cage(200), test::caged("botijo").cage(200, CageFaces::triquad),
                             test::caged("bishop").cage(100)}) {
        for (const auto& [name, count] : editAtRandom(cage, ++seed, 1000)) total[name] += count;
    }
    for (const char* name : {"split", "collapse", "flip", "merge", "cut", "refused"}) {
        BOOST_TEST_MESSAGE(name << ": " << total[name]);
        BOOST_TEST(total[name] > 100);
    }
}

BOOST_AUTO_TEST_SUITE_END()
