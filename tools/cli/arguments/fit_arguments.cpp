#include <tools/cli/arguments/fit_arguments.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>

namespace vdbcage::cli {

namespace {

constexpr std::string_view listPrefix = "points:";

bool isList(const std::string& keep)
{
    return keep.compare(0, listPrefix.size(), listPrefix) == 0;
}

/// Returns the points of a list such as "1-20,35,40-44:yz". Blanks and ends of lines part its words, too.
/// \throw InputError naming `source`
KeptPoints pointsOf(const std::string& list, const std::string& source)
{
    KeptPoints kept;
    const auto fail = [&](const std::string& word) {
        throw InputError(source, "'" + word + "' is not allowed; it must be numbers of points, as 1-20,35,40-44:yz");
    };
    std::string words = list;
    std::replace(words.begin(), words.end(), ',', ' ');
    std::istringstream in(words);
    for (std::string word; in >> word;) {
        const char *at = word.data(), *const end = at + word.size();
        const auto number = [&] {
            constexpr std::size_t most = 0xffffffff;
            std::size_t value = 0;
            const auto read = std::from_chars(at, end, value);
            if (read.ec != std::errc() || value > most) fail(word);
            at = read.ptr;
            return value;
        };
        const std::size_t first = number();
        std::size_t last = first;
        if (at != end && *at == '-') {
            ++at;
            last = number();
        }
        std::array<bool, 3> mayMove{};
        if (at != end && *at == ':') {
            const std::string axes(at + 1, end);
            if (axes.empty() || axes.find_first_not_of("xyz") != std::string::npos) fail(word);
            for (const char axis : axes) mayMove[static_cast<std::size_t>(axis - 'x')] = true;
            at = end;
        }
        constexpr std::size_t mostInRange = 100'000'000;
        if (at != end || last < first || last - first > mostInRange) fail(word);
        const bool isRail = mayMove[0] || mayMove[1] || mayMove[2];
        for (std::size_t i = first; i <= last; ++i) {
            if (isRail) kept.rails.push_back({i, mayMove});
            if (!isRail) kept.numbers.push_back(i);
        }
    }
    if (kept.numbers.empty() && kept.rails.empty()) fail(list);
    return kept;
}

} // namespace

std::vector<CLI::Option*> addFitOptions(CLI::App& app, FitArguments& arguments)
{
    std::vector<CLI::Option*> options{
        app.add_option("--tight", arguments.options.tightness, "0: least moves, 1: tightest, 0 to 1 [0.5]")
            ->type_name("F"),
        app.add_option("--keep", arguments.keep, "points that stay, or move along axes, from 0")
            ->type_name("points:1-20,35:yz|FILE"),
        app.add_option("--most", arguments.options.mostWay, "the farthest way, of the longest side [inf]")
            ->type_name("F"),
        app.add_option("--place", arguments.place, "first put the cage into the model's box")->type_name("[turn]")};
    // The command `jobs` has the option of the same name for cages that are made.
    if (!app.get_option_no_throw("--symmetry")) {
        options.push_back(app.add_option("--symmetry", arguments.symmetry, "pairs across x, y or z stay pairs [off]")
                              ->type_name("AXIS"));
    }
    return options;
}

std::vector<std::string> withPlaceValue(std::vector<std::string> words)
{
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] != "--place") continue;
        const bool isTurn = i + 1 < words.size() && words[i + 1] == "turn";
        if (isTurn) words.erase(words.begin() + static_cast<std::ptrdiff_t>(i) + 1);
        words[i] = isTurn ? "--place=turn" : "--place=box";
    }
    return words;
}

std::size_t KeptPoints::greatest() const
{
    std::size_t most = 0;
    for (const std::size_t number : numbers) most = std::max(most, number);
    for (const FitOptions::Rail& rail : rails) most = std::max(most, rail.point);
    return most;
}

void requireValid(const FitArguments& arguments)
{
    requireWithin(FitOptions::tightnesses, arguments.options.tightness, "--tight");
    requireWithin(FitOptions::ways, arguments.options.mostWay, "--most");
    const std::string& symmetry = arguments.symmetry;
    if (symmetry != "off" && symmetry != "x" && symmetry != "y" && symmetry != "z")
        throw InputError("--symmetry", symmetry + " is not allowed; it must be off, x, y or z");
    if (!arguments.place.empty() && arguments.place != "box" && arguments.place != "turn")
        throw InputError("--place", arguments.place + " is not allowed; it must be turn, or nothing");
    if (isList(arguments.keep)) keptPoints(arguments);
}

std::vector<std::filesystem::path> filesOf(const FitArguments& arguments)
{
    if (arguments.keep.empty() || isList(arguments.keep)) return {};
    return {arguments.keep};
}

KeptPoints keptPoints(const FitArguments& arguments)
{
    const std::string& keep = arguments.keep;
    if (keep.empty()) return {};
    if (isList(keep)) return pointsOf(keep.substr(listPrefix.size()), "--keep");
    return pointsOf(detail::readFile(keep), keep);
}

} // namespace vdbcage::cli
