// Polygons of many corners and many copies: they are bounded however they are split, and take no more than their due.

#include <boost/test/unit_test.hpp>

#include <cmath>

#include <nlohmann/json.hpp>
#include <support/run_command.h>
#include <vdbcage/core/detail/pi.h>

using namespace vdbcage;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

std::string circle(int corners, double height)
{
    std::string text;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * detail::pi * i / corners;
        text += "v " + std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + ' ' +
                std::to_string(height + 0.2 * std::cos(2 * angle)) + '\n';
    }
    return text;
}

std::string face(int first, int corners)
{
    std::string text = "f";
    for (int i = 0; i < corners; ++i) text += ' ' + std::to_string(first + i);
    return text + '\n';
}

/// A polygon far from flat, whose corners lie near to and far from its middle by turns.
std::string crown(int corners)
{
    std::string text;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * detail::pi * i / corners, radius = i % 2 == 0 ? 1 : 0.6;
        text += "v " + std::to_string(radius * std::cos(angle)) + ' ' + std::to_string(radius * std::sin(angle)) + ' ' +
                std::to_string(0.5 * std::cos(3 * angle)) + '\n';
    }
    return text;
}

/// The fan around the first corner, as triangles.
std::string fan(int corners)
{
    std::string text;
    for (int i = 2; i < corners; ++i) text += "f 1 " + std::to_string(i) + ' ' + std::to_string(i + 1) + '\n';
    return text;
}

nlohmann::json jsonOf(const std::filesystem::path& path)
{
    return nlohmann::json::parse(test::readText(path));
}

} // namespace

BOOST_AUTO_TEST_SUITE(polygons)

BOOST_AUTO_TEST_CASE(large_polygons_are_bounded_as_ears_and_as_the_fan_around_their_first_corner)
{
    const TemporaryFolder folder;
    for (const int corners : {66, 200}) {
        test::writeText(folder / "model.obj", crown(corners) + face(1, corners));
        test::writeText(folder / "fan.obj", crown(corners) + fan(corners));
        for (const char* mesh : {"triangles", "triquad"}) {
            const auto made = runCommand({command, "make", folder / "model.obj", "-o", folder / "cage.obj", "--faces",
                                          "150", "--effort", "fast", "--mesh", mesh, "--report", folder / "made.json"});
            BOOST_TEST_REQUIRE(made.status == 0, made.err);
            const auto report = jsonOf(folder / "made.json");
            BOOST_TEST(report["result"]["start"] == "closing"); // not only because it is a box
            BOOST_TEST(report["models"][0]["splits_certified_up_to_corners"] == 64);
            for (const char* model : {"model.obj", "fan.obj"}) {
                const auto checked = runCommand({command, "check", folder / "cage.obj", folder / model});
                BOOST_TEST(checked.status == 0, checked.out);
            }
        }
    }
}

// Without dropping copies it takes eight times as much.
BOOST_AUTO_TEST_CASE(copies_of_a_polygon_take_little_memory)
{
    const TemporaryFolder folder;
    std::string text = circle(64, 0) + circle(64, 1);
    for (int i = 0; i < 2500; ++i) text += face(1, 64);
    test::writeText(folder / "copies.obj", text + face(65, 64));
    const std::string make = "ulimit -v 400000; MALLOC_ARENA_MAX=2 exec '" + command + "' make '" +
                             (folder / "copies.obj").string() + "' -o '" + (folder / "cage.obj").string() +
                             "' --faces 100 --effort fast --threads 2 --report '" + (folder / "made.json").string() +
                             "'";
    const auto made = runCommand({"sh", "-c", make});
    BOOST_TEST_REQUIRE(made.status == 0, made.err);
    const auto report = jsonOf(folder / "made.json");
    BOOST_TEST(report["models"][0]["triangles"] == 2501 * 62); // they are counted
    BOOST_TEST(report["models"][0]["polygons_split"] == 2501);
    BOOST_TEST(report["check"]["bounding"] == true);
}

BOOST_AUTO_TEST_SUITE_END()
