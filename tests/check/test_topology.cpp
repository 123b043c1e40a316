#include <boost/test/unit_test.hpp>

#include <random>

#include <support/shapes.h>
#include <support/stop_at.h>
#include <support/topology_count.h>
#include <tbb/global_control.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/topology.h>

using namespace vdbcage;

BOOST_AUTO_TEST_SUITE(topology)

BOOST_AUTO_TEST_CASE(closed_surfaces_have_their_genus)
{
    const Mesh sphere = test::sphere({}, 1, 6), torus = test::torus(2, 1, 9, 5);
    const MeshTopology one = analyzeTopology(sphere), two = analyzeTopology(torus);
    BOOST_TEST(one.genus() == 0);
    BOOST_TEST(two.genus() == 1);
    BOOST_TEST(one.isCycle());
    BOOST_TEST(two.isCycle());
    BOOST_TEST(one.edges == 2U * 6 * 11);
    BOOST_TEST(one.vertices == 62U);
    BOOST_TEST(one.faces == 12U * 6);
    const MeshTopology both = analyzeTopology(test::joined(torus, test::joined(sphere, torus)));
    BOOST_TEST(both.components() == 3U);
    BOOST_TEST(both.genus() == 2);
    // Triangles come first: those at the sphere's poles make its component the first.
    BOOST_TEST(both.faceComponent.front() == 0U);
    BOOST_TEST(both.faceComponent[sphere.triangles.size()] == 1U);
    BOOST_TEST(both.faceComponent.back() == 2U);
}

BOOST_AUTO_TEST_CASE(no_faces)
{
    Mesh mesh;
    mesh.points.resize(3);
    const MeshTopology none = analyzeTopology(mesh);
    BOOST_TEST(none.faces + none.edges + none.vertices + none.components() == 0U);
    BOOST_TEST(!none.isCycle());
}

BOOST_AUTO_TEST_CASE(a_hole)
{
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    mesh.quads.pop_back();
    const MeshTopology facts = analyzeTopology(mesh);
    BOOST_TEST(facts.boundaryEdges == 4U);
    BOOST_TEST(facts.nonManifoldVertices == 0U);
    BOOST_TEST(!facts.isCycle());
}

BOOST_AUTO_TEST_CASE(a_flipped_face)
{
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    std::swap(mesh.quads[2][1], mesh.quads[2][3]);
    const MeshTopology facts = analyzeTopology(mesh);
    BOOST_TEST(facts.misorientedEdges == 4U);
    BOOST_TEST(facts.boundaryEdges + facts.nonManifoldEdges + facts.nonManifoldVertices == 0U);
    BOOST_TEST(facts.components() == 1U);
    BOOST_TEST(!facts.isCycle());
}

BOOST_AUTO_TEST_CASE(an_edge_of_three_faces)
{
    Mesh mesh = test::box({0, 0, 0}, {1, 1, 1});
    mesh.points.emplace_back(2, -1, 2);
    mesh.triangles.emplace_back(0U, 1U, 8U);
    const MeshTopology facts = analyzeTopology(mesh);
    BOOST_TEST(facts.nonManifoldEdges == 1U);
    BOOST_TEST(facts.boundaryEdges == 2U);
    BOOST_TEST(facts.nonManifoldVertices == 0U);
}

BOOST_AUTO_TEST_CASE(boxes_joined_at_a_corner_and_at_an_edge)
{
    const auto weld = [](const openvdb::Vec3d& move) {
        Mesh mesh =
            test::joined(test::box({0, 0, 0}, {1, 1, 1}), test::transformed(test::box({0, 0, 0}, {1, 1, 1}), 1, move));
        for (auto& quad : mesh.quads) {
            for (int i = 0; i < 4; ++i) {
                for (unsigned p = 0; p < quad[i]; ++p) {
                    if (mesh.points[p] == mesh.points[quad[i]]) quad[i] = p;
                }
            }
        }
        return analyzeTopology(mesh);
    };
    const MeshTopology corner = weld({1, 1, 1}), edge = weld({1, 1, 0});
    BOOST_TEST(corner.nonManifoldVertices == 1U);
    BOOST_TEST(corner.nonManifoldEdges == 0U);
    BOOST_TEST(corner.components() == 2U);
    BOOST_TEST(edge.nonManifoldEdges == 1U);
    BOOST_TEST(edge.nonManifoldVertices == 0U);
    BOOST_TEST(edge.components() == 1U);
    BOOST_TEST(edge.isCycle()); // two faces run each way: there still is an inside
}

BOOST_AUTO_TEST_CASE(random_soups_agree_with_the_plainest_count, *boost::unit_test::label("property"))
{
    for (unsigned seed = 0; seed < 300; ++seed) {
        std::mt19937 random(seed);
        Mesh mesh = seed % 2 ? test::sphere({}, 1, 4) : test::torus(2, 1, 5, 4);
        const auto points = static_cast<unsigned>(mesh.points.size());
        for (unsigned defect = random() % 4; defect > 0; --defect) {
            switch (random() % 3) {
            case 0:
                mesh.quads.erase(mesh.quads.begin() + static_cast<std::ptrdiff_t>(random() % mesh.quads.size()));
                break;
            case 1: {
                openvdb::Vec4I& quad = mesh.quads[random() % mesh.quads.size()];
                std::swap(quad[1], quad[3]);
                break;
            }
            default:
                mesh.triangles.emplace_back(random() % 10U, 10 + random() % 5U, 15 + random() % (points - 15));
            }
        }
        const MeshTopology facts = analyzeTopology(mesh);
        const test::TopologyCount reference = test::countTopology(mesh);
        BOOST_TEST_CONTEXT("seed " << seed)
        {
            BOOST_TEST(facts.vertices == reference.points);
            BOOST_TEST(facts.edges == reference.edges);
            BOOST_TEST(facts.faces == reference.faces);
            BOOST_TEST((facts.boundaryEdges + facts.nonManifoldEdges + facts.misorientedEdges == 0) ==
                       (reference.openEdges == 0));
            if (reference.openEdges == 0) {
                BOOST_TEST(facts.nonManifoldVertices == reference.splitPoints);
                BOOST_TEST(facts.components() == reference.parts);
                BOOST_TEST(facts.genus() == reference.genus());
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(the_number_of_threads_does_not_matter)
{
    Mesh mesh;
    for (int i = 0; i < 40; ++i) {
        mesh = test::joined(mesh, test::transformed(test::torus(2, 1, 40, 20), 1, {8.0 * i, 0, 0}));
        if (i % 3 == 0) mesh.quads.pop_back();
    }
    const MeshTopology many = analyzeTopology(mesh);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, 1);
    const MeshTopology one = analyzeTopology(mesh);
    BOOST_TEST(many.components() == 40U);
    BOOST_TEST(many.faceComponent == one.faceComponent);
    BOOST_TEST(many.componentIsCycle == one.componentIsCycle);
    BOOST_TEST(many.boundaryEdges == one.boundaryEdges);
}

BOOST_AUTO_TEST_CASE(asks_at_each_vertex_and_after_so_many_faces)
{
    std::mt19937 random(3);
    Mesh mesh; // whose vertices have thousands of faces each
    mesh.points.resize(20);
    for (int i = 0; i < 50000; ++i) {
        const auto corner = [&] { return static_cast<openvdb::Index32>(random() % mesh.points.size()); };
        mesh.triangles.emplace_back(corner(), corner(), corner());
    }
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    test::StopAt never(1000000);
    analyzeTopology(mesh, &never);
    const int asked = test::questions(never, 1000000);
    const auto turns = int(3 * mesh.triangles.size() / 65536);
    BOOST_TEST(asked >= int(mesh.points.size()) + 2 * turns); // the corners are gone through twice
    for (int k = 0; k < asked; ++k) {
        test::StopAt stop(k);
        BOOST_CHECK_THROW(analyzeTopology(mesh, &stop), Cancelled);
    }
}

BOOST_AUTO_TEST_SUITE_END()
