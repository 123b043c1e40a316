// Polygons of many corners and many copies: what is said about them, and that they take no more than their due.

#include <boost/test/unit_test.hpp>

#include <cmath>

#include <nlohmann/json.hpp>
#include <support/run_command.h>

using namespace vdbcage;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

std::string circle(int corners, double height)
{
    std::string text;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * 3.14159265358979 * i / corners;
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

/// A lid and a bottom of 100 corners each, and a face of five.
const std::string large = circle(100, 0) + circle(100, 1) + circle(5, 2) + face(1, 100) + face(101, 100) + face(201, 5);
const std::string line = "  2 faces of more than 64 corners: certified as split here, not under other splits\n";

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

nlohmann::json jsonOf(const std::filesystem::path& path)
{
    return nlohmann::json::parse(test::readText(path));
}

} // namespace

BOOST_AUTO_TEST_SUITE(polygons)

BOOST_AUTO_TEST_CASE(make_and_check_tell_which_splits_are_certified)
{
    const TemporaryFolder folder;
    test::writeText(folder / "large.obj", large);
    const auto made = runCommand({command, "make", folder / "large.obj", "-o", folder / "cage.obj", "--faces", "100",
                                  "--effort", "fast", "--report", folder / "made.json"});
    BOOST_TEST_REQUIRE(made.status == 0, made.err);
    BOOST_TEST(has(made.err, line), made.err);
    const auto checked =
        runCommand({command, "check", folder / "cage.obj", folder / "large.obj", "--report", folder / "checked.json"});
    BOOST_TEST(checked.status == 0, checked.err);
    BOOST_TEST(has(checked.out, line), checked.out);
    for (const char* report : {"made.json", "checked.json"}) {
        const auto model = jsonOf(folder / report)["models"][0];
        BOOST_TEST(model["splits_certified_up_to_corners"] == 64);
        BOOST_TEST(model["faces_certified_as_split"] == 2);
    }
    const auto quiet = runCommand({command, "make", folder / "large.obj", "-o", folder / "cage.obj", "--faces", "100",
                                   "--effort", "fast", "--quiet"});
    BOOST_TEST(quiet.err.empty(), quiet.err);
}

BOOST_AUTO_TEST_CASE(nothing_is_said_where_every_split_is_certified)
{
    const TemporaryFolder folder;
    test::writeText(folder / "small.obj", circle(64, 0) + circle(5, 1) + face(1, 64) + face(65, 5));
    const auto made = runCommand({command, "make", folder / "small.obj", "-o", folder / "cage.obj", "--faces", "100",
                                  "--effort", "fast", "--report", folder / "made.json"});
    BOOST_TEST_REQUIRE(made.status == 0, made.err);
    BOOST_TEST(!has(made.err, "corners"), made.err);
    const auto model = jsonOf(folder / "made.json")["models"][0];
    BOOST_TEST(model["splits_certified_up_to_corners"] == 64);
    BOOST_TEST(model["faces_certified_as_split"] == 0);
}

// Without dropping copies it takes eight times as much.
BOOST_AUTO_TEST_CASE(copies_of_a_polygon_take_little_memory)
{
    const TemporaryFolder folder;
    std::string text = circle(64, 0) + circle(64, 1);
    for (int i = 0; i < 20000; ++i) text += face(1, 64);
    test::writeText(folder / "copies.obj", text + face(65, 64));
    const std::string make = "ulimit -v 2000000; MALLOC_ARENA_MAX=2 exec '" + command + "' make '" +
                             (folder / "copies.obj").string() + "' -o '" + (folder / "cage.obj").string() +
                             "' --faces 100 --effort fast --report '" + (folder / "made.json").string() + "'";
    const auto made = runCommand({"sh", "-c", make});
    BOOST_TEST_REQUIRE(made.status == 0, made.err);
    const auto report = jsonOf(folder / "made.json");
    BOOST_TEST(report["models"][0]["triangles"] == 20001 * 62); // they are counted
    BOOST_TEST(report["models"][0]["polygons_split"] == 20001);
    BOOST_TEST(report["models"][0]["faces_certified_as_split"] == 0);
    BOOST_TEST(report["check"]["bounding"] == true);
}

BOOST_AUTO_TEST_SUITE_END()
