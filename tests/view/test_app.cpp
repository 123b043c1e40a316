// The program behind the window, without one: events and lines in, state and pictures out.
#include <boost/test/unit_test.hpp>

#include <filesystem>
#include <random>

#include <support/option_values.h>
#include <tools/view/state/words.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <view/support/app_fixture.h>
#include <view/support/random_command.h>

using namespace vdbcage;
using namespace vdbcage::test;
using namespace vdbcage::view;

namespace fs = std::filesystem;

namespace {

std::string valueOf(const CageOptions& options, const std::string& name)
{
    for (const auto& option : optionValues(options)) {
        if (option.first == name) return option.second;
    }
    return "?";
}

} // namespace

BOOST_FIXTURE_TEST_SUITE(app, AppFixture)

BOOST_AUTO_TEST_CASE(each_option_goes_through_its_widget_to_its_ends_and_back)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    CageOptions defaults;
    const auto texts = describeOptions();
    std::size_t i = 0;
    visitOptions(defaults, [&](const OptionInfo& info, const auto& /*field*/) {
        const OptionText& text = texts[i++];
        const std::string name = info.name;
        std::vector<std::string> values = otherValues(text);
        values.push_back(text.defaultValue);
        for (const std::string& value : values) {
            BOOST_TEST_CONTEXT(name << ' ' << value)
            {
                runLine(app, "widget " + name + ' ' + quotedWord(value));
                BOOST_TEST(valueOf(app.session().state().document.options, name) == value);
                BOOST_TEST(app.messages().empty());
            }
        }
        // Sliders too, whose ends are exact; and back by the button beside them.
        if (app.widget(name + ".slider")) {
            for (const double end : {0.0, 1.0}) {
                run(app, {"mouse move " + name + ".slider 0.4", "mouse down",
                          "mouse move " + name + ".slider " + (end > 0 ? "1.2" : "-0.2"), "mouse up"});
                const std::string have = valueOf(app.session().state().document.options, name);
                BOOST_TEST_CONTEXT(name) BOOST_TEST(std::stod(have) == (end > 0 ? info.range.most : info.range.least));
            }
            BOOST_TEST_CONTEXT(name) runLine(app, "widget " + name + ".reset press");
            BOOST_TEST(valueOf(app.session().state().document.options, name) == text.defaultValue);
            BOOST_TEST(!app.widget(name + ".reset"));
        }
    });
    BOOST_TEST(i == texts.size());
    BOOST_CHECK(areEqual(app.session().state().document.options, CageOptions{}));
}

BOOST_AUTO_TEST_CASE(what_is_out_of_range_is_a_message_and_changes_nothing)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait", "widget faces 3"});
    BOOST_TEST(app.messages().size() == 1u);
    BOOST_TEST(app.value("message").find("4 to 1000000") != std::string::npos);
    run(app, {"key enter", "expect messages 0", "expect option.faces 400", "widget faces abc", "expect messages 1",
              "key escape", "expect messages 0", "expect standing current"});
}

BOOST_AUTO_TEST_CASE(undoing_ten_thousand_commands_gives_the_first_picture)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "times off", "wait"});
    while (app.session().documents().canUndo()) app.perform(Undo{});
    run(app, {"redo", "wait"});
    const draw::Picture first = app.picture();
    const std::size_t documents = app.session().documents().depth(), views = app.session().views().depth();
    std::mt19937 random(11);
    for (int i = 0; i < 10000; ++i) {
        const Command command = test::randomCommand(random, files);
        if (std::holds_alternative<SetTurntable>(command)) continue; // would never stand still
        app.perform(actionOf(wordsOf(toText(command))));
    }
    run(app, {"wait"});
    const State last = app.session().state();
    BOOST_TEST(app.session().documents().depth() > 1000);
    BOOST_TEST(app.session().views().depth() > 1000);
    while (app.session().documents().depth() > documents) app.perform(Undo{});
    while (app.session().views().depth() > views) app.perform(UndoView{});
    run(app, {"wait"});
    BOOST_TEST(samePicture(app.picture(), first));
    while (app.session().documents().canRedo()) app.perform(Redo{});
    while (app.session().views().canRedo()) app.perform(RedoView{});
    BOOST_CHECK(app.session().state() == last);
}

BOOST_AUTO_TEST_CASE(ten_bad_files_are_ten_messages)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "set faces 77", "mouse at 640 300", "wait"});
    const draw::Picture before = app.picture();
    const State state = app.session().state();
    const std::vector<std::pair<std::string, std::string>> bad{{"empty.obj", ""},
                                                               {"text.obj", "hello\n"},
                                                               {"cut.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2"},
                                                               {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"},
                                                               {"nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
                                                               {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"},
                                                               {"head.ply", "ply\nformat ascii 2.0\n"},
                                                               {"a.png", "not a mesh"},
                                                               {"no.json", "{}"}};
    std::vector<std::string> paths{(folder / "none.obj").string()};
    for (const auto& [name, text] : bad) {
        test::writeText(folder / name, text);
        paths.push_back((folder / name).string());
    }
    BOOST_TEST(paths.size() == 10u);
    for (std::size_t i = 0; i < paths.size(); ++i) {
        run(app, {"drop " + quotedWord(paths[i]), "expect messages " + std::to_string(i + 1)});
        BOOST_TEST(app.messages().back().rfind(paths[i], 0) == 0u, app.messages().back());
    }
    BOOST_CHECK(app.session().state() == state);
    for (std::size_t i = 10; i > 0; --i) {
        run(app, {"expect messages " + std::to_string(i), i % 2 == 0 ? "key escape" : "widget message.dismiss press"});
    }
    run(app, {"expect messages 0", "expect standing current", "mouse at 640 300", "wait"});
    BOOST_TEST(app.value("option.faces") == "77");
    BOOST_TEST(samePicture(app.picture(), before));
    BOOST_CHECK(app.session().state() == state);
}

BOOST_AUTO_TEST_CASE(a_scene_saved_opened_and_saved_again_is_the_same)
{
    const std::string scene = (folder / "scene.json").string();
    App app(context.api(), setup(false));
    run(app, {"open " + quotedWord(files[1]), "set faces 40", "set resolution 20", "set effort fast", "look right",
              "layer surface on", "section 0 1 0 0.25", "select faces 1 5", "wait", "save-scene " + quotedWord(scene)});
    const std::string text = test::readText(scene), cage = test::readText(folder / "scene.cage.obj");
    App again(context.api(), setup(false));
    run(again, {"open-scene " + quotedWord(scene), "wait", "save-scene " + quotedWord(scene)});
    BOOST_TEST(test::readText(scene) == text);
    BOOST_TEST(test::readText(folder / "scene.cage.obj") == cage);
    BOOST_CHECK(again.session().state().view == app.session().state().view);
    for (App* const each : {&app, &again}) runLine(*each, "times off");
    BOOST_TEST(samePicture(again.picture(), app.picture()));
}

BOOST_AUTO_TEST_CASE(nothing_is_drawn_while_nothing_changes)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    while (app.needsFrame()) app.drawFrame();
    const std::string frames = app.value("frames");
    for (int i = 0; i < 10; ++i) {
        app.update();
        app.checkFiles();
        app.pass(1);
        BOOST_TEST(!app.needsFrame());
    }
    runLine(app, "mouse at 640 300"); // over the picture: nothing changes its look
    BOOST_TEST(!app.needsFrame());
    runLine(app, "expect frames " + frames);
    runLine(app, "layer model off");
    BOOST_TEST(app.needsFrame());
}

BOOST_AUTO_TEST_CASE(what_an_event_changes_in_the_panels_asks_for_a_frame)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    for (const char* line : {"mouse move menu.File", "mouse click", "mouse move menu.Edit", "key escape",
                             "mouse move faces", "mouse click", "type 7", "key tab", "mouse move faces.slider"}) {
        while (app.needsFrame()) app.drawFrame();
        runLine(app, line);
        BOOST_TEST(app.needsFrame(), line);
    }
}

BOOST_AUTO_TEST_CASE(tab_goes_on_from_a_field_and_changes_the_mode_elsewhere)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait", "widget layer.model off"});
    for (const char* mode : {"pose", "shape", "pose", "shape"}) {
        run(app, {"key tab", std::string("expect mode ") + mode});
    }
    run(app, {"mouse move faces", "mouse click", "type 77", "key tab", "expect option.faces 77", "type 33", "key tab",
              "expect option.resolution 33", "expect mode shape", "mouse move picture", "mouse click", "key tab",
              "expect mode pose", "key m", "expect layer.model on"});
}

BOOST_AUTO_TEST_CASE(the_pointer_turns_moves_and_zooms_the_view)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    const draw::Camera camera = app.session().state().view.camera;
    run(app, {"mouse move picture 0.5 0.5", "mouse down", "mouse move picture 0.6 0.5", "mouse move picture 0.7 0.5",
              "mouse up"});
    const draw::Camera turned = app.session().state().view.camera;
    BOOST_TEST(turned.view.azimuthDegrees < camera.view.azimuthDegrees);
    BOOST_TEST(turned.view.elevationDegrees == camera.view.elevationDegrees);
    run(app, {"undo-view"});
    BOOST_TEST(app.session().state().view.camera.view.azimuthDegrees == camera.view.azimuthDegrees);
    run(app, {"mouse wheel 2"});
    BOOST_TEST(app.session().state().view.camera.distance < camera.distance);
    run(app, {"undo-view", "mouse down middle", "mouse move picture 0.5 0.4", "mouse up middle"});
    BOOST_TEST(app.session().state().view.camera.target.y() < camera.target.y());
    // What is recorded gives the same view.
    App other(context.api(), setup());
    std::vector<std::string> lines{"open " + quotedWord(files[0]), "wait"};
    for (const std::string& line : recorded) {
        if (line.rfind("camera", 0) == 0) lines.push_back(line);
    }
    run(other, lines);
    BOOST_CHECK(other.session().state().view == app.session().state().view);
}

BOOST_AUTO_TEST_CASE(a_click_selects_a_face_and_f_frames_it)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait", "look front", "layer model off", "mouse move picture",
              "mouse click", "expect selected 1"});
    const double distance = app.session().state().view.camera.distance;
    run(app, {"key f"});
    BOOST_TEST(app.session().state().view.camera.distance < distance);
    runLine(app, "key home");
    BOOST_TEST(app.session().state().view.camera.distance > 0.9 * distance);
    run(app, {"mouse move picture 0.02 0.05", "mouse click", "expect selected 0"});
}

BOOST_AUTO_TEST_CASE(the_counts_are_those_of_the_drawn_cage)
{
    AppParts parts(
        context.api(), setup(), [](const Command&) {}, [] {});
    ActionRunner actions(parts);
    const PanelDriver panels(parts, actions);
    parts.screen.resize(parts.setup.width, parts.setup.height);
    actions.perform(OpenModel{files[0]});
    actions.waitUntilSettled();
    const Counts made = *panels.content().cage;
    actions.perform(SetMode{Mode::shape});
    actions.perform(Select{{edit::Element::edge, {0}}});
    // The edited cage is drawn at once; the planner has the one before until it is checked.
    actions.perform(EditCage{CageEdit::split});
    const Mesh& drawn = parts.making.cage()->cage;
    BOOST_REQUIRE(parts.making.planner().made()->cage.points.size() != drawn.points.size());
    const Counts edited = *panels.content().cage;
    BOOST_TEST(edited.points == made.points + 1);
    BOOST_TEST(edited.points == drawn.points.size());
    BOOST_TEST(edited.edges == edit::Elements(drawn).edges().size());
    BOOST_TEST(edited.faces == faceCount(drawn));
}

BOOST_AUTO_TEST_CASE(every_shortcut_stands_for_a_line_that_is_known)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    for (const KeyMap map : {KeyMap::blender, KeyMap::maya}) {
        runLine(app, std::string("keys ") + keyMapNames[static_cast<std::size_t>(map)]);
        for (const Shortcut& shortcut : shortcuts(map)) {
            if (shortcut.line == "quit") continue;
            BOOST_TEST_CONTEXT(shortcut.chord)
            {
                BOOST_TEST(nameOf(chordNamed(shortcut.chord)) == shortcut.chord);
                runLine(app, "key " + shortcut.chord);
                BOOST_TEST(app.messages().empty());
                run(app, {"key escape", "key escape"});
            }
        }
    }
}

BOOST_AUTO_TEST_CASE(unsaved_work_is_asked_about)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait", "set faces 50", "quit", "expect ended no",
              "widget quit.dismiss press", "expect ended no", "quit", "key escape", "expect ended no",
              "save-scene " + quotedWord((folder / "s.json").string()), "quit", "expect ended yes"});
    App other(context.api(), setup());
    run(other, {"open " + quotedWord(files[0]), "wait", "quit", "expect ended yes"});
    App third(context.api(), setup());
    run(third, {"open " + quotedWord(files[0]), "set faces 50", "quit", "widget quit.quit! press", "expect ended yes"});
}

BOOST_AUTO_TEST_CASE(a_model_that_changed_on_disk_is_offered_anew)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    const std::string points = app.value("model-points");
    writeMesh(test::sphere({0, 0, 0}, 1, 9), files[0]);
    app.checkFiles();
    BOOST_TEST(app.value("model-points") == points);
    runLine(app, "widget changed.reload press");
    BOOST_TEST(app.value("model-points") != points);
    run(app, {"undo", "wait"});
    BOOST_TEST(app.value("model-points") == points);
    writeMesh(test::sphere({0, 0, 0}, 1, 10), files[0]);
    app.checkFiles();
    run(app, {"widget changed.keep press"});
    app.checkFiles();
    BOOST_TEST(!app.widget("changed.keep"));
}

BOOST_AUTO_TEST_CASE(files_are_browsed_and_not_written_over_without_a_question)
{
    const std::string cage = (folder / "cage.obj").string();
    App app(context.api(), setup());
    run(app, {"key control+o", "widget browser.name " + quotedWord(files[1]), "wait", "expect model \"model 2.obj\"",
              "key control+s", "widget browser.name " + quotedWord(cage), "wait", "expect messages 0"});
    BOOST_TEST(fs::exists(cage));
    test::writeText(cage, "old");
    run(app, {"key control+s", "widget browser.name " + quotedWord(cage)});
    BOOST_TEST(test::readText(cage) == "old");
    run(app, {"widget browser.no press"});
    BOOST_TEST(test::readText(cage) == "old");
    run(app, {"widget browser.ok press", "widget browser.yes press", "wait"});
    BOOST_TEST(test::readText(cage) != "old");
    run(app, {"key control+o", "widget \"browser.entry.model 3.obj\" press", "widget browser.ok press", "wait",
              "expect model \"model 3.obj\""});
}

BOOST_AUTO_TEST_CASE(a_name_without_an_extension_gets_the_first_that_is_allowed)
{
    App app(context.api(), setup());
    run(app, {"open " + quotedWord(files[0]), "wait"});
    const std::string name = quotedWord((folder / "named").string());
    for (const auto& [verb, file] : {std::pair("save-cage", "named.obj"), std::pair("save-scene", "named.json")}) {
        run(app, {std::string("browse ") + verb, "widget browser.name " + name, "wait", "expect messages 0"});
        BOOST_TEST(fs::exists(folder / file), file);
        test::writeText(folder / file, "old");
        run(app, {std::string("browse ") + verb, "widget browser.name " + name, "widget browser.no press"}); // asked
        BOOST_TEST(test::readText(folder / file) == "old", file);
        run(app, {"key escape"});
    }
}

BOOST_AUTO_TEST_CASE(stages_report_options_and_pictures_are_saved)
{
    App app(context.api(), setup(false));
    const auto path = [&](const char* name) { return quotedWord((folder / name).string()); };
    run(app, {"open " + quotedWord(files[1]), "set faces 40", "set resolution 20", "set effort fast", "wait",
              "save-stages " + path("stages"), "save-report " + path("r.json"), "save-options " + path("o.options"),
              "save-picture " + path("p.png"), "reset", "preset " + path("o.options"), "expect option.faces 40"});
    for (const char* name :
         {"solid.vdb", "dilated.vdb", "closed.vdb", "contour.vdb", "surface.obj", "smoothed.obj", "decimated.obj"}) {
        BOOST_TEST(fs::file_size(folder / "stages" / name) > 0u);
    }
    BOOST_TEST(test::readText(folder / "r.json").find("\"bounding\": true") != std::string::npos);
    BOOST_CHECK_THROW(runLine(app, "save-picture " + path("p.txt")), InputError);
    BOOST_CHECK_THROW(runLine(app, "save-cage " + path("cage.xyz")), Error);
}

BOOST_AUTO_TEST_CASE(a_file_that_cannot_hold_a_bounding_cage_is_not_saved)
{
    const fs::path model = folder / "far.obj", file = folder / "cage.stl";
    writeMesh(box(openvdb::Vec3d(10000.1), openvdb::Vec3d(10001.1)), model);
    App app(context.api(), setup(false));
    run(app, {"open " + quotedWord(model.string()), "set faces 12", "set effort fast", "wait"});
    BOOST_CHECK_EXCEPTION(runLine(app, "save-cage " + quotedWord(file.string())), InputError, [](const Error& error) {
        return std::string(error.what()).find(".stl files hold float32, and so rounded the cage does not bound") !=
               std::string::npos;
    });
    BOOST_TEST(!fs::exists(file));
    run(app, {"save-cage " + quotedWord((folder / "cage.ply").string()), "set precision float32", "wait",
              "save-cage " + quotedWord(file.string())});
    BOOST_TEST(checkCage(readMesh(file), readMesh(model)).bounding());
    // After an edit the coordinates are what the user made of them.
    run(app, {"mode shape", "key 1", "key a", "move 1e-5 0 0", "wait", "expect standing current"});
    try {
        runLine(app, "save-cage " + quotedWord(file.string()));
        BOOST_TEST(checkCage(readMesh(file), readMesh(model)).bounding());
    } catch (const InputError&) {
    }
}

BOOST_AUTO_TEST_CASE(errors_of_scripts_name_file_and_line)
{
    App app(context.api(), setup());
    const fs::path script = folder / "s.view";
    for (const char* line : {"fly",
                             "expect faces",
                             "expect colour red",
                             "expect faces 12",
                             "mouse fly",
                             "key hat",
                             "widget hat 3",
                             "open none.obj",
                             "screenshot a.txt",
                             "screenshot a.png 0x5",
                             "type",
                             "tick x",
                             "mouse move hat",
                             "look up",
                             "frame me",
                             "projection fish",
                             "toggle hat",
                             "keys hat",
                             "mouse down hat+left",
                             "mouse down alt+hat",
                             "browse hat",
                             "save-scene s.json",
                             "save-cage c.obj",
                             "open \"a"}) {
        test::writeText(script, std::string("# a comment\n\n") + line + "\n");
        BOOST_TEST_CONTEXT(line)
        BOOST_CHECK_EXCEPTION(runScript(app, script), InputError, [&](const InputError& error) {
            return std::string(error.what()).rfind(script.string() + ":3: ", 0) == 0;
        });
    }
    BOOST_CHECK_THROW(runScript(app, folder / "none.view"), IoError);
}

BOOST_AUTO_TEST_SUITE_END()
