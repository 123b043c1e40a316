#include <boost/test/unit_test.hpp>

#include <random>

#include <support/shapes.h>
#include <support/temporary_folder.h>
#include <tools/view/state/session.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <view/support/orders.h>
#include <view/support/random_command.h>

using namespace vdbcage;
using namespace vdbcage::view;

namespace {

struct Files {
    test::TemporaryFolder folder;
    std::vector<std::string> list;

    Files()
    {
        for (int i = 1; i <= 3; ++i) {
            const auto path = folder.path() / ("box " + std::to_string(i) + ".obj");
            writeMesh(test::box({0, 0, 0}, openvdb::Vec3d(i)), path);
            list.push_back(path.string());
        }
    }
};

} // namespace

BOOST_AUTO_TEST_SUITE(session)

BOOST_AUTO_TEST_CASE(every_command_reads_back_from_its_text)
{
    const Files files;
    std::mt19937 random(1);
    State state = applied({}, OpenModel{files.list[0]});
    const PosableCagePtr cage = test::posable(test::torus(1, 0.3, 16, 8));
    const auto outcome = [&](const Command& command) -> std::optional<State> {
        try {
            return applied(state, command, cage);
        } catch (const InputError&) { // nothing is selected, or it cannot be changed so
            return std::nullopt;
        }
    };
    const std::string posed = (files.folder.path() / "posed.obj").string();
    const std::string parameters = (files.folder.path() / "posed.param").string();
    writeMesh(*cage->rest(), posed);
    test::writeText(parameters, "-1 1 1 0 0.1 0.2 0.3");
    std::vector<int> seen(std::variant_size_v<Command>);
    for (int i = 0; i < 10000; ++i) {
        Command command = random() % 4 == 0 ? test::randomMove(random) : test::randomCommand(random, files.list);
        if (i % 100 == 0) command = OpenPose{posed};
        if (i % 100 == 1) command = OpenPoses{parameters, 1 + static_cast<int>(random() % 40)};
        if (i % 100 == 2) command = OpenWeights{posed}; // it is read when it is needed
        ++seen[command.index()];
        const std::string text = toText(command);
        const Command read = commandOf(wordsOf(text));
        BOOST_TEST_REQUIRE(read.index() == command.index());
        BOOST_TEST_REQUIRE(toText(read) == text);
        // Files are read anew, so they are other objects.
        if (std::holds_alternative<OpenModel>(command) || std::holds_alternative<OpenCage>(command)) continue;
        const std::optional<State> after = outcome(command);
        BOOST_REQUIRE(outcome(read).has_value() == after.has_value());
        if (!after) continue;
        // A cage that was edited is another object each time.
        State same = *outcome(read);
        if (same.document.cage != state.document.cage && after->document.cage && same.document.cage) {
            BOOST_REQUIRE(test::sameMesh(same.document.cage->mesh, after->document.cage->mesh));
            same.document.cage = after->document.cage;
        }
        if (same.document.weights && after->document.weights) {
            BOOST_REQUIRE(same.document.weights->path == after->document.weights->path);
            same.document.weights = after->document.weights;
        }
        BOOST_REQUIRE(same == *after);
        state = *after;
    }
    for (const int count : seen) BOOST_TEST(count > 0);
}

BOOST_AUTO_TEST_CASE(undoing_all_gives_the_first_state_and_redoing_all_the_last)
{
    const Files files;
    std::mt19937 random(2);
    Session session;
    session.execute(OpenModel{files.list[0]});
    const State opened = session.state();
    session = Session();
    session.restart(opened);
    session.setCage(test::posable(test::torus(1, 0.3, 16, 8)));
    for (int i = 0; i < 10000; ++i) {
        if (random() % 50 == 0) session.beginDrag();
        if (random() % 40 == 0) session.endDrag();
        session.execute(test::randomCommand(random, files.list));
        try {
            session.execute(test::randomMove(random));
            if (session.isDragging()) session.replaceDragged(test::randomMove(random));
        } catch (const InputError&) { // nothing is selected, or it cannot be changed so
        }
        if (session.isDragging() && random() % 100 == 0) session.cancelDrag();
        if (random() % 20 == 0) session.undo();
        if (random() % 20 == 0) session.undoView();
        if (random() % 40 == 0) session.redo();
        if (random() % 40 == 0) session.redoView();
    }
    session.endDrag();
    session.execute(SetOption{"faces", "12345"}); // what was undone cannot be redone any more
    session.execute(SetSection{SectionPlane{{1, 2, 3}, 4}});
    const State last = session.state();
    BOOST_TEST(session.documents().depth() > 100);
    BOOST_TEST(session.views().depth() > 100);
    while (session.documents().canUndo()) session.undo();
    BOOST_CHECK(session.state().view == last.view);
    while (session.views().canUndo()) session.undoView();
    BOOST_CHECK(session.state() == opened);
    while (session.documents().canRedo()) session.redo();
    while (session.views().canRedo()) session.redoView();
    BOOST_CHECK(session.state() == last);
}

BOOST_AUTO_TEST_CASE(a_drag_is_one_step)
{
    Session session;
    session.execute(SetOption{"faces", "100"});
    const State before = session.state();
    session.beginDrag();
    for (int faces = 101; faces < 200; ++faces) session.execute(SetOption{"faces", std::to_string(faces)});
    session.endDrag();
    BOOST_TEST(session.documents().depth() == 2);
    BOOST_TEST(session.documents().undone() == "set faces 199");
    session.execute(SetOption{"faces", "200"});
    BOOST_TEST(session.documents().depth() == 3);
    session.undo();
    session.undo();
    BOOST_CHECK(session.state() == before);
}

BOOST_AUTO_TEST_CASE(fits_that_follow_each_other_are_one_step)
{
    const Files files;
    Session session;
    session.execute(OpenModel{files.list[0]});
    session.execute(OpenCage{files.list[1]});
    const auto show = [&] { // what is seen, without a fit
        session.setCage(test::posable(session.state().document.cage->mesh));
    };
    show();
    const State drawn = session.state();
    session.execute(commandOf({"fit"}));
    BOOST_TEST(session.state().document.isFitted);
    BOOST_TEST(session.state().document.tightness == 0.5);
    BOOST_CHECK(session.state().document.cage == drawn.document.cage);
    session.beginDrag();
    for (const char* tightness : {"0.6", "0.7", "0.8"}) session.execute(commandOf({"fit", tightness}));
    session.endDrag();
    BOOST_TEST(session.hasDraggedDocument());
    session.execute(commandOf({"fit", "0.9"}));
    BOOST_TEST(session.documents().depth() == 3);
    BOOST_TEST(session.documents().undone() == "fit 0.9");
    session.undo();
    BOOST_CHECK(session.state() == drawn);
    session.redo();
    BOOST_TEST(session.state().document.tightness == 0.9);
    // An edit by hand goes on from the fitted cage, and the next fit is another step. A fit after an undo makes what
    // was undone impossible to redo.
    session.execute(Select{{edit::Element::point, {0}}});
    session.execute(MoveSelected{{0, 0, 1}});
    BOOST_TEST(!session.state().document.isFitted);
    BOOST_TEST(session.state().document.tightness == 0.9);
    show();
    session.execute(FitCage{0.9});
    BOOST_TEST(session.documents().depth() == 5);
    session.undo();
    session.undo();
    BOOST_TEST(session.documents().canRedo());
    session.execute(FitCage{0.1});
    BOOST_TEST(!session.documents().canRedo());
    BOOST_TEST(session.documents().depth() == 3);
    session.execute(CloseCage{});
    BOOST_TEST(!session.state().document.isFitted);
}

BOOST_AUTO_TEST_CASE(a_fit_of_a_made_cage_is_of_a_copy)
{
    const Files files;
    Session session;
    session.execute(OpenModel{files.list[0]});
    BOOST_CHECK_THROW(session.execute(FitCage{}), InputError); // there is no cage yet
    session.setCage(test::posable(test::torus(1, 0.3, 16, 8)));
    session.execute(FitCage{});
    BOOST_TEST_REQUIRE(session.state().document.cage.get());
    BOOST_TEST(session.state().document.cage->path.empty());
    BOOST_TEST(test::sameMesh(session.state().document.cage->mesh, *session.cage()->rest()));
}

BOOST_AUTO_TEST_CASE(a_tightness_out_of_range_is_refused_with_the_range)
{
    for (const auto& [word, problem] : std::vector<std::pair<std::string, std::string>>{
             {"2", "2 is not allowed; it must be " + toText(FitOptions::tightnesses)},
             {"-0.1", "-0.1 is not allowed; it must be " + toText(FitOptions::tightnesses)},
             {"nan", "'nan' is not allowed; it must be a number"},
             {"tight", "'tight' is not allowed; it must be a number"}}) {
        try {
            commandOf({"fit", word});
            BOOST_TEST(false, word << " was read");
        } catch (const InputError& error) {
            BOOST_TEST(error.what() == "fit: " + problem);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_material_is_of_the_document)
{
    const Elasticity bulging{0.3, Elasticity::Rotations::local, 0, 5};
    Session session;
    session.execute(commandOf({"material", "0.3", "local", "0", "5"}));
    BOOST_TEST((session.state().document.elasticity == bulging));
    session.execute(SetMaterial{bulging}); // no step
    session.beginDrag();
    for (int i = 1; i <= 10; ++i) session.execute(commandOf({"material", "0.3", "local", "0", std::to_string(5 + i)}));
    session.endDrag();
    BOOST_TEST_REQUIRE(session.documents().depth() == 2);
    BOOST_TEST(session.documents().undone() == "material 0.3 local 0 15");
    session.undo();
    BOOST_TEST((session.state().document.elasticity == bulging));
    session.undo();
    BOOST_TEST((session.state().document.elasticity == Elasticity()));
    BOOST_CHECK_EXCEPTION(commandOf({"material", "0.5", "global", "0", "0"}), InputError, [](const InputError& error) {
        return std::string(error.what()) == "nu: 0.5 is not allowed; it must be above -1 and below 0.5";
    });
}

BOOST_AUTO_TEST_CASE(families_are_named_by_the_table)
{
    for (const auto& [usage, help] : describeCommands()) {
        if (usage.rfind("coordinates ", 0) != 0 && usage.rfind("compare ", 0) != 0) continue;
        for (const FamilyInfo& family : coordinateFamilies()) {
            BOOST_TEST((usage + '|').find(std::string(family.name) + '|') != std::string::npos, usage);
        }
    }
}

BOOST_AUTO_TEST_CASE(what_changes_nothing_leaves_no_step_and_what_fails_changes_nothing)
{
    const Files files;
    Session session;
    session.execute(OpenModel{files.list[0]});
    const State state = session.state();
    session.execute(SetOption{"faces", "400"});
    BOOST_TEST(session.documents().depth() == 1);
    const std::vector<std::string> bad{"open " + quotedWord(files.folder.path().string()),
                                       "open none.obj",
                                       "open-cage none.obj",
                                       "set faces 3",
                                       "set faces many",
                                       "set colour 3",
                                       "reset colour",
                                       "preset tidy",
                                       "preset ./none.options"};
    for (const std::string& line : bad) {
        BOOST_CHECK_THROW(session.execute(commandOf(wordsOf(line))), Error);
        BOOST_CHECK(session.state() == state);
    }
    BOOST_TEST(session.documents().depth() == 1);
}

BOOST_AUTO_TEST_CASE(a_line_that_is_no_command_is_refused)
{
    for (const char* line : {"",
                             "fly",
                             "open",
                             "open a b",
                             "layer cage",
                             "layer hat on",
                             "layer cage yes",
                             "opacity cage 2",
                             "opacity cage nan",
                             "colour cage 1 1",
                             "cage-colours red",
                             "section 0 0 0 1",
                             "section 1",
                             "section on",
                             "camera perspective y 0 0 0 0 0 0",
                             "camera perspective x 0 0 0 0 0 6",
                             "camera fish y 0 0 0 0 0 6",
                             "camera perspective y 0 91 0 0 0 6",
                             "ground",
                             "axes 1",
                             "select",
                             "select 1",
                             "select hats",
                             "select faces -1",
                             "select edges 1.5",
                             "select points 4294967296",
                             "model-colours red",
                             "mode up",
                             "tool hammer",
                             "orientation up",
                             "pivot",
                             "pivot up",
                             "pivot point",
                             "pivot 1 2",
                             "pivot 1 2 nan",
                             "see-through 1",
                             "soft -1",
                             "soft 11",
                             "mirror",
                             "mirror w 0",
                             "mirror x",
                             "move 1 2",
                             "move 1 2 inf",
                             "rotate 0 0 0 90 0 0 0",
                             "scale 1 1 1 0 0",
                             "scale 1 1 1 0 0 0 1 0 0",
                             "scale 1 1 1 0 0 0 1 0 0 1 1 0",
                             "edit-cage melt",
                             "reset-pose some",
                             "fit 1.5",
                             "fit off",
                             "fit 0 1",
                             "lock 1",
                             "unlock all",
                             "coordinates best",
                             "coordinates given",
                             "compare given",
                             "material",
                             "material 0 global 0",
                             "material 0 both 0 0",
                             "material 0.5 global 0 0",
                             "material -1 global 0 0",
                             "material nan global 0 0",
                             "material 0 global -1 0",
                             "material 0 global 0 101"}) {
        BOOST_TEST_CONTEXT(line) BOOST_CHECK_THROW(commandOf(wordsOf(line)), InputError);
    }
}

BOOST_AUTO_TEST_CASE(options_that_change_put_an_opened_cage_away_and_undo_brings_it_back)
{
    const Files files;
    Session session;
    BOOST_CHECK_THROW(session.execute(OpenCage{files.list[1]}), InputError);
    session.execute(OpenModel{files.list[0]});
    session.execute(OpenCage{files.list[1]});
    session.execute(SetOption{"faces", "50"});
    BOOST_TEST(!session.state().document.cage);
    session.undo();
    BOOST_TEST_REQUIRE(session.state().document.cage.get());
    BOOST_TEST(session.state().document.cage->path.filename() == "box 2.obj");
}

BOOST_AUTO_TEST_CASE(a_view_is_made_by_its_commands)
{
    std::mt19937 random(3);
    for (int run = 0; run < 100; ++run) {
        State state;
        for (int i = 0; i < 30; ++i) {
            const Command command = test::randomCommand(random, {"none"});
            if (!changesDocument(command)) state = applied(state, command);
        }
        State made;
        for (const Command& command : commandsFor(state.view)) made = applied(made, command);
        BOOST_CHECK(made == state);
    }
}

BOOST_AUTO_TEST_CASE(presets_are_files_of_options)
{
    for (const Preset& preset : presets()) {
        const CageOptions options = presetOptions(preset.name);
        BOOST_CHECK(areEqual(optionsOf(presetText(options), "text"), options));
    }
    BOOST_CHECK(areEqual(presetOptions("balanced"), CageOptions{}));
    const test::TemporaryFolder folder;
    const auto path = folder.path() / "my.options";
    test::writeText(path, "faces 77 # few\n\nsmooth 3\n");
    BOOST_TEST(presetOptions(path.string()).faces == 77);
    test::writeText(path, "faces 77\nfaces\n");
    BOOST_CHECK_EXCEPTION(presetOptions(path.string()), InputError, [&](const InputError& error) {
        return std::string(error.what()).rfind(path.string() + ":2: ", 0) == 0;
    });
    test::writeText(path, "close-radius 0.1\nerode-radius 0.2\n");
    BOOST_CHECK_THROW(presetOptions(path.string()), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
