// What is said of a cage holds for its file.
#include <boost/test/unit_test.hpp>

#include <support/read_json.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using openvdb::Vec3d;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

} // namespace

BOOST_AUTO_TEST_SUITE(precision)

BOOST_AUTO_TEST_CASE(a_certified_stl_bounds_a_model_far_from_the_origin)
{
    const TemporaryFolder folder;
    const std::string model = folder / "cube.obj", cage = folder / "cage.stl", report = folder / "r.json";
    writeMesh(test::box(Vec3d(10000.1), Vec3d(10001.1)), model);
    for (const std::vector<std::string>& options :
         {std::vector<std::string>{}, {"--bounding", "off"}, {"--symmetry", "auto"}, {"--mesh", "quads"}}) {
        std::vector<std::string> words{command, "make", model, "-o", cage, "--faces", "12", "--report", report};
        words.insert(words.end(), options.begin(), options.end());
        const auto made = runCommand(words);
        BOOST_TEST_CONTEXT(made.err)
        {
            BOOST_TEST_REQUIRE(made.status == 0);
            const auto facts = test::readJson(report);
            BOOST_TEST(facts["options"]["precision"] == "float32");
            const bool isSaid = facts["check"]["bounding"].get<bool>();
            BOOST_TEST((made.err.find("certified bounding") != std::string::npos) == isSaid);
            BOOST_TEST(runCommand({command, "check", cage, model}).status == (isSaid ? 0 : 2));
            if (options.empty()) BOOST_TEST(isSaid);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_plane_is_told_with_the_digits_that_it_needs)
{
    const TemporaryFolder folder;
    const auto isTold = [&](const Vec3d& centre, double radius, const std::string& plane) {
        const std::string model = folder / "jug.obj";
        writeMesh(test::sphere(centre, radius, 6), model);
        const auto made = runCommand({command, "make", model, "-o", folder / "cage.obj", "--faces", "60", "--effort",
                                      "fast", "--symmetry", "x"});
        BOOST_TEST(made.err.find("symmetric in the plane x = " + plane + ',') != std::string::npos, made.err);
    };
    isTold({5800010, 3e5, 0}, 1234, "5800010");
    isTold({0.1234567, 0, 0}, 1e-3, "0.1234567");
    isTold({0, 0, 0}, 1, "0");
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_hold_the_cage_is_refused_with_what_can)
{
    const TemporaryFolder folder;
    const std::string model = folder / "far.obj", cage = folder / "cage.stl";
    writeMesh(test::box(Vec3d(5e6, 3e5, 0), Vec3d(5e6 + 30, 3e5 + 20, 10)), model);
    const auto refused = runCommand({command, "make", model, "-o", cage});
    BOOST_TEST(refused.status == 1);
    BOOST_TEST(refused.err.find(model + ": it is so far from the origin that float32") != std::string::npos,
               refused.err);
    BOOST_TEST(refused.err.find("move it by (-5000000, -300000, 0) first") != std::string::npos, refused.err);
    BOOST_TEST(!std::filesystem::exists(cage));
    const auto wide = runCommand({command, "make", model, "-o", folder / "cage.ply"});
    BOOST_TEST(wide.status == 0, wide.err);
    BOOST_TEST(wide.err.find("coordinates are float64") != std::string::npos, wide.err);
    BOOST_TEST(runCommand({command, "check", folder / "cage.ply", model}).status == 0);
    const auto contradiction = runCommand({command, "make", model, "-o", cage, "--precision", "float64"});
    BOOST_TEST(contradiction.status == 1);
    BOOST_TEST(contradiction.err.find("--precision: 'float64' is not allowed with ") != std::string::npos,
               contradiction.err);
    const auto jobs =
        runCommand({command, "jobs", model, "-o", folder / "cages", "--format", "stl", "--precision", "float64"});
    BOOST_TEST(jobs.status == 1);
}

BOOST_AUTO_TEST_SUITE_END()
