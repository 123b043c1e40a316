// Every bad input gives exit status 1 and one clear line, leaves no file behind and changes none.

#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>

#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;
const std::string good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

/// Every file below the folder with its bytes, links and folders with none.
std::map<std::string, std::string> contentsOf(const TemporaryFolder& folder)
{
    std::map<std::string, std::string> contents;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
        contents[entry.path().string()] = entry.is_regular_file() ? test::readText(entry.path()) : "";
    }
    return contents;
}

/// Runs `words` and requires this exit status, one line that holds all of `mentions`, and an unchanged `folder`.
void expectRefusal(const TemporaryFolder& folder, const std::vector<std::string>& words,
                   const std::vector<std::string>& mentions, int status = 1)
{
    const auto before = contentsOf(folder);
    const auto result = runCommand(words);
    BOOST_TEST(result.status == status);
    BOOST_TEST(result.out.empty());
    BOOST_TEST(std::count(result.err.begin(), result.err.end(), '\n') == 1, result.err);
    BOOST_TEST(result.err.rfind("vdbcage: error: ", 0) == 0U, result.err);
    for (const std::string& mention : mentions) {
        BOOST_TEST(result.err.find(mention) != std::string::npos, result.err + " lacks " + mention);
    }
    BOOST_CHECK(contentsOf(folder) == before);
}

/// The user nobody, for whom permissions mean something: root may do anything.
std::vector<std::string> asNobody(std::vector<std::string> words)
{
    if (::geteuid() != 0) return words;
    std::vector<std::string> all{"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
    all.insert(all.end(), words.begin(), words.end());
    return all;
}

struct BadModel {
    const char* name;
    const char* extension;
    std::string content;
    std::string mention;
};

std::string binaryStl(std::uint32_t announced, std::size_t bytes)
{
    std::string text(80, ' ');
    text.append(reinterpret_cast<const char*>(&announced), 4);
    text.append(bytes, '\1');
    return text;
}

std::vector<BadModel> badModels()
{
    std::string junk;
    unsigned state = 1;
    for (int i = 0; i < 4000; ++i) junk += static_cast<char>((state = state * 1664525U + 1013904223U) >> 24);
    const std::string plyHead = "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
                                "property double z\nelement face 1\nproperty list uchar int vertex_indices\n"
                                "end_header\n";
    return {
        {"empty obj", "obj", "", "empty"},
        {"empty off", "off", "", ""},
        {"empty ply", "ply", "", ""},
        {"empty stl", "stl", "", ""},
        {"junk obj", "obj", junk, ""},
        {"junk off", "off", junk, ""},
        {"junk ply", "ply", junk, ""},
        {"junk stl", "stl", junk, ""},
        {"only a comment", "obj", "# nothing\n", "no face"},
        {"one vertex", "obj", "v 0 0 0\n", "no face"},
        {"vertices but no faces", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no face"},
        {"index 0", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4"},
        {"index out of range", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "4"},
        {"relative index out of range", "obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "-4"},
        {"face of words", "obj", good + "f a b c\n", "line 9"},
        {"nan", "obj", "v nan 0 0\n" + good, "nan"},
        {"inf", "obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n", "inf"},
        {"beyond doubles", "obj", "v 0 0 0\nv 1e400 0 0\nv 0 1 0\nf 1 2 3\n", "1e400"},
        {"vertex of two", "obj", "v 0 0\n" + good, "line 1"},
        {"vertex of words", "obj", "v a b c\n" + good, "line 1"},
        {"only degenerate faces", "obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\nf 1 1 2\n", "degenerate"},
        {"no counts", "off", "OFF\n", ""},
        {"too few vertices", "off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", ""},
        {"no faces at all", "off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no face"},
        {"off index out of range", "off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "3"},
        {"off negative index", "off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "-1"},
        {"off nan", "off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "nan"},
        {"a count of vertices beyond the file", "off", "OFF\n1000000000000 1 0\n0 0 0\n", ""},
        {"no end of header", "ply", "ply\nformat ascii 1.0\nelement vertex 3\n", ""},
        {"ply without coordinates", "ply",
         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float red\nelement face 0\nproperty list uchar int "
         "vertex_indices\nend_header\n1\n",
         ""},
        {"ply of an unknown format", "ply", "ply\nformat morse 1.0\nend_header\n", "morse"},
        {"ply index out of range", "ply", plyHead + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "7"},
        {"ply cut short", "ply", plyHead + "0 0 0\n1 0 0\n", ""},
        {"ply inf", "ply", plyHead + "0 0 0\ninf 0 0\n0 1 0\n3 0 1 2\n", "inf"},
        {"stl cut short", "stl", binaryStl(1000, 120), ""},
        {"stl without triangles", "stl", binaryStl(0, 0), "no face"},
        {"ascii stl cut short", "stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", ""},
        {"ascii stl of words", "stl",
         "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 x\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid\n",
         "x"},
    };
}

} // namespace

BOOST_AUTO_TEST_SUITE(bad_input)

BOOST_AUTO_TEST_CASE(bad_models)
{
    const TemporaryFolder folder;
    test::writeText(folder / "cage.obj", "precious");
    for (const BadModel& bad : badModels()) {
        BOOST_TEST_CONTEXT(bad.name)
        {
            const std::string path = folder / (std::string("model.") + bad.extension);
            test::writeText(path, bad.content);
            expectRefusal(folder, {command, "make", path, "-o", folder / "cage.obj", "--resolution", "16"},
                          {path, bad.mention});
            expectRefusal(folder, {command, "check", path, path}, {path, bad.mention});
        }
    }
}

BOOST_AUTO_TEST_CASE(models_too_large_too_small_or_too_far)
{
    const TemporaryFolder folder;
    const std::string path = folder / "model.obj";
    for (const char* text :
         {"v -1e308 0 0\nv 1e308 0 0\nv 0 1e308 0\nf 1 2 3\n", "v 0 0 0\nv 1e-300 0 0\nv 0 1e-300 0\nf 1 2 3\n",
          "v 1e15 0 0\nv 1000000000000001 0 0\nv 1e15 1 0\nf 1 2 3\n"}) {
        test::writeText(path, text);
        expectRefusal(folder, {command, "make", path, "-o", folder / "cage.obj"}, {path, "longest side"});
    }
}

BOOST_AUTO_TEST_CASE(files_cut_short_at_each_eighth)
{
    const TemporaryFolder folder;
    const Mesh mesh = test::sphere({0, 0, 0}, 1, 8);
    for (const char* extension : {"off", "ply", "stl"}) {
        const std::string path = folder / (std::string("model.") + extension);
        writeMesh(mesh, path);
        const std::string whole = test::readText(path);
        for (std::size_t eighth = 0; eighth < 8; ++eighth) {
            test::writeText(path, whole.substr(0, whole.size() * eighth / 8));
            BOOST_TEST_CONTEXT(extension << " cut at " << eighth << "/8")
            {
                expectRefusal(folder, {command, "make", path, "-o", folder / "cage.obj", "--resolution", "16"}, {path});
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(bad_paths)
{
    const TemporaryFolder folder;
    const std::string model = folder / "model.obj", cage = folder / "cage.obj";
    test::writeText(model, good);
    std::filesystem::create_directory(folder / "folder.obj");
    std::filesystem::create_hard_link(model, folder / "alias.obj");
    std::filesystem::create_symlink(model, folder / "link.obj");
    const auto make = [&](std::vector<std::string> more) {
        std::vector<std::string> words{command, "make"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    expectRefusal(folder, make({folder / "missing.obj", "-o", cage}), {"missing.obj"});
    expectRefusal(folder, make({folder / "folder.obj", "-o", cage}), {"folder.obj", "directory"});
    expectRefusal(folder, make({model, "-o", folder / "cage.xyz"}), {"cage.xyz", ".obj"});
    expectRefusal(folder, make({model, "-o", folder / "cage"}), {"cage", ".obj"});
    expectRefusal(folder, make({folder / "model.xyz", "-o", cage}), {"model.xyz", ".obj"});
    expectRefusal(folder, make({model, "-o", folder / "no/such/cage.obj"}), {"no/such", "does not exist"});
    expectRefusal(folder, make({model, "-o", folder / "folder.obj"}), {"folder.obj", "directory"});
    expectRefusal(folder, make({model, "-o", model}), {"model"});
    expectRefusal(folder, make({model, "-o", folder / "alias.obj"}), {"model"});
    expectRefusal(folder, make({model, "-o", folder / "link.obj"}), {"model"});
    expectRefusal(folder, make({model, "-o", folder / "./folder.obj/../model.obj"}), {"model"});
    expectRefusal(folder, make({model, "-o", cage, "--report", cage}), {"twice"});
    expectRefusal(folder, make({model, "-o", cage, "--report", model}), {"twice"});
    expectRefusal(folder, make({model, "-o", cage, "--report", folder / "no/report.json"}), {"does not exist"});
    expectRefusal(folder, make({model, "-o", cage, "--picture", folder / "picture.jpg"}), {".png"});
    expectRefusal(folder, make({model, "-o", cage, "--stages", model, "--resolution", "16"}), {"model.obj"});
    expectRefusal(folder, make({model, "-o", cage, "--stages", folder / "a/b", "--resolution", "16"}), {"a/b"});
    expectRefusal(folder, make({model, "-o", "/dev/full"}), {"/dev/full"});
    expectRefusal(folder, {command, "render", "-o", folder / "picture.png"}, {});
    expectRefusal(folder, {command, "render", model, "-o", folder / "picture.jpg"}, {".png"});
    const auto sheet = [&](std::vector<std::string> more) {
        std::vector<std::string> words{command, "render", "-o", folder / "sheet.png"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    expectRefusal(folder, sheet({model, "/"}), {"panel"});
    expectRefusal(folder, sheet({model, "/", "/", model}), {"panel"});
    expectRefusal(folder, sheet({model, "/", folder / "missing.obj"}), {"missing.obj"});
    expectRefusal(folder, sheet({model, "/", model, "--columns", "many"}), {"--columns", "many"});
    expectRefusal(folder, sheet({model, "/", model, "--columns", "-1"}), {"--columns", "-1"});
    expectRefusal(folder, sheet({model, "/", model, "--columns", "2", "--size", "1x1"}), {"1 x 1", "2 panels"});
    expectRefusal(folder, {command, "check", cage, model}, {"cage.obj"});
}

BOOST_AUTO_TEST_CASE(bad_arguments)
{
    const TemporaryFolder folder;
    const std::string model = folder / "model.obj", cage = folder / "cage.obj";
    test::writeText(model, good);
    for (const std::vector<std::string>& wrong :
         std::vector<std::vector<std::string>>{{"--faces", "3"},
                                               {"--faces", "many"},
                                               {"--faces=1e3"},
                                               {"--resolution", "0"},
                                               {"--resolution", "100000"},
                                               {"--close-radius", "nan"},
                                               {"--erode-radius", "0.02", "--close-radius", "0.01"},
                                               {"--element", "pyramid"},
                                               {"--mesh", "pentagons"},
                                               {"--bounding", "perhaps"},
                                               {"--voxelizer", "abacus"},
                                               {"--smooth", "-1"},
                                               {"--merge-angle", "200"}}) {
        std::vector<std::string> words{command, "make", model, "-o", cage};
        words.insert(words.end(), wrong.begin(), wrong.end());
        expectRefusal(folder, words, {"is not allowed", wrong.front().substr(0, wrong.front().find('='))});
    }
    expectRefusal(folder, {command, "make", model}, {"--output"});
    expectRefusal(folder, {command, "make", "-o", cage}, {"model"});
    expectRefusal(folder, {command, "make", model, "-o", cage, "--faces"}, {"--faces"});
    expectRefusal(folder, {command, "make", model, model, "-o", cage}, {model + ": this model is named twice"});
    expectRefusal(folder, {command, "make", model, "-o", cage, "--colour", "red"}, {"--colour"});
}

BOOST_AUTO_TEST_CASE(no_opengl)
{
    const TemporaryFolder folder;
    const std::string model = folder / "model.obj", cage = folder / "cage.obj";
    test::writeText(model, good);
    expectRefusal(folder,
                  {"env", "MESA_GL_VERSION_OVERRIDE=4.1", command, "make", model, "-o", cage, "--voxelizer", "gl"},
                  {"OpenGL", "4.5", "EGL", "OSMesa"}, 75);
}

BOOST_AUTO_TEST_CASE(permissions)
{
    const TemporaryFolder folder;
    namespace fs = std::filesystem;
    fs::permissions(folder.path(), fs::perms::all);
    // A copy that everybody can reach, wherever this was built.
    const std::string reachable = folder / "vdbcage";
    fs::copy_file(command, reachable);
    fs::permissions(reachable, fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
    const std::string model = folder / "model.obj", secret = folder / "secret.obj", fixed = folder / "fixed.obj";
    test::writeText(model, good);
    test::writeText(secret, good);
    fs::permissions(secret, fs::perms::none);
    test::writeText(fixed, "precious");
    fs::permissions(fixed, fs::perms::owner_read | fs::perms::group_read | fs::perms::others_read);
    fs::create_directory(folder / "closed");
    fs::permissions(folder / "closed",
                    fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read | fs::perms::others_exec);
    expectRefusal(folder, asNobody({reachable, "make", secret, "-o", folder / "cage.obj"}),
                  {"secret.obj", "ermission"});
    expectRefusal(folder, asNobody({reachable, "make", model, "-o", fixed}), {"fixed.obj", "ermission"});
    expectRefusal(folder, asNobody({reachable, "make", model, "-o", folder / "closed/cage.obj"}),
                  {"closed", "ermission"});
}

BOOST_AUTO_TEST_CASE(a_limit_on_the_size_of_files)
{
    const TemporaryFolder folder;
    const std::string model = folder / "model.obj";
    test::writeText(model, good);
    // A file may not grow past one block of 1024 bytes: no other machine would do, either. The model is smaller.
    const auto limited = [&](const std::string& arguments) {
        return std::vector<std::string>{
            "bash", "-c", "trap '' XFSZ; ulimit -f 1; exec " + command + " make " + model + " " + arguments};
    };
    for (const char* extension : {"obj", "off", "ply", "stl"}) {
        expectRefusal(folder, limited("--resolution 16 -q -o " + (folder / "cage.").string() + extension), {"cage."});
    }
    expectRefusal(folder,
                  limited("--resolution 16 -q --faces 12 -o " + (folder / "cage.stl").string() + " --stages " +
                          (folder / "stages").string()),
                  {"stages/"});
    expectRefusal(folder,
                  limited("--resolution 16 -q --faces 12 -o " + (folder / "cage.stl").string() + " --picture " +
                          (folder / "picture.png").string()),
                  {"picture.png"});
}

BOOST_AUTO_TEST_CASE(poor_but_good_input_gets_a_cage)
{
    const std::vector<std::pair<const char*, std::string>> models{
        {"a single triangle", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
        {"a flat sheet", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"},
        {"some bad faces", good + "f 1 1 2\nf 2 2 2\n"},
        {"a line for a face among others", good + "v 2 0 0\nv 3 0 0\nv 4 0 0\nf 5 6 7\n"},
        {"a face of two corners among others", good + "f 1 2\n"},
        {"windows line ends", "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n"}};
    for (const auto& model : models) {
        BOOST_TEST_CONTEXT(model.first)
        {
            const TemporaryFolder folder;
            const std::string path = folder / "model.obj", cage = folder / "cage.obj";
            test::writeText(path, model.second);
            const auto made = runCommand(
                {command, "make", path, "-o", cage, "--resolution", "32", "--report", folder / "report.json"});
            BOOST_TEST(made.status == 0, made.err);
            BOOST_TEST(runCommand({command, "check", cage, path}).status == 0);
        }
    }
}

BOOST_AUTO_TEST_SUITE_END()
