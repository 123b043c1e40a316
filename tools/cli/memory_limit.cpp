#include <tools/cli/memory_limit.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>

#include <sys/resource.h>

#include <vdbcage/core/error.h>

namespace vdbcage::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();
constexpr double share = 0.8; ///< of the memory at hand: the rest is for other programs and the unforeseen

/// Returns the number at the beginning of a file; unlimited if there is none, as in "max".
std::size_t numberIn(const fs::path& file)
{
    std::ifstream in(file);
    std::size_t number = 0;
    return in >> number ? number : unlimited;
}

/// Returns MemAvailable: the memory available without swapping.
std::size_t availableOfMachine(const fs::path& root)
{
    std::ifstream in(root / "proc/meminfo");
    for (std::string word; in >> word;) {
        std::size_t kibibytes = 0;
        if (word == "MemAvailable:" && in >> kibibytes) return kibibytes * 1024;
    }
    return unlimited;
}

/// Returns the least limit of the group `path` of a hierarchy and of its parents. In a container the path may be one of
/// the outside, of which only the outermost group is visible: the hierarchy's own folder.
std::size_t leastLimit(const fs::path& hierarchy, const std::string& path, const char* file)
{
    std::size_t least = numberIn(hierarchy / file);
    fs::path group = hierarchy;
    for (const fs::path& part : fs::path(path).relative_path()) {
        group /= part;
        least = std::min(least, numberIn(group / file));
    }
    return least;
}

std::size_t limitOfGroups(const fs::path& root)
{
    const fs::path groups = root / "sys/fs/cgroup";
    std::size_t least = unlimited;
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) { // NUMBER:CONTROLLERS:PATH
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = ',' + line.substr(first + 1, second - first - 1) + ',';
        const std::string path = line.substr(second + 1);
        if (controllers == ",,") {
            least = std::min(least, leastLimit(groups, path, "memory.max"));
        } else if (controllers.find(",memory,") != std::string::npos) {
            least = std::min(least, leastLimit(groups / "memory", path, "memory.limit_in_bytes"));
        }
    }
    return least;
}

std::size_t limitOfProcess()
{
    rlimit limit{};
    const bool isKnown = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return isKnown ? limit.rlim_cur : unlimited;
}

} // namespace

std::size_t memoryAtHand(const fs::path& root)
{
    return std::min({availableOfMachine(root), limitOfGroups(root), limitOfProcess()});
}

std::size_t memoryLimit(const std::string& text)
{
    if (text == "off") return unlimited;
    if (text == "auto") {
        const std::size_t atHand = memoryAtHand();
        return atHand == unlimited ? unlimited : static_cast<std::size_t>(share * static_cast<double>(atHand));
    }
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, number);
    const std::string unit(parsed.ptr, end);
    const std::string units = "KMGT";
    const std::size_t power = unit.empty() ? 0 : 1 + units.find(unit);
    constexpr double most = 1e18; // bytes
    const bool isSize = parsed.ec == std::errc() && (unit.empty() || (unit.size() == 1 && power > 0));
    double bytes = number;
    for (std::size_t i = 0; isSize && i < power; ++i) bytes *= 1024;
    if (!isSize || !(bytes >= 1 && bytes <= most)) {
        throw InputError("--memory",
                         "'" + text + "' is not allowed; it must be auto, off, or a size as 4G, 512M or 4000000000");
    }
    return static_cast<std::size_t>(bytes);
}

} // namespace vdbcage::cli
