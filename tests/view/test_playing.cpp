// The time line of the window, and what is saved of it.
#include <boost/test/unit_test.hpp>

#include <cmath>

#include <tools/view/state/cage_changes.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <view/support/app_fixture.h>

using namespace vdbcage;
using namespace vdbcage::test;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace fs = std::filesystem;

namespace {

struct Fixture : AppFixture {
    App app{context.api(), setup()};

    Fixture()
    {
        run(app, {"open " + quotedWord(files[0]), "wait", "mode pose", "wait", "select points 0 1 2 3", "move 0 0.5 0",
                  "in-betweens 11", "wait"});
    }
    std::vector<Vec3d> points() const { return cagePoints(app.session().state(), app.session().cage()); }
    std::string file(const std::string& name) const { return quotedWord((folder / name).string()); }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(playing, Fixture)

BOOST_AUTO_TEST_CASE(fields_and_buttons_do_their_lines)
{
    run(app, {"expect keys 2",
              "expect last-frame 10",
              "widget time 4",
              "expect time 4",
              "expect key none",
              "widget key press",
              "expect keys 3",
              "expect key unnamed",
              "widget key.name middle",
              "expect key middle",
              "key left",
              "expect time 3",
              "key up",
              "expect time 4",
              "key up",
              "expect time 10",
              "key down",
              "key down",
              "expect time 0",
              "key down",
              "expect time 0",
              "key right",
              "expect time 1",
              "key up",
              "widget key press",
              "expect keys 2",
              "key i",
              "expect keys 3",
              "key shift+i",
              "expect keys 2",
              "widget rate 12",
              "expect messages 0",
              "widget time -1",
              "expect messages 1"});
    BOOST_TEST(app.session().state().view.framesPerSecond == 12);
}

BOOST_AUTO_TEST_CASE(what_is_typed_is_taken_over_by_tab_and_by_a_click_elsewhere)
{
    run(app, {"time 4", "mouse move time", "mouse click", "type 10", "key tab", "expect time 10", "type 30", "key tab",
              "type first", "mouse move layer.cage", "mouse click", "expect key first", "expect messages 0"});
    BOOST_TEST(app.session().state().view.framesPerSecond == 30);
}

BOOST_AUTO_TEST_CASE(it_plays_round_and_round_at_its_rate)
{
    run(app, {"rate 10", "time 0", "key space", "expect play on"});
    BOOST_TEST(app.isAnimated());
    const std::vector<Vec3d> first = points();
    run(app, {"tick 0.25", "expect time 2", "tick 0.05", "expect time 3", "tick 0.7", "expect time 10", "tick 0.1",
              "expect time 0"});
    BOOST_TEST(points() == first, boost::test_tools::per_element());
    run(app, {"tick 1.1", "expect time 0", "tick 0.5", "expect time 5"});
    BOOST_TEST(points() != first);
    run(app, {"widget play press", "expect play off", "tick 1", "expect time 5", "play on", "mode shape", "tick 1",
              "expect time 5"});
    BOOST_TEST(!app.isAnimated());
    // To look is no step of work.
    run(app, {"mode pose", "undo"});
    BOOST_TEST(app.value("undo") == "move 0 0.5 0");
}

BOOST_AUTO_TEST_CASE(the_picture_follows_the_pointer_on_the_track)
{
    run(app, {"time 0", "mouse move picture 0.02 0.98"});
    const draw::Picture rest = app.picture();
    run(app, {"mouse move time-line 0.2 0.2", "mouse down", "mouse move time-line 0.45 0.2", "expect time >8",
              "mouse move time-line 0.3 0.2"});
    const int frame = app.session().state().view.frame;
    run(app, {"mouse up", "mouse move picture 0.02 0.98"});
    BOOST_TEST(!samePicture(app.picture(), rest));
    BOOST_TEST(recorded.back() == "time " + std::to_string(frame)); // one line for the drag
    run(app, {"undo-view", "expect time 0", "undo-view"});
}

BOOST_AUTO_TEST_CASE(a_key_is_moved_by_the_pointer)
{
    // The track begins 10 pixels from its left, and shows 24 frames up to 26 pixels from its right.
    const auto place = app.widget("time-line");
    BOOST_TEST_REQUIRE(place.has_value());
    const auto at = [&](int frame) {
        const double x = place->left + 10 + (place->width - 36) * frame / 24.0;
        return "mouse at " + std::to_string(x) + ' ' + std::to_string(place->top + place->height - 8);
    };
    run(app, {"time 3", at(10), "mouse down", at(15), at(14), "expect last-frame 10", "mouse up",
              "expect last-frame 14", "expect keys 2", "expect time 14", "undo", "expect last-frame 10"});
    // A click on a key goes there.
    run(app, {"time 3", at(10), "mouse click", "expect time 10", "expect last-frame 10"});
    // Onto another key it does not go.
    run(app, {at(10), "mouse down", at(0), "mouse up", "expect messages 1", "expect keys 2"});
}

BOOST_AUTO_TEST_CASE(every_frame_is_saved_and_opened_again)
{
    std::vector<std::vector<Vec3d>> frames;
    for (int frame = 0; frame <= 10; ++frame) {
        runLine(app, "time " + std::to_string(frame));
        frames.push_back(points());
    }
    run(app, {"time 4", "save-posed-cages " + file("c.obj"), "save-posed-models " + file("m.%02d.ply"),
              "save-posed-cage " + file("four.obj"), "save-posed-model " + file("four.ply")});
    BOOST_TEST(folder.entries() == 3u + 11 + 11 + 2);
    for (int frame = 0; frame <= 10; ++frame) {
        char name[32];
        std::snprintf(name, sizeof name, "c.%04d.obj", frame);
        const std::size_t i = static_cast<std::size_t>(frame);
        BOOST_TEST(readMesh(folder / name).points == frames[i], boost::test_tools::per_element());
    }
    BOOST_TEST(readText(folder / "m.04.ply") == readText(folder / "four.ply"));
    BOOST_TEST(readText(folder / "c.0004.obj") == readText(folder / "four.obj"));
    BOOST_TEST(readText(folder / "m.03.ply") != readText(folder / "m.04.ply"));
    run(app, {"clear-poses", "open-poses " + file("c.0007.obj"), "expect keys 11", "expect last-frame 10"});
    for (int frame = 0; frame <= 10; ++frame) {
        runLine(app, "time " + std::to_string(frame));
        BOOST_TEST(points() == frames[static_cast<std::size_t>(frame)], boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(what_is_written_by_hand_is_written_while_all_else_goes_on)
{
    app.attempt(SavePosedModels{(folder / "m.%04d.obj").string()});
    run(app, {"time 3", "look top"});
    while (app.value("note") != "saved m.%04d.obj") app.update();
    BOOST_TEST(fs::exists(folder / "m.0010.obj"));
    app.attempt(SavePosedModels{(folder / "no/m.%04d.obj").string()});
    while (app.value("messages") == "0") app.update();
    BOOST_TEST(app.messages().front().find("no/m.0000.obj") != std::string::npos, app.messages().front());
    BOOST_CHECK_THROW(runLine(app, "save-posed-models " + file("m.%04d.xyz")), Error);
    BOOST_CHECK_THROW(runLine(app, "save-weights " + file("w.obj")), Error);
    run(app, {"save-weights " + file("w.npy"), "expect note \"saved w.npy\""});
}

BOOST_AUTO_TEST_CASE(colours_are_saved_with_the_posed_model)
{
    BOOST_CHECK_THROW(runLine(app, "save-colours " + file("a.ply")), Error); // it has none
    run(app, {"time 10", "wait", "model-colours influence", "save-colours " + file("a.ply"),
              "save-posed-model " + file("b.ply")});
    const Mesh coloured = readMesh(folder / "a.ply"), posed = readMesh(folder / "b.ply");
    BOOST_TEST(coloured.points == posed.points, boost::test_tools::per_element());
    BOOST_TEST(readText(folder / "a.ply").find("property uchar red") != std::string::npos);
    BOOST_CHECK_THROW(runLine(app, "save-colours " + file("a.obj")), Error);
    run(app, {"model-colours stretch", "save-colours " + file("c.ply")});
    BOOST_TEST(readText(folder / "a.ply") != readText(folder / "c.ply"));
}

BOOST_AUTO_TEST_CASE(two_families_are_seen_side_by_side)
{
    app.resize(1280, 1100); // no panel is scrolled
    run(app, {"time 10", "widget compare green", "wait", "mouse move picture 0.02 0.98"});
    const draw::Picture green = app.picture();
    runLine(app, "compare off");
    const draw::Picture one = app.picture();
    BOOST_TEST(!samePicture(green, one));
    run(app, {"compare mvc", "wait", "key 3", "select faces"});
    BOOST_TEST(!samePicture(app.picture(), green));
    // A click on the right does what the same click on the left does.
    int hits = 0;
    for (const double x : {0.3, 0.4, 0.5, 0.6}) {
        const auto selectedBy = [&](double at) {
            run(app, {"select faces", "mouse move picture " + std::to_string(at) + " 0.5", "mouse click"});
            return app.session().state().view.selection;
        };
        const edit::Selection left = selectedBy(x / 2), right = selectedBy(0.5 + x / 2);
        BOOST_TEST((left == right));
        hits += left.ids.empty() ? 0 : 1;
    }
    BOOST_TEST(hits > 1);
    run(app, {"compare off", "select points 0 1 2 3", "mouse move picture 0.02 0.98"});
    BOOST_TEST(samePicture(app.picture(), one));
    run(app, {"compare mlc", "mode shape", "wait", "mode pose", "wait", "expect messages 0"});
}

BOOST_AUTO_TEST_CASE(a_pose_is_checked_when_it_stands_still)
{
    run(app, {"time 0", "wait", "expect pose-valid none", "time 10", "wait", "expect pose-valid yes",
              "expect inverted none", "widget model-colours.inverted press", "wait", "expect inverted >=0",
              "move 0 -20 0", "wait", "expect pose-valid no", "expect inverted >0"});
}

BOOST_AUTO_TEST_CASE(a_window_of_any_size_has_its_time_line)
{
    for (const int width : {1, 300, 660, 690, 720, 800, 3000}) {
        app.resize(width, 500);
        for (const char* const frame : {"0", "10", "99999"}) {
            runLine(app, std::string("time ") + frame);
            BOOST_TEST(app.picture().width == width);
        }
    }
}

BOOST_AUTO_TEST_CASE(a_click_on_a_long_track_goes_where_it_is_seen)
{
    run(app, {"time 500", "mouse move time-line 0.5 0.2", "mouse click"});
    const int frame = app.session().state().view.frame;
    BOOST_TEST((frame > 200 && frame < 300), frame);
}

BOOST_AUTO_TEST_CASE(of_many_keys_the_one_that_is_pressed_is_taken)
{
    for (int frame = 0; frame <= 200; ++frame) runLine(app, "set-key " + std::to_string(frame));
    const auto place = app.widget("time-line");
    BOOST_TEST_REQUIRE(place.has_value());
    for (const int frame : {0, 50, 51, 199}) {
        const double x = place->left + 10 + (place->width - 36) * frame / 200.0;
        const std::string y = std::to_string(place->top + place->height - 8);
        run(app, {"mouse at " + std::to_string(x) + ' ' + y, "mouse click", "expect messages 0"});
        BOOST_TEST(std::abs(app.session().state().view.frame - frame) <= 1);
        BOOST_TEST(app.session().state().document.poses.keys().size() == 201u);
    }
}

BOOST_AUTO_TEST_CASE(what_cannot_play_does_not_begin_later)
{
    run(app, {"clear-poses", "key space", "expect play off", "in-betweens 5", "expect play off", "mode shape",
              "key space", "expect play off", "mode pose", "key space", "expect play on"});
    // While something is moved its frame is seen.
    run(app,
        {"time 0", "key g", "key x", "key 1", "tick 1", "expect time 0", "key enter", "tick 0.05", "expect time 1"});
    BOOST_CHECK_THROW(runLine(app, "tick -1"), InputError);
}

BOOST_AUTO_TEST_CASE(frames_that_are_there_are_not_written_over_without_a_question)
{
    writeText(folder / "c.0003.obj", "old");
    run(app, {"browse save-posed-cages", "widget browser.name " + file("c.%04d.obj"), "wait"});
    BOOST_TEST(readText(folder / "c.0003.obj") == "old");
    run(app, {"widget browser.yes press", "wait"});
    BOOST_TEST(readText(folder / "c.0003.obj") != "old");
    BOOST_TEST(fs::exists(folder / "c.0010.obj"));
}

BOOST_AUTO_TEST_CASE(a_button_is_recorded_as_a_line_that_does_it)
{
    run(app, {"time 7", "key i"});
    BOOST_TEST(recorded.back() == "set-key 7");
    run(app, {"undo", "expect key none", recorded.back(), "expect key unnamed"});
}

BOOST_AUTO_TEST_SUITE_END()
