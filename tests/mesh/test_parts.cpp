#include <boost/test/unit_test.hpp>

#include <support/shapes.h>
#include <vdbcage/mesh/parts.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::box;
using test::joined;
using test::sphere;

BOOST_AUTO_TEST_SUITE(parts)

BOOST_AUTO_TEST_CASE(small_parts_are_left_out_by_their_longest_side)
{
    const Mesh large = sphere({0, 0, 0}, 1, 8), middle = box(Vec3d(5), Vec3d(5.5, 5.1, 5.1)),
               small = box(Vec3d(9), Vec3d(9.02, 9.01, 9.01));
    Mesh all = joined(joined(small, large), middle);
    all.points.emplace_back(7, 7, 7); // of no face
    for (const auto& [least, parts] :
         {std::pair{0.0, 0U}, {0.009, 0U}, {0.011, 1U}, {0.24, 1U}, {0.26, 2U}, {1.0, 2U}}) {
        const LargeParts kept = largeParts(all, least);
        BOOST_TEST_CONTEXT(least)
        {
            BOOST_TEST(kept.partsLeftOut == parts);
            BOOST_TEST(kept.facesLeftOut == 6 * parts);
            BOOST_TEST(faceCount(kept.mesh) + kept.facesLeftOut == faceCount(all));
            BOOST_TEST(kept.mesh.points.size() == all.points.size() - 8 * parts);
            BOOST_TEST(loosePoints(kept.mesh).size() == 1U);
            BOOST_TEST(boundingBox(kept.mesh).min() == boundingBox(large).min());
        }
    }
    BOOST_TEST(largestPart(all) == 2);
    BOOST_TEST(faceCount(partsFrom(all, 100).mesh) == 0U);
    BOOST_TEST(partsFrom(all, 0.5).partsLeftOut == 1U); // the longest side itself stays
}

BOOST_AUTO_TEST_CASE(points_in_one_place_hold_a_part_together)
{
    // As models with flat normals come, each triangle with points of its own.
    Mesh model;
    const Mesh ball = joined(sphere({0, 0, 0}, 1, 8), sphere({3, 0, 0}, 0.1, 4));
    for (const openvdb::Vec3I& t : triangulate(ball)) {
        const auto first = static_cast<openvdb::Index32>(model.points.size());
        for (int i = 0; i < 3; ++i) model.points.push_back(ball.points[t[i]]);
        model.triangles.emplace_back(first, first + 1, first + 2);
    }
    const LargeParts kept = largeParts(model, 0.5);
    BOOST_TEST(kept.partsLeftOut == 1U);
    BOOST_TEST(faceCount(kept.mesh) == triangulate(sphere({0, 0, 0}, 1, 8)).size());
}

BOOST_AUTO_TEST_SUITE_END()
