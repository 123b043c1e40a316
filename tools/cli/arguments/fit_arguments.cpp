#include <tools/cli/arguments/fit_arguments.h>

#include <algorithm>
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

/// Returns the numbers of a list such as "1-20,35". Blanks and ends of lines part them, too.
/// \throw InputError naming `source`
std::vector<std::size_t> numbersOf(const std::string& list, const std::string& source)
{
    std::vector<std::size_t> numbers;
    const auto fail = [&](const std::string& word) {
        throw InputError(source, "'" + word + "' is not allowed; it must be numbers of points, as 1-20,35");
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
        constexpr std::size_t mostInRange = 100'000'000;
        if (at != end || last < first || last - first > mostInRange) fail(word);
        for (std::size_t i = first; i <= last; ++i) numbers.push_back(i);
    }
    if (numbers.empty()) fail(list);
    return numbers;
}

} // namespace

std::vector<CLI::Option*> addFitOptions(CLI::App& app, FitArguments& arguments)
{
    return {
        app.add_option("--tight", arguments.options.tightness, "0: least moves, 1: tightest, 0 to 1 [0.5]")
            ->type_name("F"),
        app.add_option("--keep", arguments.keep, "points that stay, counted from 0")->type_name("points:1-20,35|FILE")};
}

void requireValid(const FitArguments& arguments)
{
    requireWithin(FitOptions::tightnesses, arguments.options.tightness, "--tight");
    if (isList(arguments.keep)) keptPoints(arguments);
}

std::vector<std::filesystem::path> filesOf(const FitArguments& arguments)
{
    if (arguments.keep.empty() || isList(arguments.keep)) return {};
    return {arguments.keep};
}

std::vector<std::size_t> keptPoints(const FitArguments& arguments)
{
    const std::string& keep = arguments.keep;
    if (keep.empty()) return {};
    if (isList(keep)) return numbersOf(keep.substr(listPrefix.size()), "--keep");
    return numbersOf(detail::readFile(keep), keep);
}

} // namespace vdbcage::cli
