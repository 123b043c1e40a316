// Poses at frames, from files and into scenes.
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <map>
#include <random>

#include <support/reordered.h>
#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/edit/carry.h>
#include <tools/view/files/scene.h>
#include <tools/view/posing/carrier.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/pose_files.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <view/support/orders.h>

using namespace vdbcage;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace fs = std::filesystem;

namespace {

struct Fixture {
    test::TemporaryFolder folder;
    const MeshPtr cage = std::make_shared<const Mesh>(test::box({0, 0, 0}, {1, 1, 1}));
    Session session;

    Fixture()
    {
        const fs::path model = folder / "model.obj";
        writeMesh(test::box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8}), model);
        run("open " + quotedWord(model.string()));
        session.setCage(test::posable(cage));
        run("mode pose");
        run("select points 0 1 2");
    }
    std::string run(const std::string& line)
    {
        std::string remark;
        session.execute(commandOf(wordsOf(line)), &remark);
        return remark;
    }
    const State& state() const { return session.state(); }
    const TimeLine& poses() const { return state().document.poses; }
    std::vector<Vec3d> points() const { return cagePoints(state(), session.cage()); }
    std::vector<Vec3d> at(int frame) const { return pointsAt(poses(), frame, *session.cage()); }

    /// The cage with point 0 moved, as a file.
    void writePosed(const std::string& name, const Vec3d& by) const
    {
        Mesh posed = *cage;
        posed.points[0] += by;
        writeMesh(posed, folder / name);
    }
    std::string file(const std::string& name) const { return quotedWord((folder / name).string()); }
    void checkRefused(const std::string& line, const std::string& mention)
    {
        const State before = state();
        BOOST_TEST_CONTEXT(line)
        BOOST_CHECK_EXCEPTION(run(line), Error, [&](const Error& error) {
            BOOST_TEST(std::string(error.what()).find(mention) != std::string::npos, error.what());
            return true;
        });
        BOOST_CHECK(state() == before);
    }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(time_line, Fixture)

BOOST_AUTO_TEST_CASE(any_keys_are_as_a_map_of_them, *boost::unit_test::label("property"))
{
    std::mt19937 random(5);
    const auto posed = [&](double x) {
        std::vector<Vec3d> points = cage->points;
        for (Vec3d& p : points) p.x() += x;
        return poseOf(cage, std::move(points));
    };
    for (int round = 0; round < 200; ++round) {
        TimeLine line;
        std::map<int, double> reference;
        for (int i = 0; i < 12; ++i) {
            const int frame = static_cast<int>(random() % 30);
            if (random() % 3 == 0) {
                line = line.without(frame);
                reference.erase(frame);
            } else {
                const double x = random() % 4 == 0 ? 0 : static_cast<double>(random() % 100) / 64;
                line = line.with({frame, posed(x), "k"});
                reference[frame] = x;
            }
        }
        BOOST_TEST_REQUIRE(line.keys().size() == reference.size());
        BOOST_TEST(line.isEmpty() == reference.empty());
        if (!reference.empty()) {
            BOOST_TEST(line.firstFrame() == reference.begin()->first);
            BOOST_TEST(line.finalFrame() == reference.rbegin()->first);
        }
        PosableCage carried(cage);
        for (int frame = 0; frame < 32; ++frame) {
            const auto next = reference.lower_bound(frame);
            double x = 0;
            if (next != reference.end() && (next->first == frame || next == reference.begin())) {
                x = next->second;
            } else if (next == reference.end()) {
                x = reference.empty() ? 0 : reference.rbegin()->second;
            } else {
                const auto before = std::prev(next);
                x = before->second +
                    (next->second - before->second) * (frame - before->first) / (next->first - before->first);
            }
            BOOST_TEST((line.keyAt(frame) != nullptr) == (reference.count(frame) > 0));
            const std::vector<Vec3d> points = pointsAt(line, frame, carried);
            for (std::size_t i = 0; i < points.size(); ++i) {
                BOOST_TEST((points[i] - cage->points[i] - Vec3d(x, 0, 0)).length() < 1e-12);
            }
        }
        BOOST_CHECK(line == line.without(31));
        BOOST_CHECK(line != line.with({31, nullptr, ""}));
    }
}

BOOST_AUTO_TEST_CASE(keys_are_exact_and_what_is_moved_becomes_one)
{
    run("move 0.1 0 0");
    const std::vector<Vec3d> first = points();
    run("time 10");
    BOOST_TEST(points() == first, boost::test_tools::per_element());
    run("move 0 0.3 0");
    const std::vector<Vec3d> last = points();
    BOOST_TEST(poses().keys().size() == 2u);
    BOOST_TEST(at(0) == first, boost::test_tools::per_element());
    BOOST_TEST(at(10) == last, boost::test_tools::per_element());
    BOOST_TEST(at(99) == last, boost::test_tools::per_element());
    run("time 5");
    BOOST_TEST((points()[0] - 0.5 * (first[0] + last[0])).length() < 1e-15);
    run("move 0 0 1");
    BOOST_TEST(poses().keys().size() == 3u);
    session.undo();
    BOOST_TEST(poses().keys().size() == 2u);
    run("set-key 5 middle");
    BOOST_TEST(poses().keyAt(5)->name == "middle");
    run("set-key 5"); // it keeps its name
    BOOST_TEST(poses().keyAt(5)->name == "middle");
    run("move-key 5 7");
    BOOST_TEST(!poses().keyAt(5));
    BOOST_TEST(poses().keyAt(7)->name == "middle");
    checkRefused("move-key 7 10", "frame 10");
    checkRefused("move-key 6 8", "frame 6");
    checkRefused("delete-key 6", "frame 6");
    run("delete-key 7");
    run("time 0");
    run("reset-pose all");
    BOOST_TEST(poses().keys().size() == 2u); // the other stays
    BOOST_TEST(points() == cage->points, boost::test_tools::per_element());
    run("clear-poses");
    BOOST_TEST(poses().isEmpty());
    session.undo();
    BOOST_TEST(at(10) == last, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(in_betweens_go_evenly_from_rest_to_the_pose)
{
    run("time 3");
    run("move 0.5 0 0");
    const std::vector<Vec3d> pose = points();
    run("in-betweens 9");
    BOOST_TEST(at(0) == cage->points, boost::test_tools::per_element());
    BOOST_TEST(at(8) == pose, boost::test_tools::per_element());
    for (int frame = 0; frame < 9; ++frame) {
        BOOST_TEST((at(frame)[0] - cage->points[0] - Vec3d(0.5 * frame / 8, 0, 0)).length() < 1e-15);
    }
    checkRefused("in-betweens 1", "in-betweens");
}

BOOST_AUTO_TEST_CASE(a_sequence_is_opened_by_its_pattern_or_one_of_its_files)
{
    for (const int frame : {3, 10, 4}) {
        char name[32];
        std::snprintf(name, sizeof name, "w.%04d.obj", frame);
        writePosed(name, {0, 0.01 * frame, 0});
    }
    writePosed("w.9.obj", {9, 9, 9}); // of another pattern
    for (const char* const path : {"w.%04d.obj", "w.0004.obj"}) {
        run("clear-poses");
        run("open-poses " + file(path));
        BOOST_TEST_REQUIRE(poses().keys().size() == 3u);
        BOOST_TEST(poses().firstFrame() == 3);
        BOOST_TEST(poses().finalFrame() == 10);
        BOOST_TEST(poses().keyAt(4)->name == "w.0004");
        for (const int frame : {3, 4, 10}) BOOST_TEST((at(frame)[0] == Vec3d(0, 0.01 * frame, 0)));
    }
    for (int frame = 1; frame <= 12; ++frame) writePosed("u" + std::to_string(frame) + ".obj", {0.01 * frame, 0, 0});
    for (const char* const path : {"u10.obj", "u3.obj"}) { // no zeros before
        run("open-poses " + file(path));
        BOOST_TEST(poses().keys().size() == 12u);
    }
    BOOST_TEST(patternOf("/a 1/walk12.003.obj") == fs::path("/a 1/walk12.%03d.obj"));
    BOOST_TEST(patternOf("walk7.ply") == fs::path("walk%d.ply"));
    BOOST_TEST(patternOf("007") == fs::path("%03d"));
    BOOST_TEST(patternOf("walk.obj") == fs::path("walk.obj"));
    BOOST_TEST(patternOf("w.%d.obj") == fs::path("w.%d.obj"));
    checkRefused("open-poses " + file("walk.obj"), "walk.obj");
    checkRefused("open-poses " + file("none.%04d.obj"), "none.%04d.obj");
    writeMesh(test::sphere({0, 0, 0}, 1, 4), folder / "w.0005.obj");
    checkRefused("open-poses " + file("w.0004.obj"), "w.0005.obj");
    writePosed("x.1234567.obj", {1, 0, 0});
    checkRefused("open-poses " + file("x.1234567.obj"), "x.1234567.obj");
}

BOOST_AUTO_TEST_CASE(points_in_another_order_are_put_into_order)
{
    std::mt19937 random(1);
    const Mesh rest = test::lopsided(test::torus(2, 1, 8, 6));
    session.setCage(test::posable(rest));
    Mesh posed = rest;
    posed.points[3] += Vec3d(0, 0.5, 0);
    writeMesh(test::reordered(posed, random), folder / "o.0001.obj");
    writeMesh(test::withFacesShuffled(posed, random), folder / "o.0002.obj");
    const std::string said = "the points are in another order than the cage's; matched by the faces";
    BOOST_TEST(run("open-pose " + file("o.0002.obj")) == "");
    BOOST_CHECK(points() == posed.points);
    run("clear-poses");
    BOOST_TEST(run("open-pose " + file("o.0001.obj")) == "o.0001.obj: " + said);
    BOOST_CHECK(points() == posed.points);
    BOOST_TEST(run("open-poses " + file("o.0002.obj")) == "o.%04d.obj: 1 of 2 frames: " + said);
    for (const int frame : {1, 2}) BOOST_CHECK(at(frame) == posed.points);
    session.setCage(test::posable(cage));
    writeMesh(test::reordered(*cage, random), folder / "box.1.obj");
    for (const char* line : {"open-pose ", "open-poses "}) {
        checkRefused(line + file("box.1.obj"), "its points are in another order than the cage's, and its faces do not "
                                               "tell which is which");
    }
}

BOOST_AUTO_TEST_CASE(a_file_of_parameters_gives_two_poses)
{
    test::writeText(folder / "p.param", "-0.5 2\n2\n0 1 0 0.5\n7 0 -1e-1 0\n");
    run("open-poses " + file("p.param") + " 11");
    BOOST_TEST(poses().keys().size() == 2u);
    for (int frame = 0; frame <= 10; ++frame) {
        const double factor = -0.5 + 0.25 * frame;
        BOOST_TEST((at(frame)[0] - cage->points[0] - factor * Vec3d(1, 0, 0.5)).length() < 1e-14);
        BOOST_TEST((at(frame)[7] - cage->points[7] - factor * Vec3d(0, -0.1, 0)).length() < 1e-14);
        BOOST_TEST((at(frame)[1] == cage->points[1]));
    }
    run("open-poses " + file("p.param") + " 1");
    BOOST_TEST(poses().keys().size() == 1u);
    BOOST_TEST((at(0)[0] == cage->points[0] + Vec3d(2, 0, 1)));
    const std::vector<std::pair<std::string, std::string>> bad{{"", "empty"},
                                                               {" ", "the least factor"},
                                                               {"0 x 0", "'x'"},
                                                               {"0 1 -1", "-1"},
                                                               {"0 1 1.5", "1.5"},
                                                               {"0 1 9", "from 0 to 8"},
                                                               {"0 1 1 8 0 0 0", "from 0 to 7"},
                                                               {"0 1 1 0 0 0", "it ends"},
                                                               {"0 1 1 0 0 0 0 5", "'5'"},
                                                               {"0 1e300 1 0 1e300 0 0", "out of all numbers"},
                                                               {"0 1 1 0 nan 0 0", "nan"}};
    for (const auto& [text, mention] : bad) {
        test::writeText(folder / "p.param", text);
        checkRefused("open-poses " + file("p.param"), mention);
        checkRefused("open-poses " + file("p.param"), "p.param");
    }
}

BOOST_AUTO_TEST_CASE(lines_are_read_as_they_are_written)
{
    for (const char* const line :
         {"set-key 3", "set-key 3 \"\"", "set-key 4 \"a name\"", "delete-key 3", "move-key 3 4", "in-betweens 12",
          "clear-poses", "open-poses w.%04d.obj", "open-poses p.param 7", "time 0", "time 99999", "play on",
          "rate 12.5", "compare off", "compare mlc"}) {
        BOOST_TEST(toText(commandOf(wordsOf(line))) == line);
    }
    for (const char* const line : {"time -1", "time 100000", "time 1.5", "rate 0", "rate 241", "play maybe", "set-key",
                                   "in-betweens 100001", "open-poses p.param 0"}) {
        BOOST_CHECK_THROW(commandOf(wordsOf(line)), InputError);
    }
}

BOOST_AUTO_TEST_CASE(a_scene_keeps_all_of_it)
{
    run("move 0.1 0 0");
    run("time 12");
    run("move 0 0.2 0");
    run("set-key 12 \"the end\"");
    run("set-key 20 \"\"");
    // Another cage at rest.
    session.setCage(test::posable(test::box({-0.1, 0, 0}, {1, 1, 1})));
    run("time 5");
    run("move 0 0 0.25");
    run("time 30");
    run("reset-pose all");
    const fs::path scene = folder / "s.json", again = folder / "again.json";
    saveScene(state(), nullptr, scene);
    const State opened = openScene(scene);
    BOOST_TEST(opened.view.frame == 30);
    BOOST_TEST_REQUIRE(opened.document.poses.keys().size() == 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const PoseKey &a = poses().keys()[i], &b = opened.document.poses.keys()[i];
        BOOST_TEST(a.frame == b.frame);
        BOOST_TEST(a.name == b.name);
        BOOST_TEST_REQUIRE((a.pose == nullptr) == (b.pose == nullptr));
        if (!a.pose) continue;
        BOOST_CHECK(a.pose->points == b.pose->points);
        BOOST_TEST(test::sameMesh(*a.pose->rest, *b.pose->rest));
    }
    BOOST_TEST((opened.document.poses.keys()[0].pose->rest == opened.document.poses.keys()[2].pose->rest));
    saveScene(opened, nullptr, again);
    for (const char* ending : {".pose.0000.obj", ".pose.0012.obj", ".rest.obj", ".rest.1.obj"}) {
        BOOST_TEST(test::readText(fs::path(scene).replace_extension(ending)) ==
                   test::readText(fs::path(again).replace_extension(ending)));
    }
    std::mt19937 random(1);
    writeMesh(test::reordered(*cage, random), folder / "again.pose.0012.obj");
    BOOST_CHECK_THROW(openScene(again), InputError);
    // A scene of when there was one pose alone.
    std::string one = test::readText(scene);
    one.replace(one.find("\"poses\""), 7,
                "\"pose\": {\"rest\": \"s.rest.obj\", \"posed\": \"s.pose.0012.obj\"}, \"x\"");
    test::writeText(folder / "old.json", one);
    const State old = openScene(folder / "old.json");
    BOOST_TEST_REQUIRE(old.document.poses.keys().size() == 1u);
    BOOST_CHECK(old.document.poses.keyAt(0)->pose->points == poses().keyAt(12)->pose->points);
    const std::string text = test::readText(scene);
    const auto replaced = [&](const std::string& what, const std::string& with) {
        std::string changed = text;
        changed.replace(changed.find(what), what.size(), with);
        test::writeText(scene, changed);
    };
    replaced("\"frame\": 12", "\"frame\": -12");
    BOOST_CHECK_THROW(openScene(scene), InputError);
    replaced("s.pose.0012.obj", "s.gone.obj");
    BOOST_CHECK_THROW(openScene(scene), IoError);
}

BOOST_AUTO_TEST_CASE(poses_are_carried_over_on_a_thread_of_its_own)
{
    run("move 0.3 0.1 0");
    run("time 8");
    run("rotate 0 0 1 30 0 0 0");
    const MeshPtr other = std::make_shared<const Mesh>(test::sphere({0.5, 0.5, 0.5}, 0.9, 10));
    Carrier carrier([] {});
    const auto carried = [&](const MeshPtr& onto) {
        auto result = carrier.carried(onto, poses());
        for (; !result; result = carrier.carried(onto, poses())) carrier.waitForNews(1);
        BOOST_TEST(!carrier.isBusy());
        return result;
    };
    BOOST_TEST(carrier.carried(cage, poses()) != nullptr); // there is nothing to do
    const auto there = carried(other);
    for (const PoseKey& key : poses().keys()) {
        BOOST_TEST(there->has(key.pose));
        BOOST_CHECK(there->points(key.pose) == edit::carriedPoses(*cage, {key.pose->points}, *other).front());
    }
    // What is asked for last is what comes.
    BOOST_TEST(carrier.carried(std::make_shared<const Mesh>(test::sphere({0, 0, 0}, 2, 40)), poses()) == nullptr);
    BOOST_TEST(carried(other)->rest() == other);
    BOOST_TEST(carrier.error().empty());
    // Who only looks neither waits nor is refused.
    session.setCage(test::posable(other));
    run("select points 0 1 2");
    BOOST_TEST(!selectionFrame(state(), session.cage(), {}));
    session.setCage(there);
    BOOST_TEST(selectionFrame(state(), session.cage(), {}).has_value());
    // A cage that is not closed poses nothing.
    Mesh open = *cage;
    open.quads.pop_back();
    const MeshPtr rest = std::make_shared<const Mesh>(open);
    session.setCage(test::posable(rest));
    run("clear-poses");
    run("select points 0 1 2");
    run("move 0.3 0.1 0");
    const auto refused = carried(other);
    BOOST_TEST(!carrier.error().empty());
    BOOST_CHECK(refused->points(poses().keys()[0].pose) == other->points);
}

BOOST_AUTO_TEST_SUITE_END()
