#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <support/read_json.h>
#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/check/check.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/mesh/symmetry.h>

using namespace vdbcage;
using test::readJson;
using test::readText;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

/// A box by hand, with what modelling programs write beside points, a pentagon and a triangle.
const char* const drawnBox = R"(# drawn by hand
mtllib cage.mtl
o Cage
v -1 -1 -1 0.5 0.5 0.5
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1 # a corner
v 1 1 1
v -1 1 1
v 0 1.1 1
vt 0 0
vt 1 0
vt 1 1
g sides
usemtl blue
s off
f 1/1 5/2 8/3 4/1
f 2/1 3/2 7/3 6/1
f 1/1 2/1 6/2 5/3
g top
f 3/1 4/1 8/1 9/2 7/1
f 4 3 2 1
f 5/1 6/2 9/3
f 6 7 9
f 5 9 8
)";

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// A folder with a drawn box, and a ball that sticks out of it.
struct Scene : TemporaryFolder {
    Scene()
    {
        test::writeText(*this / "cage.obj", drawnBox);
        writeMesh(test::sphere({0.2, 0, 0}, 1.1, 12), *this / "ball.obj");
    }
    auto fit(const std::vector<std::string>& words, const std::string& out = "new.obj") const
    {
        std::vector<std::string> all{command, "fit", *this / "cage.obj", *this / "ball.obj", "-o", *this / out.c_str()};
        all.insert(all.end(), words.begin(), words.end());
        return runCommand(all);
    }
    bool exists(const char* name) const { return std::filesystem::exists(std::filesystem::path(*this / name)); }
};

} // namespace

BOOST_AUTO_TEST_SUITE(fits)

BOOST_AUTO_TEST_CASE(only_lines_of_points_change)
{
    const Scene scene;
    for (const char* tight : {"0", "0.5", "1"}) {
        const auto result = scene.fit({"--tight", tight});
        BOOST_TEST_REQUIRE(result.status == 0, result.err);
        BOOST_TEST(result.out.find("new.obj: bounding\n") != std::string::npos, result.out);
        BOOST_TEST(checkCage(readMesh(scene / "new.obj"), readMesh(scene / "ball.obj")).bounding());
        const auto before = linesOf(drawnBox), after = linesOf(readText(scene / "new.obj"));
        BOOST_TEST_REQUIRE(before.size() == after.size());
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (before[i].compare(0, 2, "v ") != 0) BOOST_TEST(before[i] == after[i]);
        }
        BOOST_TEST(after[8].find(" # a corner") != std::string::npos);
        BOOST_TEST(after[3].find(" 0.5 0.5 0.5") != std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(a_cage_that_bounds_comes_back_byte_for_byte)
{
    const Scene scene;
    const std::string large = std::string(drawnBox) + "# a ball of half a width is inside\r\n";
    test::writeText(scene / "cage.obj", large);
    writeMesh(test::sphere({0, 0, 0}, 0.5, 8), scene / "ball.obj");
    const auto result = scene.fit({"--tight", "0"});
    BOOST_TEST(result.status == 0, result.err);
    BOOST_TEST(readText(scene / "new.obj") == large);
    BOOST_TEST(result.out.find("points moved              0 of 9\n") != std::string::npos, result.out);
}

BOOST_AUTO_TEST_CASE(points_of_keep_stay)
{
    const Scene scene;
    // The ball is far from this corner, which the other points leave alone.
    test::writeText(scene / "kept.txt", "0\n2-3,\n");
    const auto moved = [&](const std::vector<std::string>& words) {
        BOOST_TEST_REQUIRE(scene.fit(words).status == 0);
        return readMesh(scene / "new.obj").points;
    };
    const std::vector<openvdb::Vec3d> before = readMesh(scene / "cage.obj").points;
    const auto all = moved({"--tight", "1"});
    BOOST_TEST((all[0] != before[0]));
    for (const std::string& keep : {std::string("points:0"), std::string("points:0-0,0")})
        BOOST_TEST((moved({"--tight", "1", "--keep", keep})[0] == before[0]));
    const auto byFile = scene.fit({"--keep", scene / "kept.txt", "--report", scene / "r.json"});
    if (byFile.status == 0) {
        const auto points = readMesh(scene / "new.obj").points;
        for (const std::size_t i : {0U, 2U, 3U}) BOOST_TEST((points[i] == before[i]));
    } else {
        BOOST_TEST(!readJson(scene / "r.json")["held_faces"].empty());
    }
}

BOOST_AUTO_TEST_CASE(points_slide_along_axes_and_go_no_farther)
{
    const Scene scene;
    const auto before = readMesh(scene / "cage.obj").points;
    const auto moved = [&](const std::vector<std::string>& words) {
        const auto result = scene.fit(words);
        BOOST_TEST_REQUIRE(result.status == 0, result.err);
        return readMesh(scene / "new.obj").points;
    };
    const auto slid = moved({"--tight", "1", "--keep", "points:0-1:yz,2:x"});
    for (const std::size_t i : {0U, 1U}) BOOST_TEST(slid[i][0] == before[i][0]);
    for (const int axis : {1, 2}) BOOST_TEST(slid[2][axis] == before[2][axis]);
    BOOST_TEST((slid[0] != before[0]));
    for (const auto& [words, most] :
         {std::pair(std::vector<std::string>{"--tight", "1"}, 10.0),
          std::pair(std::vector<std::string>{"--tight", "1", "--most", "0.2"}, 0.2 * 2.2)}) {
        const auto points = moved(words);
        for (std::size_t i = 0; i < points.size(); ++i) BOOST_TEST((points[i] - before[i]).length() <= most);
    }
}

BOOST_AUTO_TEST_CASE(symmetric_cages_stay_so)
{
    const Scene scene;
    writeMesh(test::sphere({0.201, 0, 0}, 1, 8), scene / "cage.obj");
    const auto result = scene.fit({"--symmetry", "x"});
    BOOST_TEST_REQUIRE(result.status == 0, result.err);
    const Mesh cage = readMesh(scene / "new.obj"), model = readMesh(scene / "ball.obj");
    BOOST_TEST(checkCage(cage, model).bounding());
    const double plane = bestSymmetry(model, 0).plane.offset;
    for (const openvdb::Vec3d& p : cage.points) {
        const openvdb::Vec3d image(2 * plane - p[0], p[1], p[2]);
        const bool hasImage = std::any_of(cage.points.begin(), cage.points.end(),
                                          [&](const openvdb::Vec3d& q) { return (q - image).length() < 1e-5; });
        BOOST_TEST(hasImage);
    }
}

BOOST_AUTO_TEST_CASE(cages_of_other_places_are_told_and_placed)
{
    const Scene scene;
    // The ball in other units, elsewhere.
    writeMesh(test::sphere({1000, 20, 0}, 110, 12), scene / "ball.obj");
    const auto asItIs = scene.fit({"-v"});
    const std::string told = "and 100 % of the model's vertices are outside of it; --place scales";
    BOOST_TEST(asItIs.err.find(told) < asItIs.err.find("fit"), asItIs.err); // before the work
    const auto held = scene.fit({"--keep", "points:0-8"});
    BOOST_TEST(held.status == 1);
    BOOST_TEST(held.err.find(told) != std::string::npos, held.err);
    for (const char* turn : {"", "turn"}) {
        std::vector<std::string> words{"--place"};
        if (*turn) words.emplace_back(turn);
        const auto placed = scene.fit(words);
        BOOST_TEST_REQUIRE(placed.status == 0, placed.err);
        BOOST_TEST(placed.err == "");
        BOOST_TEST(checkCage(readMesh(scene / "new.obj"), readMesh(scene / "ball.obj")).bounding());
    }
    // The box is that of the whole model, also where half of it is fitted.
    writeMesh(test::sphere({0, 0, 0}, 1, 8), scene / "cage.obj");
    const auto symmetric = scene.fit({"--place", "--symmetry", "x", "--tight", "0", "--most", "0.2"});
    BOOST_TEST_REQUIRE(symmetric.status == 0, symmetric.err);
    const double width = boundingBox(readMesh(scene / "new.obj")).extents()[0];
    BOOST_TEST(width < 260);
    // A file after --place is none of its values.
    BOOST_TEST(runCommand({command, "fit", scene / "cage.obj", "--place", scene / "ball.obj", "-o", scene / "new.obj"})
                   .status == 0);
}

BOOST_AUTO_TEST_CASE(a_model_in_the_place_of_its_cage_is_told)
{
    const Scene scene;
    writeMesh(test::sphere({0, 0, 0}, 3, 12), scene / "cage.obj");
    const auto swapped = runCommand({command, "fit", scene / "ball.obj", scene / "cage.obj", "-o", scene / "new.obj"});
    BOOST_TEST(swapped.err.find("ball.obj: it is inside of") == std::string::npos); // neither is the finer one
    writeMesh(test::box({-3, -3, -3}, {3, 3, 3}), scene / "cage.obj");
    const auto told = runCommand({command, "fit", scene / "ball.obj", scene / "cage.obj", "-o", scene / "new.obj"});
    BOOST_TEST(told.status == 1);
    BOOST_TEST(told.err.find("which bounds it: give the cage first, then the model") != std::string::npos, told.err);
    BOOST_TEST(!told.err.empty());
}

BOOST_AUTO_TEST_CASE(a_cage_without_room_is_not_written)
{
    const Scene scene;
    test::writeText(scene / "new.obj", "it was there before");
    const auto result = scene.fit({"--keep", "points:0-8", "--report", scene / "r.json"});
    BOOST_TEST(result.status == 1);
    BOOST_TEST(result.out == "");
    BOOST_TEST(result.err.find("cage.obj: no place was found where it does not cut the model (faces ") !=
                   std::string::npos,
               result.err);
    BOOST_TEST(result.err.find("; kept: points 0, 1, ") != std::string::npos, result.err);
    BOOST_TEST(readText(scene / "new.obj") == "it was there before");
    const auto report = readJson(scene / "r.json");
    BOOST_TEST(report["fitted"].is_null());
    BOOST_TEST(report["held_faces"].size() > 2U);
    BOOST_TEST(report["moved_points"] == 0);
    BOOST_TEST(report["before"] == report["check"]);
}

BOOST_AUTO_TEST_CASE(reports_have_the_way_of_each_point)
{
    const Scene scene;
    BOOST_TEST_REQUIRE(scene.fit({"--report", scene / "r.json"}).status == 0);
    const auto report = readJson(scene / "r.json");
    const auto before = readMesh(scene / "cage.obj").points, after = readMesh(scene / "new.obj").points;
    BOOST_TEST_REQUIRE(report["ways"].size() == before.size());
    std::size_t moved = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        BOOST_TEST(report["ways"][i].get<double>() == (after[i] - before[i]).length());
        moved += after[i] != before[i];
    }
    BOOST_TEST(report["moved_points"] == moved);
    BOOST_TEST(report["check"]["bounding"] == true);
    BOOST_TEST(report["before"]["bounding"] == false);
}

BOOST_AUTO_TEST_CASE(other_formats_and_lists_are_refused)
{
    const Scene scene;
    const auto refuses = [&](const std::vector<std::string>& words, const std::string& out, const char* text) {
        const auto result = scene.fit(words, out);
        BOOST_TEST(result.status == 1);
        BOOST_TEST(result.err.find(text) != std::string::npos, result.err);
        BOOST_TEST(!scene.exists(out.c_str()));
    };
    refuses({}, "new.ply", "its extension must be that of the cage, .obj");
    refuses({"--tight", "2"}, "new.obj", "--tight: 2 is not allowed; it must be 0 to 1");
    for (const char* list :
         {"points:", "points:1-", "points:3-1", "points:x", "points:-1", "points:1 2 q", "points:1:", "points:1:w"})
        refuses({"--keep", list}, "new.obj", "is not allowed; it must be numbers of points, as 1-20,35");
    refuses({"--most", "-1"}, "new.obj", "--most: -1 is not allowed; it must be 0 to inf");
    refuses({"--place=up"}, "new.obj", "--place: up is not allowed; it must be turn, or nothing");
    refuses({"--keep", "points:9"}, "new.obj", "--keep: 9 is not allowed; the cage has 9 points");
    refuses({"--keep", scene / "missing.txt"}, "new.obj", "missing.txt");
}

BOOST_AUTO_TEST_SUITE_END()
