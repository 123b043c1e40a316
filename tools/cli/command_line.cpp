#include <tools/cli/command_line.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>

#include <tools/cli/threads.h>

namespace vdbcage::cli {

namespace {

CommandFacts factsOf(const CLI::App& app)
{
    const std::string text = app.get_description();
    // The usage may contain a colon: only one before a space ends it.
    const std::size_t end = std::min(text.find('\n'), text.find(": "));
    CommandFacts facts;
    facts.name = app.get_name();
    facts.usage = text.substr(0, end);
    if (end < text.size()) facts.text = text.substr(end + (text[end] == '\n' ? 1 : 2));
    facts.notes = app.get_footer();
    for (const CLI::Option* option : app.get_options()) {
        if (option->get_lnames().empty()) continue; // positional arguments are in the usage
        OptionFacts& added = facts.options.emplace_back();
        if (!option->get_snames().empty()) added.letter = '-' + option->get_snames().front();
        added.name = "--" + option->get_lnames().front();
        if (option->get_expected_max() > 0) added.value = option->get_type_name();
        added.help = option->get_description();
        added.isRare = option->get_group() == rareOptions;
        added.isHelp = option == app.get_help_ptr() || option == app.get_help_all_ptr();
    }
    return facts;
}

/// Returns a line for each option.
std::string helpOf(const CLI::App& app, bool isFull)
{
    const CommandFacts facts = factsOf(app);
    std::string text = app.get_description() + "\n\n";
    for (const OptionFacts& option : facts.options) {
        const bool namesFullHelp = option.name == "--help-all" && !isFull;
        if ((option.isHelp && !namesFullHelp) || (option.isRare && !isFull)) continue;
        std::string left = option.letter.empty() ? option.name : option.letter + ' ' + option.name;
        if (!option.value.empty()) left += ' ' + option.value;
        left.resize(std::max<std::size_t>(left.size() + 1, 31), ' ');
        text += "  " + left + option.help + '\n';
    }
    return text + facts.notes;
}

std::size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// Returns whether `argument` is meant as a file: an option with one dash has one known letter.
bool isFileName(const std::string& argument, const std::string& knownLetters)
{
    if (argument.size() < 2 || argument[0] != '-' || argument[1] == '-' || argument[1] == '.') return false;
    if (argument[1] >= '0' && argument[1] <= '9') return false; // a number
    std::error_code ignored;
    return knownLetters.find(argument[1]) == std::string::npos ||
           (argument.size() > 2 && std::filesystem::exists(argument, ignored));
}

/// Refuses unknown options, with a hint. \throw InputError
void requireKnown(const CLI::App& app, const std::vector<std::string>& words)
{
    std::vector<std::string> known;
    std::string letters;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
        for (const std::string& name : option->get_snames()) letters += name;
    }
    for (const std::string& word : words) {
        if (word == "--") return; // files only from here on
        if (isFileName(word, letters)) {
            throw InputError("there is no option '" + word + "'; a file of this name is written ./" + word);
        }
        const std::string flag = word.substr(0, word.find('='));
        if (flag.size() > 2 && flag.compare(0, 2, "--") == 0 &&
            std::find(known.begin(), known.end(), flag) == known.end()) {
            throw InputError("there is no option '" + flag + "'" + didYouMean(flag, known) + " (see vdbcage " +
                             app.get_name() + " --help)");
        }
    }
}

/// Returns the option that an error of CLI11 is about: all its versions name it, in texts of their own.
const CLI::Option* optionOf(const CLI::App& app, const CLI::ParseError& error)
{
    const std::string words = error.what();
    const CLI::Option* found = nullptr;
    for (const CLI::Option* option : app.get_options()) {
        const bool isLonger = !found || option->get_name().size() > found->get_name().size();
        if (isLonger && words.find(option->get_name()) != std::string::npos) found = option;
    }
    return found;
}

/// Reports an error of a call in our own words. \throw InputError always
[[noreturn]] void refuse(const CLI::App& app, const CLI::ParseError& error)
{
    const CLI::Option* option = optionOf(app, error);
    if (!option) throw InputError(error.what());
    const std::string name = option->get_name();
    if (dynamic_cast<const CLI::RequiredError*>(&error)) throw InputError(name + " is required");
    const int most = option->get_items_expected_max();
    if (most == 0) throw InputError(name, "it takes no value");
    if (option->results().empty()) throw InputError(name, "it needs a value, " + option->get_type_name());
    if (option->count() > static_cast<std::size_t>(most)) {
        throw InputError(name, "it is given " + std::to_string(option->count()) + " times; once is allowed");
    }
    const std::string given = "'" + option->results().front() + "'";
    if (option->get_type_name() == "N") {
        throw InputError(name, given + " is not allowed; it must be a whole number");
    }
    throw InputError(name, given + " is not allowed; it must be a number");
}

} // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
    std::size_t least = 3; // a word farther away is no likely slip
    std::string nearest;
    for (const std::string& candidate : known) {
        const std::size_t distance = editDistance(word, candidate);
        if (distance < least && distance < word.size()) {
            least = distance;
            nearest = candidate;
        }
    }
    return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

bool parse(CLI::App& app, Call call)
{
    app.set_help_flag("-h,--help", "print this");
    int threads = 0;
    app.add_option("--threads", threads, "work with at most so many [all]")->type_name("N");
    if (call.describe) {
        call.describe(factsOf(app));
        return false;
    }
    requireKnown(app, call.words);
    app.allow_extras();
    std::reverse(call.words.begin(), call.words.end()); // CLI11 takes them from the back
    try {
        app.parse(std::move(call.words));
    } catch (const CLI::CallForHelp&) {
        std::cout << helpOf(app, false);
        return false;
    } catch (const CLI::CallForAllHelp&) {
        std::cout << helpOf(app, true);
        return false;
    } catch (const CLI::ParseError& error) {
        refuse(app, error);
    }
    if (const std::vector<std::string> extras = app.remaining(); !extras.empty()) {
        throw InputError("there is no place for '" + extras.front() + "'; see vdbcage " + app.get_name() + " --help");
    }
    if (app.count("--threads") > 0) {
        requireWithin({1, 1024}, threads, "threads");
        limitThreads(threads);
    }
    return true;
}

std::vector<std::pair<std::string, std::string>> valuesOf(const std::vector<CLI::Option*>& options)
{
    std::vector<std::pair<std::string, std::string>> values;
    for (const CLI::Option* option : options) {
        for (const std::string& value : option->results()) values.emplace_back(option->get_lnames().front(), value);
    }
    return values;
}

} // namespace vdbcage::cli
