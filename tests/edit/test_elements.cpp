#include <boost/test/unit_test.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "meshes.h"
#include <support/topology_count.h>
#include <tools/edit/elements.h>

using namespace vdbcage;
using namespace vdbcage::edit;

namespace {

std::vector<Index> listOf(const Ids& ids)
{
    return {ids.begin(), ids.end()};
}

} // namespace

BOOST_AUTO_TEST_SUITE(elements)

BOOST_AUTO_TEST_CASE(everything_is_what_a_search_through_all_faces_finds)
{
    for (unsigned seed = 0; seed < 200; ++seed) {
        const Mesh mesh = test::randomFaces(seed);
        const Elements elements(mesh);
        const auto faces = test::polygons(mesh);
        std::set<std::pair<Index, Index>> edges;
        for (const auto& face : faces) {
            for (std::size_t i = 0; i < face.size(); ++i) {
                const Index a = face[i], b = face[(i + 1) % face.size()];
                if (a != b) edges.insert({std::min(a, b), std::max(a, b)});
            }
        }
        BOOST_REQUIRE(elements.count(Element::point) == mesh.points.size());
        BOOST_REQUIRE(elements.count(Element::face) == faces.size());
        BOOST_REQUIRE(elements.count(Element::edge) == edges.size());
        BOOST_TEST((elements.edges() == std::vector<std::pair<Index, Index>>(edges.begin(), edges.end())));
        for (Index f = 0; f < faces.size(); ++f) {
            BOOST_TEST(listOf(elements.pointsOfFace(f)) == faces[f], boost::test_tools::per_element());
            for (std::size_t i = 0; i < faces[f].size(); ++i) {
                const Index a = faces[f][i], b = faces[f][(i + 1) % faces[f].size()];
                BOOST_TEST(elements.edgesOfFace(f)[i] == elements.edgeBetween(a, b));
                BOOST_TEST(elements.edgeBetween(a, b) == elements.edgeBetween(b, a));
            }
        }
        for (Index a = 0; a < mesh.points.size(); ++a) {
            std::vector<Index> facesOfPoint, edgesOfPoint;
            for (Index f = 0; f < faces.size(); ++f) {
                if (std::count(faces[f].begin(), faces[f].end(), a) > 0) facesOfPoint.push_back(f);
            }
            for (Index e = 0; e < edges.size(); ++e) {
                if (elements.edges()[e].first == a || elements.edges()[e].second == a) edgesOfPoint.push_back(e);
            }
            BOOST_TEST(listOf(elements.facesOfPoint(a)) == facesOfPoint, boost::test_tools::per_element());
            BOOST_TEST(listOf(elements.edgesOfPoint(a)) == edgesOfPoint, boost::test_tools::per_element());
            BOOST_TEST(elements.isUsed(a) == !facesOfPoint.empty());
            for (Index b = 0; b < mesh.points.size(); ++b) {
                const bool isEdge = edges.count({std::min(a, b), std::max(a, b)}) > 0;
                BOOST_TEST((elements.edgeBetween(a, b) != none) == isEdge);
            }
        }
        for (Index e = 0; e < edges.size(); ++e) {
            std::vector<Index> facesOfEdge;
            for (Index f = 0; f < faces.size(); ++f) {
                const Ids sides = elements.edgesOfFace(f);
                if (std::count(sides.begin(), sides.end(), e) > 0) facesOfEdge.push_back(f);
            }
            BOOST_TEST(listOf(elements.facesOfEdge(e)) == facesOfEdge, boost::test_tools::per_element());
        }
    }
}

BOOST_AUTO_TEST_CASE(kinds_have_names)
{
    BOOST_TEST(std::string(elementsName(Element::point)) == "points");
    BOOST_TEST(std::string(elementsName(Element::edge)) == "edges");
    BOOST_TEST(std::string(elementsName(Element::face)) == "faces");
}

BOOST_AUTO_TEST_SUITE_END()
