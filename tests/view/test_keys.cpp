// Keys and mouse buttons as in Blender and as in Maya, and where the choice is kept.
#include <boost/test/unit_test.hpp>

#include <array>
#include <filesystem>
#include <set>

#include <tools/view/input/key_map.h>
#include <tools/view/state/words.h>
#include <view/support/app_fixture.h>

using namespace vdbcage;
using namespace vdbcage::test;
using namespace vdbcage::view;

namespace fs = std::filesystem;

namespace {

struct Fixture : AppFixture {
    App app{context.api(), setup()};

    Fixture() { run(app, {"open " + quotedWord(files[0]), "wait", "mode pose", "wait", "key 1", "see-through on"}); }
    draw::Camera camera() const { return app.session().state().view.camera; }
    int selected() { return std::stoi(app.value("selected")); }
    /// A drag between two shares of the picture; `button` with what is held.
    void drag(const std::string& button, const std::vector<Pixel>& places)
    {
        const auto at = [](const Pixel& p) {
            return "mouse move picture " + std::to_string(p[0]) + ' ' + std::to_string(p[1]);
        };
        run(app, {at(places[0]), "mouse down " + button});
        for (const Pixel& place : places) runLine(app, at(place));
        runLine(app, "mouse up " + button);
    }
    void drag(const std::string& button) { drag(button, {{0.5, 0.5}, {0.55, 0.53}, {0.6, 0.58}}); }
    /// What the drag does to the view: "turn", "pan", "zoom" or "nothing"; it is undone.
    std::string viewChange(const std::string& button)
    {
        const draw::Camera before = camera();
        drag(button);
        const draw::Camera after = camera();
        std::string change = "nothing";
        if (after.view.azimuthDegrees != before.view.azimuthDegrees) {
            change = "turn";
        } else if (after.distance != before.distance) {
            change = "zoom";
        } else if (after.target != before.target) {
            change = "pan";
        }
        runLine(app, toText(SetCamera{before}));
        return change;
    }
};

} // namespace

BOOST_FIXTURE_TEST_SUITE(keys, Fixture)

BOOST_AUTO_TEST_CASE(no_chord_is_there_twice)
{
    for (const KeyMap map : {KeyMap::blender, KeyMap::maya}) {
        std::set<std::string> chords;
        for (const Shortcut& shortcut : shortcuts(map)) {
            BOOST_TEST(chords.insert(shortcut.chord).second, shortcut.chord << " is there twice");
        }
        BOOST_TEST(chords.size() > 40u);
        std::set<std::string> drags;
        for (const DragBinding& drag : mouseMap(map).drags) {
            const std::string name = nameOf(drag.chord.modifiers) + ' ' + nameOf(drag.chord.button);
            BOOST_TEST(drags.insert(name).second, name << " is there twice");
            // None is hidden by one before it.
            BOOST_TEST((dragOf(mouseMap(map), drag.chord) == &drag), name);
        }
    }
}

BOOST_AUTO_TEST_CASE(what_has_a_key_in_one_map_has_a_key_or_a_place_in_a_menu_in_the_other)
{
    run(app, {"key control+i"}); // something is selected
    std::set<std::string> reached;
    for (const char* name : {"menu.File", "menu.Edit", "menu.View", "menu.Help"}) {
        runLine(app, std::string("widget ") + name + " press");
        for (const KeyMap map : {KeyMap::blender, KeyMap::maya}) {
            for (const Shortcut& shortcut : shortcuts(map)) {
                if (app.widget("menu." + shortcut.line)) reached.insert(shortcut.line);
            }
        }
        runLine(app, "key escape");
        BOOST_TEST(!app.widget("menu.help"));
    }
    BOOST_TEST(reached.count("grab move") == 1u);
    BOOST_TEST(reached.count("tool move") == 0u);
    constexpr std::array<std::array<KeyMap, 2>, 2> ways{
        {{KeyMap::blender, KeyMap::maya}, {KeyMap::maya, KeyMap::blender}}};
    for (const auto& [from, to] : ways) {
        std::set<std::string> lines = reached;
        for (const Shortcut& shortcut : shortcuts(to)) lines.insert(shortcut.line);
        for (const Shortcut& shortcut : shortcuts(from)) {
            BOOST_TEST(lines.count(shortcut.line) == 1u, shortcut.line << " cannot be reached");
        }
    }
}

BOOST_AUTO_TEST_CASE(buttons_turn_move_and_zoom_the_view_by_the_map)
{
    const auto check = [&](const std::vector<std::pair<std::string, std::string>>& drags) {
        for (const auto& [button, change] : drags) BOOST_TEST_CONTEXT(button) BOOST_TEST(viewChange(button) == change);
    };
    run(app, {"expect key-map blender"});
    check({{"left", "turn"},
           {"shift+left", "pan"},
           {"middle", "pan"},
           {"right", "zoom"},
           {"alt+left", "turn"},
           {"control+left", "nothing"},
           {"control+right", "nothing"}});
    run(app, {"keys maya", "expect key-map maya"});
    check({{"alt+left", "turn"},
           {"alt+middle", "pan"},
           {"alt+right", "zoom"},
           {"left", "nothing"},
           {"shift+left", "nothing"},
           {"middle", "nothing"},
           {"right", "nothing"}});
    run(app, {"keys blender"});
    check({{"left", "turn"}});
}

BOOST_AUTO_TEST_CASE(in_mayas_map_drags_are_boxes_and_lassos)
{
    run(app, {"keys maya", "frame all"});
    const int all = static_cast<int>(app.session().cage()->rest()->points.size());
    const std::vector<Pixel> left{{0, 0}, {0.53, 1}}, right{{0.47, 0}, {1, 1}};
    drag("left", left);
    const int few = selected();
    BOOST_TEST((few > 0 && few < all));
    drag("control+shift+left", right); // adds
    BOOST_TEST(selected() == all);
    drag("control+left", left); // takes out
    BOOST_TEST(selected() == all - few);
    drag("shift+left", left); // those were not selected
    BOOST_TEST(selected() == all);
    drag("shift+left", left); // and now they were
    BOOST_TEST(selected() == all - few);
    drag("right", {{0, 0}, {0.53, 0}, {0.53, 1}, {0, 1}});
    BOOST_TEST(selected() == few);
    // A view that is turned keeps what is selected, and so does a press of alt and the button alone.
    drag("alt+left");
    run(app, {"mouse move picture 0.01 0.01", "mouse click alt+left"});
    BOOST_TEST(selected() == few);
    // Escape gives a box up.
    run(app, {"mouse move picture 0 0", "mouse down", "mouse move picture 1 1", "key escape", "mouse up"});
    BOOST_TEST(selected() == few);
    run(app, {"mouse move picture 0.01 0.01", "mouse click", "expect selected 0"});
}

BOOST_AUTO_TEST_CASE(in_mayas_map_clicks_select_and_a_hand_that_shakes_is_a_click)
{
    run(app, {"keys maya",
              "key f11",
              "expect select-kind faces",
              "look front",
              "layer model off",
              "see-through off",
              "mouse move picture",
              "mouse click",
              "expect selected 1",
              "mouse click shift+left",
              "expect selected 0",
              "mouse click shift+left",
              "expect selected 1",
              "mouse click control+left",
              "expect selected 0",
              "mouse click control+shift+left",
              "mouse click control+shift+left",
              "expect selected 1",
              "select faces",
              "mouse down",
              "mouse by 1 1",
              "mouse by 0 -1",
              "mouse up",
              "expect selected 1"});
}

BOOST_AUTO_TEST_CASE(handles_are_dragged_in_mayas_map_and_alt_turns_the_view_on_them_too)
{
    run(app, {"keys maya", "key control+shift+a", "key w", "expect tool move"});
    drag("left", {{0, 0}, {1, 0.4}});
    const std::string undo = app.value("undo");
    const int before = selected();
    BOOST_TEST(before > 0);
    run(app,
        {"mouse move handle.screen", "mouse down alt+left", "mouse by 20 10", "mouse by 9 0", "mouse up alt+left"});
    BOOST_TEST(app.value("undo") == undo);
    run(app, {"mouse move handle.screen", "mouse down", "mouse by 20 10", "mouse by 9 0", "mouse up"});
    BOOST_TEST(app.value("undo").rfind("move ", 0) == 0u);
    BOOST_TEST(selected() == before);
}

BOOST_AUTO_TEST_CASE(keys_are_mayas)
{
    const std::string all = std::to_string(app.session().cage()->rest()->points.size());
    run(app, {"keys maya",
              "key e",
              "expect tool rotate",
              "key r",
              "expect tool scale",
              "key w",
              "expect tool move",
              "key q",
              "expect tool select",
              "key control+shift+a",
              "expect selected " + all,
              "key g",
              "key f9",
              "expect select-kind points",
              "key f10",
              "expect select-kind edges",
              "key f11",
              "expect select-kind faces",
              "key f9",
              "key shift+alt+d",
              "expect selected 0",
              "key f8",
              "expect mode shape",
              "key tab",
              "expect mode pose",
              "set faces 50",
              "key z",
              "expect option.faces 400"});
    run(app, {"key control+y", "expect option.faces 50", "key control+z", "key shift+z", "expect option.faces 50"});
    const double distance = camera().distance;
    run(app, {"select points 0", "key f"});
    BOOST_TEST(camera().distance < distance);
    run(app, {"key a"});
    BOOST_TEST(camera().distance > 0.9 * distance);
    run(app, {"key left-bracket"});
    BOOST_TEST(camera().distance < 0.9 * distance);
    // Free moves are in the menu, and numbers are typed as ever: w, e and r are not tools meanwhile.
    run(app, {"expect messages 0", "widget menu.Edit press", "widget \"menu.grab move\" press", "key x", "key 0",
              "key period", "key 1", "key w", "key a", "key enter", "expect tool select"});
    BOOST_TEST(recorded.back() == "move 0.1 0 0");
}

BOOST_AUTO_TEST_CASE(a_menu_chooses_the_map)
{
    run(app, {"widget menu.Help press", "mouse move menu.Keys", "mouse click", "widget \"menu.keys maya\" press",
              "expect key-map maya", "key r", "expect tool scale", "widget menu.Help press", "mouse move menu.Keys",
              "mouse click", "widget \"menu.keys blender\" press", "expect key-map blender"});
    // It is no line of a script: those are the same for every user.
    BOOST_TEST(recorded.back() == "tool scale");
}

BOOST_AUTO_TEST_CASE(help_tells_what_the_mouse_does)
{
    const auto row = [](KeyMap map, const std::string& what) {
        for (const auto& [done, does] : describeMouse(map)) {
            if (done == what) return does;
        }
        return std::string();
    };
    BOOST_TEST(row(KeyMap::blender, "left button, drag").find("turns") == 0u);
    BOOST_TEST(row(KeyMap::blender, "shift+left button, drag") == "moves the view");
    BOOST_TEST(row(KeyMap::blender, "control+right button, drag") ==
               "selects elements in a lasso; at its end alt takes out, shift adds");
    BOOST_TEST(row(KeyMap::maya, "alt+right button, drag") == "zooms");
    BOOST_TEST(row(KeyMap::maya, "left button, drag") ==
               "selects elements in a box; at its end control+shift adds, control takes out, shift inverts");
    BOOST_TEST(row(KeyMap::maya, "control+left button, click") == "takes it out");
    for (const KeyMap map : {KeyMap::blender, KeyMap::maya}) {
        BOOST_TEST(!row(map, "left button on a handle, drag").empty());
        BOOST_TEST(!row(map, "wheel").empty());
    }
    run(app, {"keys maya", "help", "expect messages 0", "widget help.close press"});
}

BOOST_AUTO_TEST_CASE(the_map_is_kept_for_the_next_window)
{
    const fs::path file = folder / "config" / "preferences";
    const auto mapOfNext = [&](const fs::path& path) {
        AppSetup with = setup();
        with.preferences = path;
        return App(context.api(), std::move(with)).value("key-map");
    };
    BOOST_TEST(mapOfNext(file) == "blender");
    BOOST_TEST(!fs::exists(file)); // who chooses nothing has none
    {
        AppSetup with = setup();
        with.preferences = file;
        App other(context.api(), std::move(with));
        run(other, {"keys maya", "expect messages 0"});
    }
    BOOST_TEST(mapOfNext(file) == "maya");
    BOOST_TEST(mapOfNext({}) == "blender");
    for (const std::string& nonsense :
         {std::string(), std::string("keys"), std::string("keys dvorak\n"), std::string("keys \"maya\n"),
          std::string("\0\xff\xfe keys", 8), std::string(1000000, 'k'), std::string("{\"keys\": \"maya\"}"),
          std::string("# keys maya"), "keys maya\n" + std::string(70000, '\n')}) {
        writeText(file, nonsense);
        BOOST_TEST_CONTEXT(nonsense.substr(0, 20)) BOOST_TEST(mapOfNext(file) == "blender");
    }
    writeText(file, "colour red\n\nkeys maya # mine\nkeys dvorak\n");
    BOOST_TEST(mapOfNext(file) == "maya");
    // A folder of its name cannot be read, nor written over; the choice holds for the window all the same.
    fs::create_directories(folder / "folder" / "inside");
    BOOST_TEST(mapOfNext(folder / "folder") == "blender");
    AppSetup with = setup();
    with.preferences = folder / "folder";
    App other(context.api(), std::move(with));
    run(other, {"keys maya", "expect key-map maya", "expect messages 0", "expect standing none"});
}

BOOST_AUTO_TEST_SUITE_END()
