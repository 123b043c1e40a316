#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

#include <support/option_values.h>
#include <support/read_json.h>
#include <support/run_command.h>
#include <vdbcage/deform/coordinates.h>
#include <vdbcage/pipeline/options.h>

using namespace vdbcage;
using nlohmann::json;
using test::runCommand;

namespace {

const std::string command = VDBCAGE_COMMAND;

std::vector<std::string> linesOf(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The long flags that a text mentions at the start of a line (help) or of a table row (docs/user/OPTIONS.md).
std::set<std::string> flagsOf(const std::vector<std::string>& lines, const std::string& start)
{
    std::set<std::string> flags;
    const std::regex pattern(start + "(-[a-z]`?,? `?)?(--[a-z-]+)");
    for (const std::string& line : lines) {
        std::smatch match;
        if (std::regex_search(line, match, pattern, std::regex_constants::match_continuous)) {
            flags.insert(match[2]);
        }
    }
    return flags;
}

/// The commands that the help lists.
std::vector<std::string> commands()
{
    std::vector<std::string> names;
    const std::regex line("  ([a-z]+)  +[a-z].*");
    for (const std::string& text : linesOf(runCommand({command, "--help"}).out)) {
        std::smatch match;
        if (std::regex_match(text, match, line)) names.push_back(match[1]);
    }
    BOOST_REQUIRE(names.size() > 5);
    return names;
}

/// The form of an option's value in reports, by the type of its field.
struct SchemaByType {
    const OptionInfo& info;
    const OptionText& text;

    json number(const char* type) const
    {
        return {{"type", type}, {"minimum", info.range.least}, {"maximum", info.range.most}};
    }
    json operator()(int /*type*/) const { return number("integer"); }
    json operator()(double /*type*/) const { return number("number"); }
    json operator()(bool /*type*/) const { return {{"type", "boolean"}}; }
    template <typename Number>
    json operator()(const std::optional<Number>& /*type*/) const
    {
        return {{"oneOf", json::array({json{{"const", "auto"}}, (*this)(Number{})})}};
    }
    json textOrNone() const { return {{"type", json::array({"string", "null"})}}; }
    json operator()(const FactorField& /*type*/) const { return textOrNone(); }
    json operator()(const Joints& /*type*/) const { return textOrNone(); }
    template <typename Name>
    json operator()(Name /*type*/) const
    {
        return {{"enum", test::optionWords(text)}};
    }
};

} // namespace

BOOST_AUTO_TEST_SUITE(help)

BOOST_AUTO_TEST_CASE(help_fits_a_screen)
{
    for (const std::string& name : commands()) {
        const auto result = runCommand({command, name, "--help"});
        BOOST_TEST(result.status == 0);
        BOOST_TEST(result.err.empty());
        const auto lines = linesOf(result.out);
        BOOST_TEST(lines.size() > 3U);
        BOOST_TEST(lines.size() <= 24U);
        for (const std::string& line : lines) BOOST_TEST(line.size() <= 80U, line);
    }
}

BOOST_AUTO_TEST_CASE(help_tells_range_and_default_of_every_option)
{
    const auto lines = linesOf(runCommand({command, "make", "--help-all"}).out);
    for (const OptionText& option : describeOptions()) {
        const auto line = std::find_if(lines.begin(), lines.end(), [&](const std::string& candidate) {
            return candidate.find("--" + option.name + " ") != std::string::npos;
        });
        BOOST_REQUIRE(line != lines.end());
        for (const std::string& part : {option.value, option.range, "[" + option.defaultValue + "]", option.help}) {
            BOOST_TEST(line->find(part) != std::string::npos, *line + " lacks " + part);
        }
    }
}

BOOST_AUTO_TEST_CASE(the_short_help_leaves_out_rare_options_only_and_names_the_full_one)
{
    const auto lines = linesOf(runCommand({command, "make", "--help"}).out);
    auto flags = flagsOf(lines, "  ");
    BOOST_TEST(flags.erase("--help-all") == 1U);
    const auto all = flagsOf(linesOf(runCommand({command, "make", "--help-all"}).out), "  ");
    for (const OptionText& option : describeOptions()) {
        BOOST_TEST((flags.count("--" + option.name) == 0) == option.isRare, option.name);
    }
    BOOST_TEST(std::includes(all.begin(), all.end(), flags.begin(), flags.end()));
}

BOOST_AUTO_TEST_CASE(the_page_of_options_lists_the_same_options_with_the_same_defaults)
{
    const auto page = linesOf(test::readText(VDBCAGE_SOURCE_DIR "/docs/user/OPTIONS.md"));
    const auto help = linesOf(runCommand({command, "make", "--help-all"}).out);
    auto inHelp = flagsOf(help, "  ");
    inHelp.erase("--help");
    BOOST_TEST(inHelp.size() > 10U);
    BOOST_TEST(flagsOf(page, "\\| `") == inHelp, boost::test_tools::per_element());
    for (const OptionText& option : describeOptions()) {
        std::string values = option.value;
        for (std::size_t at = values.find('|'); at != std::string::npos; at = values.find('|', at + 2)) {
            values.insert(at, "\\");
        }
        std::string row = "| `--" + option.name + " " + values + "` | " + option.help;
        if (!option.range.empty()) row += ", " + option.range;
        row += " | " + option.defaultValue + " |";
        BOOST_TEST(std::count(page.begin(), page.end(), row) == 1, "OPTIONS.md lacks the row: " + row);
    }
}

BOOST_AUTO_TEST_CASE(the_schema_of_reports_has_the_same_options_with_the_same_values)
{
    const json schema = test::readJson(VDBCAGE_SOURCE_DIR "/docs/user/report.schema.json").at("$defs").at("options");
    const std::vector<OptionText> texts = describeOptions();
    json wanted;
    std::set<std::string> names;
    const CageOptions defaults;
    visitOptions(defaults, [&](const OptionInfo& info, const auto& field) {
        wanted[info.name] = SchemaByType{info, texts.at(names.size())}(field);
        names.insert(info.name);
    });
    for (const auto& [name, form] : schema.at("properties").items()) {
        BOOST_TEST(names.count(name) == 1U, "report.schema.json has " + name + ", which is no option");
    }
    for (const std::string& name : names) {
        const json form = schema.at("properties").value(name, json());
        BOOST_TEST((form == wanted[name]),
                   "report.schema.json has " + form.dump() + " of " + name + "; it must be " + wanted[name].dump());
    }
    const json& required = schema.at("required");
    BOOST_TEST(required.size() == names.size());
    BOOST_TEST(required.get<std::set<std::string>>() == names, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(without_arguments_there_is_a_short_help)
{
    const auto result = runCommand({command});
    BOOST_TEST(result.status == 1);
    BOOST_TEST(result.err == runCommand({command, "--help"}).out);
    BOOST_TEST(runCommand({command, "--version"}).out.rfind("vdbcage ", 0) == 0U);
}

BOOST_AUTO_TEST_CASE(the_page_of_options_has_every_command)
{
    const std::string page = test::readText(VDBCAGE_SOURCE_DIR "/docs/user/OPTIONS.md");
    for (const std::string& name : commands()) {
        BOOST_TEST(page.find("\n    vdbcage " + name + ' ') != std::string::npos, name);
    }
}

BOOST_AUTO_TEST_CASE(the_page_of_deforming_has_a_row_for_each_family_in_their_order)
{
    const auto page = linesOf(test::readText(VDBCAGE_SOURCE_DIR "/docs/user/DEFORMING.md"));
    std::vector<std::string> rows, wanted;
    const std::regex pattern("\\| (`[^|]+) \\| .+ \\| ([a-z]+) \\|"); // names, effect, place
    auto line = std::find(page.begin(), page.end(), "| family | effect | points |");
    for (; line != page.end() && !line->empty(); ++line) {
        std::smatch match;
        if (std::regex_match(*line, match, pattern)) rows.push_back(match.str(1) + ": " + match.str(2));
    }
    for (const FamilyInfo& family : coordinateFamilies()) {
        const std::string name = family.name, nameOnQuads = family.nameOnQuads;
        const std::string names = nameOnQuads == name ? "`" + name + "`" : "`" + name + "` (`" + nameOnQuads + "`)";
        wanted.push_back(names + (family.isEverywhere ? ": anywhere" : ": inside"));
    }
    BOOST_TEST(rows == wanted, boost::test_tools::per_element());
}

BOOST_AUTO_TEST_CASE(help_of_a_command_is_found_both_ways)
{
    for (const std::string& name : commands()) {
        BOOST_TEST(runCommand({command, "help", name}).out == runCommand({command, name, "--help"}).out);
    }
    const auto wrong = runCommand({command, "help", "mak"});
    BOOST_TEST(wrong.status == 1);
    BOOST_TEST(wrong.err.find("did you mean make?") != std::string::npos, wrong.err);
}

BOOST_AUTO_TEST_CASE(slips_get_a_hint)
{
    const auto option = runCommand({command, "make", "a.obj", "-o", "b.obj", "--facs", "100"});
    BOOST_TEST(option.status == 1);
    BOOST_TEST(option.err.find("did you mean --faces?") != std::string::npos, option.err);
    const auto name = runCommand({command, "mak"});
    BOOST_TEST(name.status == 1);
    BOOST_TEST(name.err.find("did you mean make?") != std::string::npos, name.err);
}

BOOST_AUTO_TEST_SUITE_END()
