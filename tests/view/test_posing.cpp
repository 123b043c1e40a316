// Posing and editing in the window, without one.
#include <boost/test/unit_test.hpp>

#include <random>
#include <thread>

#include <support/reordered.h>
#include <tools/view/state/cage_changes.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/number_text.h>
#include <view/support/app_fixture.h>

using namespace vdbcage;
using namespace vdbcage::test;
using namespace vdbcage::view;
using openvdb::Vec3d;

namespace fs = std::filesystem;

namespace {

struct Fixture : AppFixture {
    App app{context.api(), setup()};

    Fixture() { run(app, {"open " + quotedWord(files[0]), "wait", "mode pose", "wait", "key 1"}); }
    std::vector<Vec3d> points() const { return cagePoints(app.session().state(), app.session().cage()); }
    /// The last line does what was done, which is undone.
    void checkLine(const std::string& tool, const std::vector<Vec3d>& before)
    {
        const std::vector<Vec3d> dragged = points();
        BOOST_TEST_CONTEXT(recorded.back())
        {
            BOOST_TEST(dragged != before);
            BOOST_TEST((recorded.back().rfind(tool, 0) == 0));
            runLine(app, "undo");
            BOOST_TEST(points() == before, boost::test_tools::per_element());
            runLine(app, recorded.back());
            BOOST_TEST(points() == dragged, boost::test_tools::per_element());
            runLine(app, "undo");
        }
    }
    /// Selects the points in a part of the picture, by a box.
    void selectBox(double x0, double y0, double x1, double y1)
    {
        const auto at = [](double x, double y) {
            return "mouse move picture " + std::to_string(x) + ' ' + std::to_string(y);
        };
        run(app, {"key b", at(x0, y0), "mouse down", at(x1, y1), "mouse up"});
    }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(posing, Fixture)

BOOST_AUTO_TEST_CASE(typed_numbers_are_those_of_the_command)
{
    struct Case {
        std::vector<std::string> keys;
        std::string line;
    };
    selectBox(0, 0, 1, 0.4);
    BOOST_TEST(std::stoi(app.value("selected")) > 3);
    const auto frame = selectionFrame(app.session().state(), app.session().cage(), {});
    BOOST_TEST_REQUIRE(frame.has_value());
    const std::string pivot = toText(RotateSelected{{0, 0, 1}, 30, frame->origin}).substr(16);
    for (const Case& c :
         {Case{{"key g", "key x", "key 0", "key period", "key 2", "key 5", "key enter"}, "move 0.25 0 0"},
          Case{{"key g", "key shift+z", "key 1", "key tab", "key minus", "key 2", "key enter"}, "move 1 -2 0"},
          Case{{"key r", "key z", "key 3", "key 0", "key enter"}, "rotate 0 0 1 30 " + pivot},
          Case{{"key s", "key 2", "key enter"}, "scale 2 2 2 " + pivot},
          Case{{"key s", "key y", "key period", "key 5", "key enter"}, "scale 1 0.5 1 " + pivot}}) {
        const std::vector<Vec3d> before = points();
        run(app, c.keys);
        BOOST_TEST(app.value("messages") == "0");
        BOOST_TEST(recorded.back() == c.line);
        const std::vector<Vec3d> typed = points();
        BOOST_TEST(typed != before);
        run(app, {"undo", c.line});
        BOOST_TEST(points() == typed, boost::test_tools::per_element());
        runLine(app, "undo");
        BOOST_TEST(points() == before, boost::test_tools::per_element());
    }
}

BOOST_AUTO_TEST_CASE(what_a_drag_does_is_what_its_line_does)
{
    for (const char* tool : {"move", "rotate", "scale"}) {
        for (const char* orientation : {"world", "local", "normal", "view"}) {
            run(app, {std::string("tool ") + tool, std::string("orientation ") + orientation});
            selectBox(0.3, 0, 1, 0.6);
            const std::vector<Vec3d> before = points();
            for (const char* handle : {"x", "y", "z", "plane-x", "screen"}) {
                if (!app.widget(std::string("handle.") + handle)) continue; // it is seen from its end
                run(app, {std::string("mouse move handle.") + handle, "mouse down", "mouse by 20 -9", "mouse by 11 5",
                          "mouse up"});
                checkLine(tool, before);
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(what_is_turned_and_scaled_turns_about_the_pivot)
{
    selectBox(0.3, 0, 1, 0.6);
    const auto mean = selectionFrame(app.session().state(), app.session().cage(), {})->mean;
    for (const char* pivot : {"mean", "box", "origin", "point", "1 2 -3"}) {
        BOOST_TEST_CONTEXT(pivot)
        {
            if (std::string(pivot) == "1 2 -3") {
                runLine(app, "pivot 1 2 -3");
            } else {
                run(app, {"pivot mean", std::string("widget pivot ") + pivot}); // by the list of the bar
            }
            const Vec3d at = selectionFrame(app.session().state(), app.session().cage(), {})->origin;
            const std::vector<Vec3d> before = points();
            const auto selected = selectedPoints(*app.session().cage()->rest(), app.session().state().view.selection);
            run(app, {"key r", "key z", "key 9", "key 0", "key enter"});
            BOOST_TEST(recorded.back() == toText(RotateSelected{{0, 0, 1}, 90, at}));
            for (const openvdb::Index32 i : selected) {
                const Vec3d d = before[i] - at;
                BOOST_TEST((points()[i] - at - Vec3d(-d.y(), d.x(), d.z())).length() < 1e-12);
            }
            run(app, {"undo", "key s", "key 2", "key enter"});
            for (const openvdb::Index32 i : selected) {
                BOOST_TEST((points()[i] - at - 2 * (before[i] - at)).length() < 1e-12);
            }
            runLine(app, "undo");
        }
    }
    run(app, {"pivot mean", "widget pivot point"});
    BOOST_CHECK((app.session().state().view.pivot == Pivot{Pivot::Kind::point, mean}));
    run(app,
        {"undo-view", "expect pivot mean", "widget pivot box", "expect pivot box", "undo-view", "expect pivot mean"});
}

BOOST_AUTO_TEST_CASE(handles_stand_at_the_pivot_and_what_is_moved_freely_stays_under_the_pointer)
{
    selectBox(0, 0, 1, 0.4);
    const auto mean = selectionFrame(app.session().state(), app.session().cage(), {})->mean;
    const auto place = [&] {
        const auto handle = app.widget("handle.screen");
        BOOST_TEST_REQUIRE(handle.has_value());
        return std::make_pair(handle->left, handle->top);
    };
    run(app, {"tool move", "mouse move picture 0.01 0.99"});
    const auto atMean = place();
    run(app, {"pivot origin"});
    BOOST_TEST((place() != atMean));
    run(app, {toText(SetPivot{{Pivot::Kind::point, mean}})});
    BOOST_TEST((place() == atMean));
    std::vector<std::string> moves;
    for (const char* pivot : {"mean", "0.3 0.2 -8"}) {
        run(app, {std::string("pivot ") + pivot, "mouse move picture 0.4 0.4", "key g", "mouse by 30 20", "key enter"});
        moves.push_back(recorded.back());
        runLine(app, "undo");
    }
    BOOST_TEST(moves[0].rfind("move ", 0) == 0u);
    BOOST_TEST(moves[0] == moves[1]);
}

BOOST_AUTO_TEST_CASE(a_pivot_can_be_anywhere)
{
    selectBox(0, 0, 1, 0.4);
    const std::vector<Vec3d> before = points();
    for (const char* projection : {"perspective", "orthographic"}) {
        runLine(app, std::string("projection ") + projection);
        for (const char* pivot : {"1e300 0 0", "0 -1e154 1e154", "1e20 1e20 1e20", "0 0 1e9", "0 0 -1e9"}) {
            run(app,
                {std::string("pivot ") + pivot, "tool move", "tool rotate", "tool scale", "look front", "look top"});
            for (const char* key : {"g", "r", "s"}) {
                run(app, {"mouse move picture 0.4 0.4", std::string("key ") + key, "mouse by 30 20", "mouse by -7 5",
                          "key escape", "expect messages 0"});
            }
            BOOST_TEST(points() == before, boost::test_tools::per_element());
            // It is drawn, and then nothing changes any more.
            while (app.needsFrame()) app.drawFrame();
            app.update();
            BOOST_TEST(!app.needsFrame());
        }
    }
}

BOOST_AUTO_TEST_CASE(a_coordinate_that_is_typed_is_where_what_is_selected_goes)
{
    BOOST_TEST(!app.widget("selected.x"));
    selectBox(0, 0, 1, 0.4);
    runLine(app, "pivot origin"); // the fields are about the mean all the same
    const auto mean = [&] { return selectionFrame(app.session().state(), app.session().cage(), {})->mean; };
    for (const char* axis : {"x", "y", "z"}) {
        const int k = axis[0] - 'x';
        for (const double to : {0.3, -1.0 / 3, 1e-7, 0.0}) {
            const Vec3d before = mean();
            Vec3d by(0);
            by[k] = to - before[k];
            run(app, {std::string("widget selected.") + axis + ' ' + detail::numberText(to), "expect messages 0"});
            BOOST_TEST(recorded.back() == toText(MoveSelected{by}));
            for (int j = 0; j < 3; ++j) BOOST_TEST(std::abs(mean()[j] - (j == k ? to : before[j])) < 1e-14);
            BOOST_TEST(std::abs(std::stod(app.value(std::string("selected.") + axis)) - to) < 1e-14);
        }
    }
    run(app, {"key alt+a", "expect selected.x none"});
    BOOST_TEST(!app.widget("selected.x"));
}

BOOST_AUTO_TEST_CASE(a_field_that_is_typed_into_keeps_its_text_and_nonsense_is_a_message)
{
    selectBox(0, 0, 1, 0.4);
    run(app, {"move 0.123456789 0 0"});
    const std::vector<Vec3d> before = points();
    const std::size_t lines = recorded.size();
    // What is shown is rounded; to enter it as it stands changes nothing.
    run(app, {"mouse move selected.x", "mouse click", "key enter", "expect messages 0"});
    BOOST_TEST(recorded.size() == lines);
    for (const char* nonsense : {"abc", "", "1e", "nan", "1 2", "\"\""}) {
        run(app, {"mouse move selected.x", "mouse click", "key control+a", "key delete", "type " + quotedWord(nonsense),
                  "key enter", "expect messages 1"});
        BOOST_TEST(app.value("message").find("is not allowed; it must be a number") != std::string::npos,
                   app.value("message"));
        run(app, {"key enter", "expect messages 0"});
    }
    BOOST_TEST(points() == before, boost::test_tools::per_element());
    // Keys are text there, in each map, and what moves meanwhile does not change the field.
    for (const char* map : {"keys blender", "keys maya"}) {
        run(app,
            {map, "mouse move selected.x", "mouse click", "key control+a", "key w", "key g", "type 0.", "move 0 1 0",
             "expect tool select", "type 25", "key enter", "expect messages 0", "expect tool select"});
        BOOST_TEST(std::abs(selectionFrame(app.session().state(), app.session().cage(), {})->mean.x() - 0.25) < 1e-14);
        run(app, {"undo", "undo"});
        BOOST_TEST(points() == before, boost::test_tools::per_element());
    }
    // Another place that is clicked takes it over, Escape does not.
    run(app, {"mouse move selected.y", "mouse click", "type 7", "key escape"});
    BOOST_TEST(points() == before, boost::test_tools::per_element());
    run(app, {"mouse move selected.y", "mouse click", "type 7", "mouse move picture 0.01 0.01", "mouse down"});
    BOOST_TEST(std::abs(selectionFrame(app.session().state(), app.session().cage(), {})->mean.y() - 7) < 1e-13);
    runLine(app, "mouse up");
}

BOOST_AUTO_TEST_CASE(escape_gives_up_and_undo_gives_the_first_picture)
{
    selectBox(0, 0, 1, 0.4);
    runLine(app, "mouse move picture 0.01 0.99");
    const draw::Picture first = app.picture();
    const std::string undo = app.value("undo");
    run(app, {"key g", "mouse move picture 0.2 0.2", "key escape", "mouse move picture 0.01 0.99"});
    BOOST_TEST(app.value("undo") == undo);
    BOOST_TEST(samePicture(app.picture(), first));
    run(app, {"key g", "mouse move picture 0.2 0.2", "mouse click", "wait", "mouse move picture 0.01 0.99"});
    BOOST_TEST(!samePicture(app.picture(), first));
    run(app, {"undo", "wait"});
    BOOST_TEST(samePicture(app.picture(), first));
}

BOOST_AUTO_TEST_CASE(keys_select)
{
    const int count = static_cast<int>(app.session().cage()->rest()->points.size());
    run(app, {"key a", "expect selected " + std::to_string(count), "key control+i", "expect selected 0", "key a",
              "key alt+a", "expect selected 0", "see-through on"});
    selectBox(0, 0, 1, 0.3);
    const int few = std::stoi(app.value("selected"));
    BOOST_TEST((few > 0 && few < count));
    run(app, {"key control+up", "expect selected >" + std::to_string(few), "key control+down",
              "expect selected " + std::to_string(few), "key l", "expect selected " + std::to_string(count), "key 3",
              "expect select-kind faces", "expect selected >1", "key 2", "expect select-kind edges", "key alt+a",
              "key tab", "expect mode shape", "key tab", "expect mode pose"});
}

BOOST_AUTO_TEST_CASE(boxes_and_lassos_add_and_take_out)
{
    const Modifiers control{false, true, false}, withShift{true, true, false}, withAlt{false, true, true};
    const auto band = [&](Button button, const std::vector<Pixel>& places, const Modifiers& how) {
        const Rectangle picture = app.picturePlace();
        const auto moveTo = [&](const Pixel& at) {
            app.handle({PointerMoved{picture.left + at[0] * picture.width, picture.top + at[1] * picture.height}, how});
        };
        moveTo(places[0]);
        app.handle({ButtonDown{button}, how});
        for (const Pixel& place : places) moveTo(place);
        app.handle({ButtonUp{button}, how});
        return std::stoi(app.value("selected"));
    };
    run(app, {"see-through on", "frame all"});
    const int all = static_cast<int>(app.session().cage()->rest()->points.size());
    // They overlap in the middle, where there are points too.
    const std::vector<Pixel> leftBox{{0, 0}, {0.53, 1}}, rightBox{{0.47, 0}, {1, 1}};
    const std::vector<Pixel> leftLasso{{0, 0}, {0.53, 0}, {0.53, 1}, {0, 1}},
        rightLasso{{0.47, 0}, {1, 0}, {1, 1}, {0.47, 1}};
    for (const bool isLasso : {false, true}) {
        const Button button = isLasso ? Button::right : Button::left;
        const auto& left = isLasso ? leftLasso : leftBox;
        const auto& right = isLasso ? rightLasso : rightBox;
        const int few = band(button, left, control);
        BOOST_TEST((few > 0 && few < all));
        BOOST_TEST(band(button, right, withShift) == all);
        BOOST_TEST(band(button, left, withAlt) == all - few);
        BOOST_TEST(band(button, left, control) == few);
    }
}

BOOST_AUTO_TEST_CASE(without_a_selection_a_grab_says_so)
{
    run(app, {"key g", "expect messages 1", "key escape", "expect messages 0"});
}

BOOST_AUTO_TEST_CASE(the_panel_says_why_a_pose_is_not_followed)
{
    const std::string outside = (folder / "outside.obj").string();
    writeMesh(sphere({10, 0, 0}, 1, 6), outside); // the ball is at the origin
    run(app, {"open " + quotedWord(outside), "coordinates mvc", "wait", "select points 0", "move 0 0 1", "wait",
              "expect bound yes"});
    BOOST_TEST(!app.widget("error.pose"));
    run(app, {"coordinates green", "wait", "expect bound no"});
    BOOST_TEST_REQUIRE(app.widget("error.pose").has_value());
    BOOST_TEST(app.widget("error.pose")->height > 0);
    run(app, {"coordinates mvc", "wait", "expect bound yes"});
    BOOST_TEST(!app.widget("error.pose"));
}

BOOST_AUTO_TEST_CASE(a_posed_cage_in_another_order_is_noted)
{
    std::mt19937 random(1);
    const Mesh rest = lopsided(sphere({0, 0, 0}, 2, 5));
    const std::string cage = (folder / "rest.obj").string(), posed = (folder / "posed.obj").string();
    writeMesh(rest, cage);
    writeMesh(reordered(rest, random), posed);
    App real(context.api(), setup(false));
    run(real, {"open " + quotedWord(files[0]), "open-cage " + quotedWord(cage), "mode pose", "wait",
               "open-pose " + quotedWord(posed), "expect messages 0",
               "expect note \"posed.obj: the points are in another order than the cage's; matched by the faces\"",
               "expect posed no"}); // its points are where they were
}

BOOST_AUTO_TEST_CASE(a_pose_stays_with_another_cage_and_a_scene_keeps_it)
{
    selectBox(0, 0, 1, 0.4);
    run(app, {"move 0.5 0 0", "coordinates green", "wait", "expect bound yes"});
    const fs::path scene = folder / "posed.json", again = folder / "again.json";
    run(app, {"save-scene " + quotedWord(scene.string()), "mouse move picture 0.01 0.99"});
    const draw::Picture posed = app.picture();
    App other(context.api(), setup());
    run(other, {"open-scene " + quotedWord(scene.string()), "wait", "mouse move picture 0.01 0.99"});
    BOOST_TEST(cagePoints(other.session().state(), other.session().cage()) == points(),
               boost::test_tools::per_element());
    other.attempt(SaveScene{again.string()});
    for (const char* ending : {".cage.obj", ".rest.obj", ".pose.0000.obj"}) {
        const Mesh a = readMesh(fs::path(scene).replace_extension(ending));
        BOOST_TEST(sameMesh(a, readMesh(fs::path(again).replace_extension(ending))));
    }
    run(other, {"set faces 500", "wait", "expect posed yes"}); // the ball is the same
    BOOST_TEST(cagePoints(other.session().state(), other.session().cage()) == points(),
               boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(a_cage_that_is_edited_is_seen_and_moved_at_once)
{
    run(app, {"mode shape", "key 2"});
    selectBox(0, 0, 1, 0.3);
    run(app, {"move 0 0.01 0", "move 0 0.01 0"});
    BOOST_TEST(app.session().state().document.cage->path.empty());
    const Mesh& edited = app.session().state().document.cage->mesh;
    BOOST_TEST(app.session().cage()->rest()->points == edited.points, boost::test_tools::per_element());
    run(app, {"wait", "expect standing current", "undo", "undo", "wait", "expect opened-cage none"});
}

BOOST_AUTO_TEST_SUITE_END()

BOOST_FIXTURE_TEST_SUITE(endless_binding, AppFixture)

BOOST_AUTO_TEST_CASE(everything_else_answers)
{
    AppSetup with = setup();
    with.binding = [](const BindOrder& order, Interrupter& interrupter, const auto& publish) -> BoundModelPtr {
        publish(boundCoarsely(order, &interrupter));
        for (;;) {
            throwIfInterrupted(&interrupter, 1);
            std::this_thread::yield();
        }
    };
    App app(context.api(), std::move(with));
    run(app, {"open " + quotedWord(files[0]), "wait", "mode pose", "key 1", "key a", "key 1"});
    while (app.value("bound") != "coarsely") app.update();
    const draw::Picture rest = app.picture();
    run(app, {"move 0.1 0 0", "layer cage off", "undo-view", "set faces 300", "undo", "key 3", "key 1", "look top",
              "undo-view", "expect posed yes", "expect messages 0"});
    BOOST_TEST(!samePicture(app.picture(), rest)); // the stand-in has moved
    run(app, {"undo", "expect posed no", "key escape"});
    app.waitUntilSettled(); // it was cancelled
}

BOOST_AUTO_TEST_SUITE_END()
