// Models with flat sides, which have no use for many faces.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <limits>

#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::box;

BOOST_AUTO_TEST_SUITE(flat_models)

BOOST_AUTO_TEST_CASE(more_faces_are_never_looser_around_a_box)
{
    for (const CageFaces mesh : {CageFaces::triangles, CageFaces::quads}) {
        Pipeline made(box({0, 0, 0}, {3, 2, 1}));
        CageOptions options;
        options.mesh = mesh;
        double mean = std::numeric_limits<double>::infinity(), most = mean;
        for (const int faces : {12, 50, 150, 400, 1000}) {
            if (mesh == CageFaces::quads && faces > 400) continue; // the same in more time
            options.faces = faces;
            made.run(options);
            const CageCheck& check = made.report().check;
            BOOST_TEST_CONTEXT(faces << " faces, mesh " << static_cast<int>(mesh))
            {
                BOOST_TEST(check.bounding());
                BOOST_TEST(check.meanDistance <= mean + options.clearance);
                BOOST_TEST(check.maxDistance <= 1.05 * most + 4 * options.clearance);
            }
            mean = std::min(mean, check.meanDistance);
            most = std::min(most, check.maxDistance);
        }
        BOOST_TEST(most < 5e-4);
    }
}

BOOST_AUTO_TEST_SUITE_END()
