// What a command writes: never over what it reads, whole or not at all, and only what it made goes away again.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <set>

#include <sys/resource.h>

#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/volume/vdb_io.h>

using namespace vdbcage;
using test::runCommand;
using test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string command = VDBCAGE_COMMAND;

/// A folder with a model, a cage around it, that cage posed, and stages.
struct Scene {
    Scene()
    {
        writeMesh(test::sphere({0, 0, 0}, 1, 12), model);
        writeMesh(test::box({-2, -2, -2}, {2, 2, 2}), cage);
        writeMesh(test::box({-2, -2, -2}, {2, 3, 2}), posed);
        fs::create_directory(folder / "st");
        const auto scale = openvdb::MaskGrid::create();
        scale->sparseFill(openvdb::CoordBBox(openvdb::Coord(-2), openvdb::Coord(2)), true);
        for (const char* name : {"st/closed.vdb", "st/solid.vdb", "scale.vdb"}) writeVdb(*scale, folder / name);
        for (const char* name : {"st/surface.obj", "st/decimated.obj"})
            writeMesh(test::sphere({0, 0, 0}, 1, 12), folder / name);
        for (const char* name : {"hard.json", "hard.npy"}) fs::create_hard_link(model, folder / name);
        fs::create_symlink("model.obj", folder / "soft.json");
        fs::create_symlink("st", folder / "same");
    }

    std::map<std::string, std::string> contents() const
    {
        std::map<std::string, std::string> all;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
            std::error_code ignored; // of links that lead nowhere
            all[entry.path().string()] = entry.is_regular_file(ignored) ? test::readText(entry.path()) : "";
        }
        return all;
    }

    TemporaryFolder folder;
    const std::string at = folder.path().string() + "/";
    const std::string model = at + "model.obj", cage = at + "cage.obj", posed = at + "posed.obj";
};

/// What `repair` refuses to do because of `mention`. Without its part of the build it refuses everything.
std::string ofRepair(const std::string& mention)
{
    return VDBCAGE_HAS_GPL_PART ? mention : "VDBCAGE_WITH_CGAL_GPL";
}

/// Runs `words` with @ for the scene's folder; exit status 1 with one line that holds `mention`, and nothing changed.
void expectRefusal(const Scene& scene, std::vector<std::string> words, const std::string& mention)
{
    words.insert(words.begin(), command);
    for (std::string& word : words) {
        if (const auto place = word.find('@'); place != std::string::npos) word.replace(place, 1, scene.at);
    }
    const auto before = scene.contents();
    const auto result = runCommand(words);
    BOOST_TEST_CONTEXT(words[1] << " ... " << words.back())
    {
        BOOST_TEST(result.status == 1);
        BOOST_TEST(std::count(result.err.begin(), result.err.end(), '\n') == 1, result.err);
        BOOST_TEST(result.err.find(mention) != std::string::npos, result.err);
        BOOST_CHECK(scene.contents() == before);
    }
}

} // namespace

BOOST_AUTO_TEST_SUITE(outputs)

BOOST_AUTO_TEST_CASE(no_output_is_an_input)
{
    const Scene scene;
    const std::string input = ", which would be overwritten";
    for (const char* report : {"@model.obj", "@cage.obj", "@hard.json", "@soft.json", "@st/../model.obj"}) {
        expectRefusal(scene, {"check", "@cage.obj", "@model.obj", "--report", report}, input);
    }
    expectRefusal(scene, {"make", "@st/surface.obj", "-o", "@o.obj", "--stages", "@st"}, input);
    expectRefusal(scene, {"make", "@st/surface.obj", "-o", "@o.obj", "--stages", "@same"}, input);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--scale-field", "@st/closed.vdb", "--stages", "@st"},
                  input);
    expectRefusal(
        scene, {"make", "@model.obj", "-o", "@o.obj", "--scale-field", "@scale.vdb", "--report", "@scale.vdb"}, input);
    expectRefusal(scene,
                  {"make", "@model.obj", "-o", "@o.obj", "--scale-field", "sphere:0,0,0,1,1;@scale.vdb", "--report",
                   "@scale.vdb"},
                  input);
    expectRefusal(scene, {"bind", "@cage.obj", "@model.obj", "-o", "@hard.npy"}, input);
    expectRefusal(scene, {"deform", "@cage.obj", "@posed.obj", "@model.obj", "-o", "@posed.obj"}, input);
    expectRefusal(scene, {"repair", "@cage.obj", "-o", "@cage.obj"}, ofRepair(input));
    expectRefusal(scene, {"repair", "@cage.obj", "-o", "@o.obj", "--report", "@cage.obj"}, ofRepair(input));
}

BOOST_AUTO_TEST_CASE(frames_are_not_written_over_frames)
{
    const Scene scene;
    for (const char* name : {"f.0001.obj", "f.0002.obj"}) fs::copy_file(scene.posed, scene.folder / name);
    fs::create_hard_link(scene.folder / "f.0002.obj", scene.folder / "g.0001.obj");
    expectRefusal(scene, {"deform", "@cage.obj", "@f.%04d.obj", "@model.obj", "-o", "@f.%04d.obj"}, "it is the input");
    expectRefusal(scene, {"deform", "@cage.obj", "@f.%04d.obj", "@model.obj", "-o", "@g.%04d.obj"}, "it is the input");
    fs::remove(scene.folder / "g.0001.obj");
    writeMesh(test::box({-2, -2, -2}, {2, 2, 2}), scene.folder / "g.0001.obj");
    fs::create_symlink("g.0001.obj", scene.folder / "g.0002.obj");
    expectRefusal(scene, {"deform", "@cage.obj", "@f.%04d.obj", "@model.obj", "-o", "@g.%04d.obj"}, "named twice");
}

BOOST_AUTO_TEST_CASE(no_output_is_written_twice)
{
    const Scene scene;
    const std::string twice = "this file is named twice; all outputs must be different files";
    expectRefusal(scene, {"make", "@model.obj", "-o", "@st/surface.obj", "--stages", "@st"}, twice);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@same/decimated.obj", "--stages", "@st"}, twice);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--report", "@same/../st/solid.vdb", "--stages", "@st"},
                  twice);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--report", "@new.png", "--picture", "@./new.png"},
                  twice);
    expectRefusal(scene, {"repair", "@cage.obj", "-o", "@o.obj", "--report", "@st/../o.obj"}, ofRepair(twice));
}

BOOST_AUTO_TEST_CASE(stages_may_go_beside_the_model_under_names_that_are_free)
{
    const Scene scene;
    for (const char* name : {"st/surface.obj", "st/decimated.obj", "st/solid.vdb", "st/closed.vdb"})
        fs::remove(scene.folder / name);
    const auto made = runCommand({command, "make", scene.model, "-o", scene.at + "st/cage.obj", "--stages",
                                  scene.at + "same", "--resolution", "16", "--report", scene.at + "new.json"});
    BOOST_TEST(made.status == 0, made.err);
    BOOST_TEST(made.err.find("certified bounding") != std::string::npos, made.err);
    BOOST_TEST(runCommand({command, "check", scene.at + "st/cage.obj", scene.model}).status == 0);
    BOOST_TEST(std::distance(fs::directory_iterator(scene.folder / "st"), {}) == 8);
}

BOOST_AUTO_TEST_CASE(all_outputs_may_go_into_the_folder_that_is_made)
{
    const Scene scene;
    const auto made =
        runCommand({command, "make", scene.model, "-o", scene.at + "new/cage.obj", "--stages", scene.at + "new/",
                    "--report", scene.at + "./new/r.json", "--resolution", "16", "-q"});
    BOOST_TEST(made.status == 0, made.err);
    BOOST_TEST(std::distance(fs::directory_iterator(scene.folder / "new"), {}) == 9);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@other/solid.vdb/o.obj", "--stages", "@other"},
                  "does not exist");
    expectRefusal(scene, {"make", "@model.obj", "-o", "@other/surface.obj", "--stages", "@other/"}, "named twice");
}

BOOST_AUTO_TEST_CASE(a_file_that_is_replaced_keeps_its_mode)
{
    const Scene scene;
    const fs::perms mode = fs::perms::owner_read | fs::perms::owner_write;
    const std::vector<std::string> names{"o.obj", "r.json", "p.png", "d.obj", "w.npy", "v.json", "st/solid.vdb"};
    for (const std::string& name : names) {
        test::writeText(scene.folder / name, "old");
        fs::permissions(scene.folder / name, mode);
    }
    BOOST_TEST(runCommand({command, "make", scene.model, "-o", scene.at + "o.obj", "--report", scene.at + "r.json",
                           "--picture", scene.at + "p.png", "--stages", scene.at + "st", "--resolution", "16"})
                   .status == 0);
    BOOST_TEST(runCommand({command, "check", scene.cage, scene.model, "--report", scene.at + "v.json"}).status == 0);
    BOOST_TEST(runCommand({command, "bind", scene.cage, scene.model, "-o", scene.at + "w.npy"}).status == 0);
    BOOST_TEST(runCommand({command, "deform", scene.cage, scene.posed, scene.model, "-o", scene.at + "d.obj"}).status ==
               0);
    for (const std::string& name : names) {
        BOOST_TEST(test::readText(scene.folder / name) != "old", name);
        BOOST_CHECK(fs::status(scene.folder / name).permissions() == mode);
    }
}

BOOST_AUTO_TEST_CASE(a_limit_on_the_size_of_files_is_an_error_and_no_signal)
{
    const Scene scene;
    // One block of 1024 bytes; the signal has its default action, which is to end the process.
    const auto before = scene.contents();
    const auto result = runCommand(
        {"bash", "-c",
         "ulimit -f 1; exec " + command + " make " + scene.model + " --resolution 16 -q -o " + scene.at + "o.obj"});
    BOOST_TEST(result.status == 1);
    BOOST_TEST(result.err == "vdbcage: error: " + scene.at + "o.obj: cannot be written: File too large\n");
    BOOST_CHECK(scene.contents() == before);
}

BOOST_AUTO_TEST_CASE(a_verdict_that_cannot_be_printed_is_an_error)
{
    const Scene scene;
    const std::string check = " check " + scene.cage + " " + scene.model;
    for (const std::string& words : {command + check + " >/dev/full", command + check + " >&-",
                                     command + " --help >/dev/full", command + " make --help >/dev/full",
                                     command + " deform --inversions -q " + scene.cage + " " + scene.posed + " " +
                                         scene.model + " -o " + scene.at + "d.obj >/dev/full",
                                     // nobody reads: true has ended before anything is written
                                     "set -o pipefail; (sleep 0.2; exec " + command + check + ") | true"}) {
        const auto result = runCommand({"bash", "-c", words});
        BOOST_TEST(result.status == (words.find("/dev/full") == std::string::npos ? 1 : 75), words);
        BOOST_TEST(result.err.find("vdbcage: error: standard output: cannot be written") == 0U, result.err);
    }
    BOOST_TEST(!fs::exists(scene.folder / "d.obj"));
    BOOST_TEST(runCommand({"bash", "-c", command + check + " -q >&-"}).status == 0); // nothing to print
}

BOOST_AUTO_TEST_CASE(closed_descriptors_are_not_taken_for_files)
{
    const Scene scene;
    // Were the first file that is opened to become standard error, the summary would go into it.
    BOOST_TEST(runCommand({"bash", "-c",
                           command + " make " + scene.model + " -o " + scene.at + "o.obj --resolution 16 <&- >&- 2>&-"})
                   .status == 0);
    BOOST_TEST(runCommand({command, "check", scene.at + "o.obj", scene.model}).status == 0);
    BOOST_TEST(test::readText(scene.folder / "o.obj").find("certified") == std::string::npos);
}

BOOST_AUTO_TEST_CASE(only_what_was_made_goes_away)
{
    const Scene scene;
    // Every name that a temporary file of such a process could have had before: they stay, and are in nobody's way.
    std::set<fs::path> folders;
    for (int file = 0; file < 4; ++file) {
        for (const char* extension : {".obj", ".json"}) {
            folders.insert(scene.folder /
                           (".o." + std::to_string(::getpid()) + "." + std::to_string(file) + extension));
        }
    }
    const auto result = runCommand({"bash", "-c",
                                    "for i in 0 1; do mkdir " + scene.at + ".o.$$.$i.obj; done; exec " + command +
                                        " make " + scene.model + " -q --resolution 16 -o " + scene.at + "o.obj"});
    BOOST_TEST(result.status == 0, result.err);
    int kept = 0;
    for (const auto& entry : fs::directory_iterator(scene.folder.path()))
        kept += entry.path().filename().string().rfind(".o.", 0) == 0;
    BOOST_TEST(kept == 2);
}

BOOST_AUTO_TEST_CASE(names_do_not_reach_the_terminal_as_they_are)
{
    const Scene scene;
    const std::string evil = scene.at + "e\nvdbcage: all is well\x1b[2J\xC2\x9B"
                                        "31m\x07.obj";
    const auto isClean = [](const std::string& text, std::ptrdiff_t lines) {
        return std::count(text.begin(), text.end(), '\n') == lines && text.find("\xC2\x9B") == std::string::npos &&
               std::all_of(text.begin(), text.end(),
                           [](char c) { return static_cast<unsigned char>(c) >= 0x20 || c == '\n'; });
    };
    const std::vector<std::vector<std::string>> bad{
        {"make", evil, "-o", scene.at + "o.obj"},
        {"make", scene.model, "-o", evil + "/o.obj"},
        {"make", scene.model, "-o", scene.at + "o.obj", "--fa\nces", "7"},
        {"make", scene.model, "-o", scene.at + "o.obj", "--faces", "\x1b[31m7"},
        {"make", scene.model, "-o", scene.at + "o.obj", "--scale-field", evil + ".vdb"},
        {"make", scene.model, "-o", scene.at + "o.obj", "\x1b[31m"},
        {"check", evil, scene.model},
        {"deform", scene.cage, evil, scene.model, "-o", scene.at + "o.obj"},
        {"render", evil, "-o", scene.at + "o.png"},
        {"ma\nke"}};
    for (std::vector<std::string> words : bad) {
        words.insert(words.begin(), command);
        const auto result = runCommand(words);
        BOOST_TEST(result.status == 1);
        BOOST_TEST(isClean(result.err, 1), result.err);
    }
    fs::copy_file(scene.cage, evil);
    const auto check = runCommand({command, "check", evil, scene.model});
    BOOST_TEST(check.status == 0);
    BOOST_TEST(isClean(check.out, 16), check.out);
    const auto make = runCommand({command, "make", scene.model, "-o", evil, "--resolution", "16"});
    BOOST_TEST(make.status == 0);
    BOOST_TEST(isClean(make.err, 1), make.err);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{command, "deform", scene.cage, scene.posed, scene.model, "-o", evil},
          {command, "bind", scene.cage, scene.model, "-o", evil + ".npy"},
          {command, "deform", scene.cage, scene.posed, scene.model, "-o", evil, "--inversions", "-q"}}) {
        const auto result = runCommand(words);
        BOOST_TEST(result.status == 0, result.err);
        BOOST_TEST(isClean(result.err + result.out, 1), result.err + result.out);
    }
}

BOOST_AUTO_TEST_CASE(names_that_cannot_be_are_refused_before_any_work)
{
    const Scene scene;
    expectRefusal(scene, {"make", "@model.obj", "-o", "@" + std::string(252, 'a') + ".obj"}, "File name too long");
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--stages", "@" + std::string(256, 'a')},
                  "File name too long");
    fs::create_symlink("loop.obj", scene.folder / "loop.obj");
    fs::create_symlink("loop.vdb", scene.folder / "loop.vdb");
    fs::create_symlink("ring", scene.folder / "ring");
    const std::string loop = "Too many levels of symbolic links";
    expectRefusal(scene, {"make", "@loop.obj", "-o", "@o.obj"}, "loop.obj: cannot be read: " + loop);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@loop.obj"}, "loop.obj: cannot be written: " + loop);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--report", "@ring/r.json"}, loop);
    expectRefusal(scene, {"make", "@model.obj", "-o", "@o.obj", "--stages", "@ring"}, loop);
    expectRefusal(scene, {"render", "@loop.vdb", "-o", "@o.png"}, loop);
    expectRefusal(scene, {"check", "@loop.obj", "@model.obj"}, loop);
}

BOOST_AUTO_TEST_CASE(file_names_with_a_dash_are_explained)
{
    const Scene scene;
    const auto in = [&](const std::string& words) {
        return runCommand({"bash", "-c", "cd " + scene.at + "; exec " + command + " " + words});
    };
    for (const std::string words :
         {"make -model.obj -o o.obj", "make model.obj -o o.obj --report -r.json", "check -cage.obj model.obj"}) {
        const auto result = in(words);
        BOOST_TEST(result.status == 1);
        BOOST_TEST(result.err.find("a file of this name is written ./-") != std::string::npos, result.err);
    }
    // A file whose name begins as a known option does.
    fs::copy_file(scene.model, scene.folder / "-ogre.obj");
    BOOST_TEST(in("make -ogre.obj -o o.obj").err.find("./-ogre.obj") != std::string::npos);
    BOOST_TEST(in("make ./-ogre.obj -o ./-o.obj --resolution 16 -q").status == 0);
    BOOST_TEST(in("render model.obj --azimuth -65 -o p.png").status == 0);
}

BOOST_AUTO_TEST_SUITE_END()
