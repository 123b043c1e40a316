#include <tools/files/frames.h>

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>

#include <vdbcage/core/error.h>

namespace vdbcage::files {

namespace {

namespace fs = std::filesystem;

/// The parts of a file name around its number.
struct Pattern {
    std::string before, after;
    std::size_t digits = 0;
    bool found = false;
};

Pattern parse(const fs::path& path)
{
    const std::string name = path.filename().string();
    Pattern pattern;
    for (std::size_t at = name.find('%'); at != std::string::npos; at = name.find('%', at + 1)) {
        std::size_t end = at + 1, digits = 0;
        while (end < name.size() && name[end] >= '0' && name[end] <= '9' && end < at + 4) {
            digits = 10 * digits + static_cast<std::size_t>(name[end++] - '0');
        }
        if (end == name.size() || name[end] != 'd') continue;
        if (pattern.found) throw InputError(path.string(), "has more than one place for a frame's number");
        pattern = {name.substr(0, at), name.substr(end + 1), digits, true};
    }
    return pattern;
}

std::string digitsOf(long number, std::size_t digits)
{
    std::string text = std::to_string(number);
    if (text.size() < digits) text.insert(0, digits - text.size(), '0');
    return text;
}

} // namespace

bool isPattern(const fs::path& path)
{
    return parse(path).found;
}

fs::path patternFor(const fs::path& path)
{
    if (isPattern(path)) return path;
    return fs::path(path).replace_extension(".%04d" + path.extension().string());
}

namespace {

std::vector<Frame> framesOf(const fs::path& path, const Pattern& pattern)
{
    std::vector<Frame> frames;
    std::error_code error;
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        const std::size_t around = pattern.before.size() + pattern.after.size();
        if (name.size() <= around || name.compare(0, pattern.before.size(), pattern.before) != 0 ||
            name.compare(name.size() - pattern.after.size(), std::string::npos, pattern.after) != 0) {
            continue;
        }
        const std::string digits = name.substr(pattern.before.size(), name.size() - around);
        long number = 0;
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (problem != std::errc() || end != digits.data() + digits.size() || number < 0 ||
            digitsOf(number, pattern.digits) != digits) {
            continue;
        }
        frames.push_back({number, path.parent_path() / name});
    }
    std::sort(frames.begin(), frames.end(), [](const Frame& a, const Frame& b) { return a.number < b.number; });
    return frames;
}

} // namespace

std::vector<Frame> findFrames(const fs::path& path)
{
    const Pattern pattern = parse(path);
    if (!pattern.found) return {{0, path}};
    std::vector<Frame> frames = framesOf(path, pattern);
    if (frames.empty()) throw IoError(path.string() + ": there is no file of this pattern");
    return frames;
}

std::size_t countFrames(const fs::path& path)
{
    return framesOf(path, parse(path)).size();
}

fs::path framePath(const fs::path& path, long number)
{
    const Pattern pattern = parse(path);
    if (!pattern.found) return path;
    return path.parent_path() / (pattern.before + digitsOf(number, pattern.digits) + pattern.after);
}

} // namespace vdbcage::files
