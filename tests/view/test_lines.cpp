// Commands and verbs as lines of scripts.
#include <boost/test/unit_test.hpp>

#include <set>
#include <variant>

#include <tools/view/input/verbs.h>
#include <tools/view/script.h>
#include <vdbcage/core/error.h>

using namespace vdbcage;
using namespace vdbcage::view;

static_assert(changesView<SetCamera> && changesView<ShowGround> && changesView<SetTool>);
static_assert(!changesView<OpenModel> && !changesView<MoveSelected> && !changesView<ClearPoses>);

namespace {

std::set<std::string> namesOf(const LineHelp& lines)
{
    std::set<std::string> names;
    for (const auto& line : lines) names.insert(line.first.substr(0, line.first.find(' ')));
    return names;
}

/// One of each verb at least, as its line is written.
const std::vector<std::string>& verbLines()
{
    static const std::vector<std::string> list{"undo",
                                               "redo",
                                               "undo-view",
                                               "redo-view",
                                               "make",
                                               "cancel",
                                               "more",
                                               "fewer",
                                               "toggle mirror-x",
                                               "frame all",
                                               "frame selected",
                                               "look front",
                                               "look bottom",
                                               "projection perspective",
                                               "projection orthographic",
                                               "projection toggle",
                                               "up y",
                                               "up z",
                                               "up toggle",
                                               "select-kind points",
                                               "select-kind faces",
                                               "select-all",
                                               "select-none",
                                               "select-invert",
                                               "select-linked",
                                               "select-grow",
                                               "select-shrink",
                                               "select-loop",
                                               "box",
                                               "grab move",
                                               "grab rotate",
                                               "grab scale",
                                               "next-frame",
                                               "previous-frame",
                                               "next-key",
                                               "previous-key",
                                               "insert-key",
                                               "remove-key",
                                               "save-posed-cage a.obj",
                                               "save-posed-model \"a b.obj\"",
                                               "save-posed-cages a.%04d.obj",
                                               "save-posed-models a.%04d.obj",
                                               "save-colours a.ply",
                                               "save-weights a.npy",
                                               "save-cage \"\"",
                                               "save-stages folder",
                                               "save-report a.json",
                                               "save-options a.options",
                                               "save-scene a.json",
                                               "save-picture a.png",
                                               "open-scene a.json",
                                               "drop a.obj",
                                               "reload",
                                               "browse save-cage",
                                               "keys blender",
                                               "keys maya",
                                               "help",
                                               "dismiss",
                                               "quit",
                                               "quit!",
                                               "tick 0.25"};
    return list;
}

} // namespace

BOOST_AUTO_TEST_SUITE(lines)

BOOST_AUTO_TEST_CASE(every_verb_reads_back_from_its_line)
{
    std::set<std::size_t> seen;
    for (const std::string& line : verbLines()) {
        const Action action = actionOf(wordsOf(line));
        BOOST_TEST_REQUIRE(std::holds_alternative<Verb>(action), line);
        seen.insert(std::get<Verb>(action).index());
        BOOST_TEST(textOf(action) == line);
    }
    BOOST_TEST(seen.size() == std::variant_size_v<Verb>);
}

BOOST_AUTO_TEST_CASE(a_line_with_too_few_or_too_many_words_says_how_it_is_written)
{
    LineHelp all = describeCommands();
    for (const auto& row : describeVerbs()) all.push_back(row);
    int refused = 0;
    for (const auto& [usage, help] : all) {
        const std::string name = usage.substr(0, usage.find(' '));
        const auto isRefused = [&, use = usage](const Words& words) {
            try {
                actionOf(words);
            } catch (const InputError& error) {
                return std::string(error.what()) == name + ": it is written " + use;
            }
            return false;
        };
        const bool takesAny = usage.find("...]") != std::string::npos;
        Words many(20, "1");
        many.insert(many.begin(), name);
        if (!takesAny) BOOST_TEST(isRefused(many), usage);
        const bool needsWords = usage != name && usage[name.size() + 1] != '[';
        if (!takesAny && needsWords) BOOST_TEST(isRefused({name}), usage);
        if (!takesAny) ++refused;
    }
    BOOST_TEST(refused > 80);
}

BOOST_AUTO_TEST_CASE(no_line_of_a_script_means_two_things)
{
    const std::set<std::string> commands = namesOf(describeCommands()), verbs = namesOf(describeVerbs());
    BOOST_TEST(commands.size() == std::variant_size_v<Command>);
    BOOST_TEST(verbs.size() == std::variant_size_v<Verb>);
    for (const std::string& name : namesOf(describeScript()))
        BOOST_TEST(commands.count(name) + verbs.count(name) == 0u);
    for (const std::string& name : verbs) BOOST_TEST(commands.count(name) == 0u, name);
    BOOST_CHECK_THROW(actionOf({"fly"}), InputError);
    BOOST_CHECK_THROW(actionOf({}), InputError);
}

BOOST_AUTO_TEST_CASE(recordings_have_commands_and_what_no_command_follows_from)
{
    BOOST_TEST(isRecorded(ShowGround{true}));
    BOOST_TEST(isRecorded(MoveSelected{}));
    const std::set<std::string> recorded{"undo", "redo",   "undo-view",  "redo-view",
                                         "make", "cancel", "open-scene", "reload"};
    for (const std::string& line : verbLines()) {
        const std::string name = line.substr(0, line.find(' '));
        const bool isExpected = recorded.count(name) > 0 || name.rfind("save-", 0) == 0;
        BOOST_TEST(isRecorded(actionOf(wordsOf(line))) == isExpected, line);
    }
}

BOOST_AUTO_TEST_SUITE_END()
