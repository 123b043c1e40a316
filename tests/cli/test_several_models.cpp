#include <boost/test/unit_test.hpp>

#include <support/read_json.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/deform/weights_io.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using nlohmann::json;
using test::readJson;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;
const std::string body = VDBCAGE_SOURCE_DIR "/data/bishop.obj";

/// The bishop, moved and stretched, as another model.
Mesh moved(double along)
{
    Mesh mesh = readMesh(body);
    for (openvdb::Vec3d& point : mesh.points) point = {1.2 * point.x() + along, point.y(), 0.8 * point.z()};
    return mesh;
}

} // namespace

BOOST_AUTO_TEST_SUITE(several_models)

BOOST_AUTO_TEST_CASE(one_cage_bounds_them_all_and_each_gets_its_verdict)
{
    const TemporaryFolder folder;
    const Mesh other = moved(0.6), far = moved(50);
    const std::string shirt = folder / "shirt.obj", hair = folder / "hair.ply", cage = folder / "cage.obj";
    writeMesh(other, shirt);
    writeMesh(far, hair);
    const auto made = runCommand({command, "make", body, shirt, "-o", cage, "--faces", "200", "--report",
                                  folder / "made.json", "--picture", folder / "made.png"});
    BOOST_REQUIRE(made.status == 0);
    BOOST_TEST(made.err.find("bishop.obj: bounding\n") != std::string::npos, made.err);
    BOOST_TEST(made.err.find("shirt.obj: bounding\n") != std::string::npos, made.err);
    BOOST_TEST(checkCage(readMesh(cage), readMesh(body)).bounding());
    BOOST_TEST(checkCage(readMesh(cage), other).bounding());
    const json report = readJson(folder / "made.json");
    BOOST_TEST(report.count("model") == 0U);
    BOOST_REQUIRE(report["models"].size() == 2U);
    BOOST_TEST(report["models"][1]["file"] == shirt);
    BOOST_TEST(report["models"][1]["check"]["bounding"] == true);
    BOOST_TEST(report["models"][1]["check"]["mean_distance"].get<double>() ==
               checkCage(readMesh(cage), other).meanDistance);
    BOOST_TEST(report["check"]["bounding"] == true);

    BOOST_TEST(runCommand({command, "check", cage, body, shirt}).status == 0);
    const auto checked = runCommand({command, "check", cage, shirt, hair, body, "--report", folder / "checked.json"});
    BOOST_TEST(checked.status == 2);
    BOOST_TEST(checked.out.find("cage.obj: NOT bounding\n") != std::string::npos, checked.out);
    BOOST_TEST(checked.out.find("shirt.obj: bounding") != std::string::npos, checked.out);
    BOOST_TEST(checked.out.find("hair.ply: NOT bounding") != std::string::npos, checked.out);
    BOOST_TEST(readJson(folder / "checked.json")["models"][1]["check"]["model_vertices_outside"] == far.points.size());
}

BOOST_AUTO_TEST_CASE(of_models_that_lie_apart_it_says_that_there_is_one_cage)
{
    const TemporaryFolder folder;
    const auto saysSo = [&](const std::vector<Mesh>& models) {
        std::vector<std::string> words{command, "make"};
        for (std::size_t i = 0; i < models.size(); ++i) {
            words.push_back(folder / (std::to_string(i) + ".obj"));
            writeMesh(models[i], words.back());
        }
        words.insert(words.end(),
                     {"-o", folder / "cage.off", "--faces", "20", "--resolution", "16", "--effort", "fast"});
        const auto made = runCommand(words);
        BOOST_REQUIRE(made.status == 0);
        const std::string line =
            "  one cage for " + std::to_string(models.size()) + " models; for a cage each: vdbcage jobs\n";
        BOOST_TEST((made.err.find("vdbcage jobs") != std::string::npos) == (made.err.find(line) != std::string::npos));
        return made.err.find(line) != std::string::npos;
    };
    const auto cube = [](double x) { return test::box({x, 0, 0}, {x + 1, 1, 1}); };
    BOOST_TEST(!saysSo({cube(0)}));
    BOOST_TEST(!saysSo({cube(0), cube(0.5)}));
    BOOST_TEST(!saysSo({cube(0), cube(1.09)}));
    BOOST_TEST(saysSo({cube(0), cube(1.11)}));
    BOOST_TEST(saysSo({cube(0), cube(-3)}));
    BOOST_TEST(!saysSo({cube(0), cube(2), cube(1)})); // the third is between
    BOOST_TEST(saysSo({cube(0), cube(5), cube(1)}));
    BOOST_TEST(saysSo({cube(0), cube(1), cube(5), cube(6)}));
    // A figure: a body, hands beside it, a hat above it, an eye inside.
    BOOST_TEST(!saysSo({test::box({-0.3, -0.3, 0}, {0.3, 0.3, 2}), test::sphere({0.45, 0, 1}, 0.1, 4),
                        test::sphere({-0.45, 0, 1}, 0.1, 4), test::box({-0.2, -0.2, 2.15}, {0.2, 0.2, 2.3}),
                        test::sphere({0, 0, 1.8}, 0.02, 4)}));
}

BOOST_AUTO_TEST_CASE(the_order_of_models_does_not_change_what_is_bounded)
{
    const TemporaryFolder folder;
    const std::string shirt = folder / "shirt.obj";
    writeMesh(moved(0.6), shirt);
    for (const auto& [first, second] : {std::pair(body, shirt), std::pair(shirt, body)}) {
        BOOST_TEST(
            runCommand({command, "make", first, second, "-o", folder / "cage.obj", "--faces", "100", "-q"}).status ==
            0);
        BOOST_TEST(runCommand({command, "check", folder / "cage.obj", body, shirt, "-q"}).status == 0);
    }
}

BOOST_AUTO_TEST_CASE(bind_makes_a_folder_with_the_weights_of_each)
{
    const TemporaryFolder folder;
    const Mesh other = moved(0.6);
    const std::string shirt = folder / "shirt.obj", cage = folder / "cage.obj", weights = folder / "weights";
    writeMesh(other, shirt);
    BOOST_REQUIRE(runCommand({command, "make", body, shirt, "-o", cage, "--faces", "100", "-q"}).status == 0);
    BOOST_TEST(runCommand({command, "bind", cage, body, shirt, "-o", weights, "-q"}).status == 0);
    BOOST_TEST(runCommand({command, "bind", cage, shirt, "-o", folder / "alone.npy", "-q"}).status == 0);
    BOOST_TEST(test::readText(weights + "/shirt.npy") == test::readText(folder / "alone.npy"));
    BOOST_TEST(readWeights(weights + "/bishop.npy", readMesh(cage), readMesh(body).points)
                   .pose(readMesh(cage).points)
                   .size() == readMesh(body).points.size());

    const auto named = runCommand({command, "bind", cage, body, shirt, "-o", folder / "weights.npy"});
    BOOST_TEST(named.status == 1);
    BOOST_TEST(named.err.find("for several models it must be a folder") != std::string::npos, named.err);
    const auto twice = runCommand({command, "bind", cage, body, body, "-o", folder / "twice"});
    BOOST_TEST(twice.status == 1);
    BOOST_TEST(twice.err.find("bishop.obj: another model has this name too") != std::string::npos, twice.err);
    BOOST_TEST(!std::filesystem::exists(folder / "twice"));
}

BOOST_AUTO_TEST_CASE(a_lone_plus_joins_models_in_a_picture)
{
    const TemporaryFolder folder;
    const std::string shirt = folder / "shirt.obj", all = folder / "all.obj";
    const Mesh other = moved(0.6);
    writeMesh(other, shirt);
    writeMesh(test::joined(readMesh(body), other), all);
    const auto render = [&](std::vector<std::string> files, const char* picture) {
        files.insert(files.begin(), {command, "render"});
        files.insert(files.end(), {"-o", folder / picture, "--size", "200x150"});
        return runCommand(files);
    };
    BOOST_REQUIRE(render({body, "+", shirt}, "joined.png").status == 0);
    BOOST_REQUIRE(render({all}, "all.png").status == 0);
    BOOST_REQUIRE(render({body, shirt}, "other.png").status == 0);
    BOOST_TEST(test::readText(folder / "joined.png") == test::readText(folder / "all.png"));
    BOOST_TEST(test::readText(folder / "joined.png") != test::readText(folder / "other.png"));
    for (const std::vector<std::string>& wrong :
         {std::vector<std::string>{"+", body}, {body, "+"}, {body, "+", "+", shirt}, {body, "+", "/", shirt}}) {
        const auto result = render(wrong, "wrong.png");
        BOOST_TEST(result.status == 1);
        BOOST_TEST(result.err.find("a lone + must stand between two files") != std::string::npos, result.err);
    }
}

BOOST_AUTO_TEST_SUITE_END()
