#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <random>

#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/view/files/scene.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <view/support/orders.h>
#include <view/support/random_command.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace fs = std::filesystem;

namespace {

struct Fixture {
    test::TemporaryFolder folder;
    std::vector<std::string> files;

    Fixture()
    {
        for (int i = 1; i <= 3; ++i) {
            files.push_back((folder / ("box " + std::to_string(i) + ".obj")).string());
            writeMesh(test::box({0, 0, 0}, openvdb::Vec3d(i)), files.back());
        }
    }

    State randomState(unsigned seed) const
    {
        std::mt19937 random(seed);
        State state = applied({}, OpenModel{files[0]});
        for (int i = 0; i < 40; ++i) state = applied(state, test::randomCommand(random, files));
        return state;
    }
};

/// Equal, where files that were read twice are the same.
void checkSame(const State& a, const State& b)
{
    BOOST_CHECK(a.view == b.view);
    BOOST_TEST((optionValues(a.document.options) == optionValues(b.document.options)));
    BOOST_TEST(a.document.model->path == b.document.model->path);
    BOOST_TEST(test::sameMesh(a.document.model->mesh, b.document.model->mesh));
    BOOST_TEST_REQUIRE((a.document.cage == nullptr) == (b.document.cage == nullptr));
    if (a.document.cage) BOOST_TEST(a.document.cage->path == b.document.cage->path);
    BOOST_TEST((a.document.elasticity == b.document.elasticity));
}

} // namespace

BOOST_FIXTURE_TEST_SUITE(scene, Fixture)

BOOST_AUTO_TEST_CASE(saved_opened_and_saved_again_it_is_the_same)
{
    for (unsigned seed = 0; seed < 100; ++seed) {
        const State state = randomState(seed);
        CageResult cage;
        cage.cage = test::sphere({0.1, 0.2, 0.3}, 1 / 3.0, 6);
        const fs::path first = folder / "a scene.json";
        saveScene(state, seed % 3 == 0 ? nullptr : &cage, first);
        const State opened = openScene(first);
        checkSame(state, opened);
        const std::string text = test::readText(first);
        const std::string beside = test::readText(cageBeside(first));
        saveScene(opened, seed % 3 == 0 ? nullptr : &cage, first);
        BOOST_TEST(test::readText(first) == text);
        BOOST_TEST(test::readText(cageBeside(first)) == beside);
    }
    BOOST_TEST(folder.entries() == 5u);
    BOOST_TEST(test::sameMesh(readMesh(folder / "a scene.cage.obj"), test::sphere({0.1, 0.2, 0.3}, 1 / 3.0, 6)));
}

BOOST_AUTO_TEST_CASE(fits_and_locked_points_are_kept)
{
    const fs::path path = folder / "scene.json";
    State state = applied(applied({}, OpenModel{files[0]}), OpenCage{files[1]});
    state.document.locked = {1, 5};
    state = applied(state, FitCage{0.25});
    saveScene(state, nullptr, path);
    const Document opened = openScene(path).document;
    BOOST_TEST(opened.isFitted);
    BOOST_TEST(opened.tightness == 0.25);
    BOOST_TEST(opened.locked == state.document.locked, boost::test_tools::per_element());
    const std::string good = test::readText(path);
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{{"\"fit\": 0.25", "\"fit\": 2"},
                                                                                   {"\"fit\": 0.25", "\"fit\": \"x\""},
                                                                                   {"    5\n", "    8\n"},
                                                                                   {"    5\n", "    -5\n"}}) {
        std::string bad = good;
        BOOST_TEST_REQUIRE(bad.find(from) != std::string::npos, from);
        bad.replace(bad.find(from), from.size(), to);
        test::writeText(path, bad);
        BOOST_TEST_CONTEXT(to) BOOST_CHECK_THROW(openScene(path), InputError);
    }
}

BOOST_AUTO_TEST_CASE(a_folder_with_a_scene_can_be_moved)
{
    const test::TemporaryFolder other;
    saveScene(randomState(1), nullptr, folder / "scene.json");
    fs::create_directory(other / "inner");
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        fs::copy(entry.path(), other / "inner" / entry.path().filename());
    }
    BOOST_TEST(openScene(other / "inner" / "scene.json").document.model->path.parent_path() == other / "inner");
    saveScene(randomState(1), nullptr, other / "elsewhere.json");
    BOOST_TEST(openScene(other / "elsewhere.json").document.model->path.parent_path() == folder.path());
}

BOOST_AUTO_TEST_CASE(what_is_gone_or_changed_is_named)
{
    const fs::path path = folder / "scene.json";
    State state = applied({}, OpenModel{files[0]});
    state = applied(state, OpenCage{files[1]});
    saveScene(state, nullptr, path);
    const auto namesFile = [](const std::string& name) {
        return [name](const Error& error) { return std::string(error.what()).find(name) != std::string::npos; };
    };
    const std::string cage = test::readText(files[1]);
    test::writeText(files[1], cage + "# another\n");
    BOOST_CHECK_EXCEPTION(openScene(path), InputError, namesFile(files[1]));
    fs::remove(files[1]);
    BOOST_CHECK_EXCEPTION(openScene(path), Error, namesFile(files[1]));
    test::writeText(files[1], cage);
    openScene(path);
    const std::string good = test::readText(path);
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"\"vdbcage_scene\": 1", "\"vdbcage_scene\": 2"},
                                                          {"\"faces\": \"400\"", "\"faces\": \"3\""},
                                                          {"\"faces\": \"400\"", "\"faces\": 400"},
                                                          {"\"faces\": \"400\"", "\"feces\": \"400\""},
                                                          {"\"ground on\"", "\"ground in\""},
                                                          {"\"ground on\"", "\"set faces 50\""},
                                                          {"\"digest\"", "\"digits\""},
                                                          {"\"nu\": 0.0", "\"nu\": 0.5"},
                                                          {"\"nu\": 0.0", "\"mu\": 0.0"},
                                                          {"\"rotations\": \"global\"", "\"rotations\": \"both\""},
                                                          {"\"local_bulging\": 0.0", "\"local_bulging\": -1"},
                                                          {"{", "["}}) {
        std::string bad = good;
        BOOST_TEST_REQUIRE(bad.find(from) != std::string::npos);
        bad.replace(bad.find(from), from.size(), to);
        test::writeText(path, bad);
        BOOST_TEST_CONTEXT(to) BOOST_CHECK_EXCEPTION(openScene(path), Error, namesFile(path.string()));
    }
    for (const std::size_t length : {0, 1, 100}) {
        test::writeText(path, good.substr(0, length));
        BOOST_CHECK_THROW(openScene(path), Error);
    }
    BOOST_CHECK_THROW(openScene(folder / "none.json"), IoError);
}

BOOST_AUTO_TEST_CASE(scenes_of_before_have_the_default_material)
{
    const fs::path path = folder / "scene.json";
    State state = applied({}, OpenModel{files[0]});
    state.document.elasticity = {0.3, Elasticity::Rotations::local, 1, 2};
    saveScene(state, nullptr, path);
    BOOST_TEST((openScene(path).document.elasticity == state.document.elasticity));
    std::string text = test::readText(path);
    const std::size_t begin = text.find("\"elasticity\""), end = text.find("\"view\"");
    BOOST_TEST_REQUIRE((begin < end && end != std::string::npos));
    test::writeText(path, text.erase(begin, end - begin));
    BOOST_TEST((openScene(path).document.elasticity == Elasticity()));
}

BOOST_AUTO_TEST_CASE(what_cannot_be_saved_leaves_what_was_there)
{
    BOOST_CHECK_THROW(saveScene({}, nullptr, folder / "empty.json"), InputError);
    const State state = randomState(4);
    BOOST_CHECK_THROW(saveScene(state, nullptr, folder / "scene.txt"), InputError);
    test::writeText(folder / "scene.json", "old");
    fs::create_directory(folder / "scene.cage.obj"); // in the way of the cage
    State made = state;
    made.document.cage.reset();
    CageResult cage;
    cage.cage = test::box({0, 0, 0}, {1, 1, 1});
    BOOST_CHECK_THROW(saveScene(made, &cage, folder / "scene.json"), IoError);
    BOOST_TEST(test::readText(folder / "scene.json") == "old");
}

BOOST_AUTO_TEST_SUITE_END()
