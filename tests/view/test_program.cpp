// The program vdbcage-view itself: without a display by EGL and by OSMesa, and in a window under Xvfb.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <support/gl_sources.h>
#include <support/run_command.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using test::runCommand;

namespace fs = std::filesystem;

namespace {

const std::string program = VDBCAGE_VIEW;
const std::string source = VDBCAGE_SOURCE_DIR;
// Of xvfb-run. -noreset: else Xvfb signals it once more when the last window goes, and it may take that for an error.
const std::string displayOptions = "-noreset -screen 0 1600x1000x24";

/// One line on standard error that has `mention`, and exit status 1.
void expectError(const std::vector<std::string>& words, const std::string& mention)
{
    const auto result = runCommand(words);
    BOOST_TEST_CONTEXT(words.back())
    {
        BOOST_TEST(result.status == 1);
        BOOST_TEST(result.err.rfind("vdbcage-view: error: ", 0) == 0u, result.err);
        BOOST_TEST(std::count(result.err.begin(), result.err.end(), '\n') == 1, result.err);
        BOOST_TEST(result.err.find(mention) != std::string::npos, result.err);
    }
}

/// The files that a script of docs writes, the same by EGL, by OSMesa where there is any, and in a window under Xvfb.
std::map<std::string, std::string> walkEverywhere(const std::string& script, const std::vector<std::string>& names)
{
    std::map<std::string, std::string> first;
    std::vector<std::vector<std::string>> ways{{"--without-window", "egl"}, {}};
    if (test::hasOsmesa()) ways.push_back({"--without-window", "osmesa"});
    for (const std::vector<std::string>& how : ways) {
        const test::TemporaryFolder folder;
        fs::create_directory(folder / "build");
        fs::create_directory_symlink(source + "/data", folder / "data");
        std::vector<std::string> words{"env", "-C", folder.path().string()};
        if (how.empty()) words.insert(words.end(), {"xvfb-run", "-a", "-s", displayOptions});
        words.insert(words.end(), {program, "--script", source + "/docs/pictures/" + script});
        words.insert(words.end(), how.begin(), how.end());
        const auto result = runCommand(words);
        BOOST_TEST_REQUIRE(result.status == 0, result.err);
        for (const std::string& name : names) {
            std::string bytes = test::readText(folder / "build" / name);
            // The scene names files by their places.
            if (fs::path(name).extension() == ".json") bytes = bytes.substr(bytes.find("\"digest\""));
            BOOST_TEST(bytes.size() > 100u);
            const auto place = first.emplace(name, bytes).first;
            BOOST_TEST_CONTEXT(name) BOOST_TEST((place->second == bytes));
        }
    }
    return first;
}

} // namespace

BOOST_AUTO_TEST_SUITE(program_of_the_window)

BOOST_AUTO_TEST_CASE(help_names_every_line_and_key)
{
    const auto result = runCommand({program, "--help"});
    BOOST_TEST(result.status == 0);
    for (const char* word : {"--script", "--record", "screenshot", "open-cage", "save-scene", "control+z", "expect"}) {
        BOOST_TEST(result.out.find(word) != std::string::npos, word);
    }
    BOOST_TEST(runCommand({program, "--version"}).out.rfind("vdbcage-view ", 0) == 0u);
}

BOOST_AUTO_TEST_CASE(what_cannot_be_done_is_one_line)
{
    const test::TemporaryFolder folder;
    const std::string script = (folder / "s.view").string();
    test::writeText(script, "open none.obj\n");
    expectError({program}, "display");
    expectError({"env", "--unset=XDG_RUNTIME_DIR", program}, "display"); // as after `su -`
    expectError({program, "--hat"}, "--hat");
    expectError({program, "--without-window", "egl"}, "--script");
    expectError({program, "--script", script, "--without-window", "glx"}, "glx");
    expectError({program, "--script", script}, script + ":1: ");
    expectError({program, "--script", (folder / "none").string()}, "none");
    expectError({program, "none.obj", "--script", script}, "none.obj");
    expectError({program, "--script", script, "--record", (folder / "no" / "r").string()}, "no/r");
    // A display that has no OpenGL 4.5.
    expectError({"xvfb-run", "-a", "-s", displayOptions, "env", "--unset=XDG_RUNTIME_DIR",
                 "MESA_GL_VERSION_OVERRIDE=3.3", program, "--script", script},
                "OpenGL");
}

BOOST_AUTO_TEST_CASE(the_first_walk_looks_the_same_everywhere)
{
    // What the window saves is what the command makes.
    const test::TemporaryFolder made;
    BOOST_TEST(runCommand({VDBCAGE_COMMAND, "make", source + "/data/creature.obj", "-o", (made / "cage.obj").string()})
                   .status == 0);
    const auto files =
        walkEverywhere("first.view", {"first_1_empty.png", "first_2_cage.png", "first_3_drag.png",
                                      "first_4_triquad.png", "first_5_distance.png", "first_6_voxels.png",
                                      "first_cage.obj", "first_scene.cage.obj", "first_scene.json"});
    const std::string cage = test::readText(made / "cage.obj");
    BOOST_TEST((files.at("first_cage.obj") == cage));
    BOOST_TEST((files.at("first_scene.cage.obj") == cage));
}

BOOST_AUTO_TEST_CASE(the_pose_looks_the_same_everywhere_and_is_what_the_command_makes)
{
    const auto files =
        walkEverywhere("pose.view", {"pose_1_box.png", "pose_2_turned.png", "pose_3_influence.png", "pose_4_typed.png",
                                     "pose_5_other_cage.png", "pose_6_split.png", "pose_cage.obj",
                                     "pose_posed_cage.obj", "pose_posed_model.obj", "pose_weights.npy"});
    const test::TemporaryFolder made;
    for (const char* name : {"pose_cage.obj", "pose_posed_cage.obj"}) {
        test::writeText(made / name, files.at(name));
    }
    const std::string model = source + "/data/creature.obj", out = (made / "out.obj").string(),
                      weights = (made / "out.npy").string(), cage = (made / "pose_cage.obj").string();
    BOOST_TEST(runCommand({VDBCAGE_COMMAND, "make", model, "-o", out, "--faces", "300"}).status == 0);
    BOOST_TEST((test::readText(out) == files.at("pose_cage.obj")));
    BOOST_TEST(runCommand({VDBCAGE_COMMAND, "deform", cage, (made / "pose_posed_cage.obj").string(), model, "-o", out,
                           "--coordinates", "green"})
                   .status == 0);
    BOOST_TEST((test::readText(out) == files.at("pose_posed_model.obj")));
    BOOST_TEST(runCommand({VDBCAGE_COMMAND, "bind", cage, model, "-o", weights, "--coordinates", "green"}).status == 0);
    BOOST_TEST((test::readText(weights) == files.at("pose_weights.npy")));
    // The files that were saved are opened as they are named.
    const std::string script = (made / "s.view").string();
    test::writeText(script, "wait\nexpect posed yes\nexpect mode pose\nsave-posed-cage " + out + "\n");
    BOOST_TEST(runCommand({program, model, cage, (made / "pose_posed_cage.obj").string(), "--script", script}).status ==
               0);
    BOOST_TEST((test::readText(out) == files.at("pose_posed_cage.obj")));
}

/// Runs a command that must do.
void must(const std::vector<std::string>& words)
{
    const auto result = runCommand(words);
    BOOST_TEST_REQUIRE(result.status == 0, result.err);
}

BOOST_AUTO_TEST_CASE(what_the_reference_does_is_done_here_and_as_the_command_does_it)
{
    std::vector<std::string> names{"reference_frame.obj", "reference_weights.npy", "reference_cage.obj",
                                   "reference_influence.ply", "reference_6_sample.png"};
    const auto numbered = [](const std::string& before, int frame) {
        return before + (frame < 10 ? "0" : "") + std::to_string(frame) + ".obj";
    };
    for (int frame = 0; frame < 12; ++frame) {
        names.push_back(numbered("reference_cage.", frame));
        names.push_back(numbered("reference_model.", frame));
    }
    const test::TemporaryFolder folder;
    fs::create_directory(folder / "build");
    fs::create_directory_symlink(source + "/data", folder / "data");
    fs::create_directory_symlink(source + "/docs", folder / "docs");
    must({"env", "-C", folder.path().string(), program, "--script", "docs/pictures/reference.view", "--without-window",
          "any"});
    const auto file = [&](const std::string& name) { return (folder / "build" / name).string(); };
    for (const std::string& name : names) BOOST_TEST(fs::exists(file(name)), name);
    const std::string model = source + "/data/creature.obj", cage = file("reference_cage.obj");
    must({VDBCAGE_COMMAND, "make", model, "-o", file("made.obj"), "--resolution", "128", "--mesh", "triquad",
          "--quad-shape", "0", "--faces", "150"});
    BOOST_TEST((test::readText(file("made.obj")) == test::readText(cage)));
    must({VDBCAGE_COMMAND, "deform", cage, file("reference_cage.%02d.obj"), model, "-o", file("deformed.%02d.obj")});
    for (int frame = 0; frame < 12; ++frame) {
        BOOST_TEST((test::readText(file(numbered("deformed.", frame))) ==
                    test::readText(file(numbered("reference_model.", frame)))));
    }
    BOOST_TEST((test::readText(file("reference_frame.obj")) == test::readText(file("reference_model.11.obj"))));
    must({VDBCAGE_COMMAND, "bind", cage, model, "-o", file("bound.npy")});
    BOOST_TEST((test::readText(file("bound.npy")) == test::readText(file("reference_weights.npy"))));
}

BOOST_AUTO_TEST_CASE(a_walk_opened_as_a_sequence_gives_the_frames_of_deform)
{
    const test::TemporaryFolder folder;
    const std::string model = source + "/data/creature.obj", cage = (folder / "cage.obj").string();
    const auto file = [&](const std::string& name) { return (folder / name).string(); };
    must({VDBCAGE_COMMAND, "make", model, "-o", cage, "--mesh", "triquad"});
    fs::create_directory(folder / "walk");
    must({VDBCAGE_WALK, cage, file("walk")});
    test::writeText(file("s.view"), "open " + model + "\nset mesh triquad\nwait\nmode pose\ncoordinates green\n" +
                                        "open-poses " + file("walk/walk.0003.obj") +
                                        "\nexpect keys 12\nwait\nsave-posed-models " + file("here.%04d.obj") +
                                        "\nsave-posed-cages " + file("cage.%04d.obj") + "\n");
    must({program, "--script", file("s.view"), "--without-window", "any"});
    must({VDBCAGE_COMMAND, "deform", cage, file("walk/walk.%04d.obj"), model, "-o", file("there.%04d.obj"),
          "--coordinates", "green"});
    for (int frame = 0; frame < 12; ++frame) {
        const std::string number = (frame < 10 ? "000" : "00") + std::to_string(frame) + ".obj";
        BOOST_TEST((test::readText(file("here." + number)) == test::readText(file("there." + number))));
        BOOST_TEST(readMesh(file("cage." + number)).points == readMesh(file("walk/walk." + number)).points,
                   boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(an_edited_cage_that_cuts_is_fitted_as_the_command_does_it)
{
    const test::TemporaryFolder folder;
    const auto file = [&](const std::string& name) { return (folder / name).string(); };
    const std::string model = source + "/data/bishop.obj";
    const std::vector<std::string> script{"open " + model,
                                          "set effort fast",
                                          "set resolution 24",
                                          "set faces 80",
                                          "set precision float64", // as files of the command have it
                                          "wait",
                                          "expect bounding yes",
                                          "select points 0 1 2 3 4 5 6 7 8 9 10 11",
                                          "scale 0.7 1 0.7 0 0 0",
                                          "select points 30 31",
                                          "lock",
                                          "wait",
                                          "expect bounding no",
                                          "save-cage " + file("drawn.obj"),
                                          "widget fit press",
                                          "wait",
                                          "expect fit 0.5",
                                          "expect fit-problem none",
                                          "expect bounding yes",
                                          "save-cage " + file("fitted.obj"),
                                          "mouse move tight 0.5",
                                          "mouse down",
                                          "mouse move tight 0.8",
                                          "mouse move tight 1",
                                          "mouse up",
                                          "wait",
                                          "expect fit 1",
                                          "expect bounding yes",
                                          "save-cage " + file("tight.obj"),
                                          "undo",
                                          "expect fit off",
                                          "expect undo lock",
                                          "wait",
                                          "expect bounding no",
                                          "save-cage " + file("undone.obj")};
    std::string lines;
    for (const std::string& line : script) lines += line + '\n';
    test::writeText(file("s.view"), lines);
    must({program, "--script", file("s.view"), "--without-window", "any"});
    BOOST_TEST((test::readText(file("undone.obj")) == test::readText(file("drawn.obj"))));
    for (const auto& [name, tightness] :
         std::vector<std::pair<std::string, std::string>>{{"fitted.obj", "0.5"}, {"tight.obj", "1"}}) {
        must({VDBCAGE_COMMAND, "check", file(name), model});
        must({VDBCAGE_COMMAND, "fit", file("drawn.obj"), model, "-o", file("command.obj"), "--tight", tightness,
              "--keep", "points:30,31"});
        BOOST_TEST(readMesh(file(name)).points == readMesh(file("command.obj")).points,
                   boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(what_is_recorded_does_the_same_again)
{
    const test::TemporaryFolder folder;
    const std::string script = (folder / "s.view").string(), recording = (folder / "r.view").string();
    const std::string save = "wait\nsave-cage \"" + (folder / "cage.obj").string() + "\"\n";
    test::writeText(script,
                    "set effort fast\nset resolution 24\nwidget faces 60\nmouse move smooth.slider 0\nmouse down\n"
                    "mouse move smooth.slider 0.5\nmouse up\nkey keypad-3\n" +
                        save);
    const std::string model = source + "/data/bishop.obj";
    BOOST_TEST(runCommand({program, model, "--script", script, "--record", recording}).status == 0);
    const std::string cage = test::readText(folder / "cage.obj");
    fs::remove(folder / "cage.obj");
    std::string recorded = test::readText(recording);
    BOOST_TEST(recorded.find("set faces 60") != std::string::npos, recorded);
    BOOST_TEST(recorded.find("set smooth ") != std::string::npos);
    BOOST_TEST(recorded.find("camera ") != std::string::npos);
    // Lines of the script itself are not what a user does.
    test::writeText(script, "set effort fast\nset resolution 24\n" + recorded + save);
    BOOST_TEST(runCommand({program, "--script", script}).status == 0);
    BOOST_TEST(test::readText(folder / "cage.obj") == cage);
}

BOOST_AUTO_TEST_SUITE_END()
