// A certificate is one of the file that the cage is written to, wherever the model is.
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

using namespace vdbcage;
using openvdb::Vec3d;

BOOST_AUTO_TEST_SUITE(precision)

namespace {

/// A ball, a ring or a box, turned, of any size, at any distance from the origin.
Mesh randomModel(std::mt19937& random)
{
    std::uniform_real_distribution<double> share(0, 1);
    const auto between = [&](double a, double b) { return a + (b - a) * share(random); };
    const double size = std::pow(10, between(-6, 6)), far = size * std::pow(10, between(0, 7));
    const Vec3d place = far * Vec3d(between(-1, 1), between(-1, 1), between(-1, 1));
    Mesh shape = random() % 3 == 0   ? test::sphere({0, 0, 0}, 0.5, 5)
                 : random() % 2 == 0 ? test::torus(0.4, 0.1, 12, 5)
                                     : test::box({-0.5, -0.2, -0.3}, {0.5, 0.2, 0.3});
    return test::transformed(test::turnedAboutZ(std::move(shape), between(0, 90)), size, place);
}

} // namespace

BOOST_AUTO_TEST_CASE(every_file_of_a_certified_cage_bounds_the_model)
{
    const test::TemporaryFolder folder;
    std::mt19937 random(20261127);
    int made = 0, rounded = 0;
    for (int i = 0; i < 40; ++i) {
        const Mesh model = randomModel(random);
        for (const char* name : {"cage.stl", "cage.ply"}) {
            const std::filesystem::path file = folder / name;
            CageOptions options;
            options.faces = 12 + static_cast<int>(random() % 100);
            options.effort = Effort::fast;
            options.mesh = static_cast<CageFaces>(random() % 3);
            options.symmetry = random() % 2 == 0 ? CageSymmetry::off : CageSymmetry::automatic;
            options.precision = precisionOf(file);
            Mesh cage;
            try {
                cage = makeCage(model, options);
            } catch (const InputError& error) {
                BOOST_TEST((options.precision == Precision::float32), error.what());
                BOOST_TEST(std::string(error.what()).find("move it by") != std::string::npos, error.what());
                continue;
            }
            BOOST_TEST((asWritten(cage, file).points == cage.points));
            writeMesh(cage, file);
            BOOST_TEST_CONTEXT("model " << i << ", " << name) BOOST_TEST(checkCage(readMesh(file), model).bounding());
            ++made;
            if (options.precision == Precision::float32) ++rounded;
        }
    }
    BOOST_TEST(made > 40);
    BOOST_TEST(rounded > 10);
}

BOOST_AUTO_TEST_CASE(a_model_far_away_gets_a_cage_of_floats_or_is_told_where_to_go)
{
    CageOptions options;
    options.faces = 12;
    options.precision = Precision::float32;
    const auto at = [](double x) { return test::box(Vec3d(x), Vec3d(x + 1)); };
    for (const double x : {0.0, 100.1, 2000.1, 10000.1}) {
        Pipeline made(at(x));
        const Mesh& cage = made.run(options);
        BOOST_TEST_CONTEXT(x)
        {
            BOOST_TEST(made.report().check.bounding());
            BOOST_TEST(made.report().floatSafe);
            BOOST_TEST((asWritten(cage, "cage.stl").points == cage.points));
        }
    }
    BOOST_CHECK_EXCEPTION(makeCage(at(500000.1), options), InputError, [](const InputError& error) {
        return std::string(error.what()) ==
               "model: it is so far from the origin that float32 rounds coordinates by up to 3 % of its longest side; "
               "at most 0.1 % is allowed: move it by (-500001, -500001, -500001) first; .obj, .off and .ply files hold "
               "float64";
    });
    // As it says, and in the way that it says.
    BOOST_TEST(checkCage(makeCage(test::transformed(at(500000.1), 1, Vec3d(-500000)), options),
                         test::transformed(at(500000.1), 1, Vec3d(-500000)))
                   .bounding());
    options.precision = Precision::automatic;
    Pipeline far(at(500000.1));
    BOOST_TEST(checkCage(far.run(options), at(500000.1)).bounding());
    BOOST_TEST(!far.report().floatSafe);
    options.bounding = false;
    options.precision = Precision::float32;
    BOOST_CHECK_THROW(makeCage(at(500000.1), options), InputError);
    const Mesh plain = makeCage(at(2000.1), options);
    BOOST_TEST((asWritten(plain, "cage.stl").points == plain.points));
}

BOOST_AUTO_TEST_CASE(float64_is_not_rounded)
{
    CageOptions options;
    options.faces = 100;
    options.effort = Effort::fast;
    const Mesh ball = test::sphere({0.1, 0.2, 0.3}, 1, 12);
    const auto areFloats = [](const Mesh& cage) { return asWritten(cage, "cage.stl").points == cage.points; };
    BOOST_TEST(areFloats(makeCage(ball, options)));
    options.precision = Precision::float64;
    const Mesh fine = makeCage(ball, options);
    BOOST_TEST(!areFloats(fine));
    BOOST_TEST(checkCage(fine, ball).bounding());
}

BOOST_AUTO_TEST_SUITE_END()
