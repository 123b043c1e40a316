// Files that are otherwise than their format: what the command says of them, and that nothing of them reaches the
// terminal as it is.

#include <boost/test/unit_test.hpp>

#include <algorithm>

#include <support/run_command.h>
#include <support/shapes.h>
#include <vdbcage/mesh/mesh_io.h>

using namespace vdbcage;
using test::runCommand;
using test::TemporaryFolder;

namespace {

const std::string command = VDBCAGE_COMMAND;

/// A folder with a cage and a model in it, both with a number that is written 0+e0.
struct Scene {
    Scene()
    {
        writeOdd(test::sphere({}, 20, 4), "cage.obj");
        writeOdd(test::sphere({}, 10, 4), "model.obj");
    }
    std::string at(const std::string& name) const { return folder / name; }

    TemporaryFolder folder;

private:
    void writeOdd(const Mesh& mesh, const char* name) const
    {
        writeMesh(mesh, folder / name);
        std::string text = test::readText(folder / name);
        text.replace(2, text.find(' ', 2) - 2, "0+e0");
        test::writeText(folder / name, text);
    }
};

std::string warning(const std::string& path)
{
    return "  warning: " + path +
           ": line 1: a number has the sign of its exponent before the e, like 3.1+e2, which is read as 3.1e+2\n";
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// One line, without control characters.
bool isOneCleanLine(const std::string& text)
{
    return !text.empty() && text.find('\n') == text.size() - 1 && text.find("\xC2\x9B") == std::string::npos &&
           std::all_of(text.begin(), text.end() - 1, [](char c) { return static_cast<unsigned char>(c) >= 0x20; });
}

} // namespace

BOOST_AUTO_TEST_SUITE(odd_files)

BOOST_AUTO_TEST_CASE(each_command_warns_of_odd_files)
{
    const Scene scene;
    const std::string cage = scene.at("cage.obj"), model = scene.at("model.obj");
    struct Case {
        std::vector<std::string> words;
        bool warnsOfCage;
        bool warnsAlways; ///< the command has no -v, and says all it knows
    };
    std::vector<Case> cases{
        {{"make", model, "-o", scene.at("o.obj"), "--faces", "20", "--resolution", "16", "--effort", "fast"},
         false,
         false},
        {{"bind", cage, model, "-o", scene.at("w.npy")}, true, false},
        {{"deform", cage, cage, model, "-o", scene.at("o.obj")}, true, false},
        {{"deform", cage, cage, model, "-o", scene.at("o.png"), "--compare"}, true, false},
        {{"render", model, cage, "-o", scene.at("o.png"), "--size", "40x30"}, true, false},
        {{"check", cage, model}, true, true}};
    for (Case& each : cases) {
        BOOST_TEST_CONTEXT(each.words.front())
        {
            std::vector<std::string> words{command};
            words.insert(words.end(), each.words.begin(), each.words.end());
            const auto plain = runCommand(words);
            BOOST_TEST(plain.status != 1, plain.err);
            BOOST_TEST(has(plain.err + plain.out, "warning") == each.warnsAlways, plain.err + plain.out);
            if (!each.warnsAlways) words.emplace_back("-v");
            const auto result = runCommand(words);
            BOOST_TEST(has(result.err + result.out, warning(model)), result.err + result.out);
            BOOST_TEST(has(result.err + result.out, warning(cage)) == each.warnsOfCage, result.err + result.out);
        }
    }
    if (VDBCAGE_HAS_GPL_PART) {
        const auto repaired = runCommand({command, "repair", cage, "-o", scene.at("o.obj")});
        BOOST_TEST(has(repaired.err, warning(cage)), repaired.err);
    }
}

BOOST_AUTO_TEST_CASE(names_in_warnings_do_not_reach_the_terminal_as_they_are)
{
    const Scene scene;
    const std::string evil = scene.at("e\nvdbcage: all is well\x1b[2J.obj");
    std::filesystem::copy_file(scene.at("model.obj"), evil);
    const auto rendered = runCommand({command, "render", evil, "-o", scene.at("o.png"), "--size", "40x30", "-v"});
    BOOST_TEST(rendered.status == 0);
    BOOST_TEST(isOneCleanLine(rendered.err), rendered.err);
    BOOST_TEST(has(rendered.err, "e\\nvdbcage: all is well\\x1b[2J.obj: line 1: "), rendered.err);
}

BOOST_AUTO_TEST_CASE(what_is_in_files_does_not_reach_the_terminal_as_it_is)
{
    const TemporaryFolder folder;
    writeMesh(test::sphere({}, 1, 4), folder / "cage.obj");
    const std::string evil = "\x1b[2J\x07\xC2\x9B\x7F\v";
    const std::string ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
    const std::vector<std::pair<std::string, std::string>> files{
        {"obj", evil + "\n"},
        {"obj", "v 0 " + evil + " 0\n"},
        {"obj", "v 0 0 0 " + evil + "\n"},
        {"obj", "v 0 0 0\nf 1 1 " + evil + "\n"},
        {"obj", "v 0 0 0\nf 1 1 1" + evil + "\n"},
        {"off", evil + "\n"},
        {"off", "OFF" + evil + " 3 1 0\n"},
        {"off", "OFF\n3 1 0 " + evil + "\n"},
        {"off", "OFF\n3 1 0\n" + points + "3 0 1 " + evil + "\n"},
        {"off", "OFF\n3 1 0\n" + points + "3 0 1 2\n" + evil + "\n"},
        {"ply", "ply\nformat " + evil + " 1.0\n"},
        {"ply", "ply\nformat ascii " + evil + "\n"},
        {"ply", "ply\nformat ascii 1.0\nmade by " + evil + "\nelement vertex 3\n"},
        {"ply", "ply\nformat ascii 1.0\nelement vertex 3 " + evil + "\n"},
        {"ply", "ply\nformat ascii 1.0\nelement " + evil +
                    "x 999\nproperty int a\nelement vertex 1\nproperty float x\n"
                    "property float y\nproperty float z\nend_header\n0 0\n"},
        {"ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty " + evil + " x\n"},
        {"ply", ply + points + "3 0 1 2 " + evil + "\n"},
        {"ply", ply + points + "3 0 1 2\n" + evil + "\n"},
        {"stl", "solid a\n" + evil + "\n"},
        {"stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 " + evil + "\n"},
    };
    for (const auto& [extension, content] : files) {
        const std::string path = folder / ("bad." + extension);
        test::writeText(path, content);
        const auto result = runCommand({command, "check", folder / "cage.obj", path});
        BOOST_TEST(result.status == 1, content);
        BOOST_TEST(result.out.empty());
        BOOST_TEST(isOneCleanLine(result.err), result.err);
        BOOST_TEST(has(result.err, path + ": line "), result.err);
    }
}

BOOST_AUTO_TEST_SUITE_END()
