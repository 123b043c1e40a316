// Small parts far away, and around a figure.
#include <boost/test/unit_test.hpp>

#include <random>

#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/pipeline/memory.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::joined;
using test::sphere;

BOOST_AUTO_TEST_SUITE(specks)

namespace {

Mesh figure()
{
    return joined(sphere({0, 0, 0}, 0.3, 16),
                  joined(sphere({0.35, 0, 0.1}, 0.2, 16), sphere({-0.2, 0.3, 0}, 0.15, 12)));
}

/// The cage's faces on the figure.
std::size_t facesOnFigure(const Mesh& cage)
{
    std::size_t faces = 0;
    for (const openvdb::Vec3I& t : triangulate(cage)) faces += cage.points[t[0]].length() < 2;
    return faces;
}

} // namespace

BOOST_AUTO_TEST_CASE(a_speck_far_away_leaves_the_figure_its_faces)
{
    CageOptions options;
    options.effort = Effort::fast;
    options.faces = 300;
    Pipeline alone(figure());
    alone.run(options);
    for (const double away : {5.0, 20.0, 30.0}) {
        const Mesh model = joined(figure(), sphere({0, away, 0}, 0.002, 4));
        Pipeline made(model);
        const Mesh& cage = made.run(options);
        const CageReport& report = made.report();
        BOOST_TEST_CONTEXT(away)
        {
            BOOST_TEST(facesOnFigure(cage) > 0.75 * options.faces);
            BOOST_TEST(report.sideShare < 1);
            // By its own size it is about as tight as without the speck.
            BOOST_TEST(report.check.meanDistance * away < 3 * alone.report().check.meanDistance);
            BOOST_TEST(predictedMemory(model, options) < 1e9);
        }
    }
    BOOST_TEST(alone.report().sideShare == 1);
}

BOOST_AUTO_TEST_CASE(small_parts_are_left_out_where_it_is_asked_for)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> place(-0.9, 0.9), size(0.002, 0.012);
    Mesh model = figure();
    for (int i = 0; i < 60; ++i) {
        const Vec3d centre(place(random), place(random), place(random));
        model = joined(std::move(model), sphere(centre, size(random), 3));
    }
    CageOptions options;
    options.effort = Effort::fast;
    options.faces = 300;
    options.leastPart = 0.1;
    Pipeline made(model);
    const Mesh cage = made.run(options);
    const CageReport report = made.report();
    BOOST_TEST(report.partsLeftOut == 60U);
    BOOST_TEST(report.facesLeftOut == 60 * faceCount(sphere({0, 0, 0}, 1, 3)));
    BOOST_TEST(report.check.bounding());
    BOOST_TEST((cage.points == makeCage(figure(),
                                        [&] {
                                            CageOptions of = options;
                                            of.leastPart = 0;
                                            return of;
                                        }())
                                   .points));
    BOOST_TEST(checkCage(cage, figure()).bounding());
    BOOST_TEST(!checkCage(cage, model).bounding());
    BOOST_TEST(made.model().points.size() == model.points.size());
    BOOST_TEST(predictedMemory(model, options) > 0U);
    options.leastPart = 0; // the same pipeline makes it of all
    BOOST_TEST(checkCage(made.run(options), model).bounding());
    BOOST_TEST(made.report().partsLeftOut == 0U);
}

BOOST_AUTO_TEST_SUITE_END()
