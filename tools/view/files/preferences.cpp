#include <tools/view/files/preferences.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <system_error>

#include <tools/view/files/folder.h>
#include <tools/view/state/words.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

/// The size above which a file is not one of ours.
constexpr std::uintmax_t mostBytes = 65536;

void readLine(const std::string& line, Preferences& preferences)
{
    std::vector<std::string> words;
    try {
        words = wordsOf(line);
    } catch (const InputError&) { // a quote without its end
        return;
    }
    if (words.size() != 2 || words[0] != "keys") return;
    const auto* const name = std::find(keyMapNames.begin(), keyMapNames.end(), words[1]);
    if (name != keyMapNames.end()) preferences.keys = static_cast<KeyMap>(name - keyMapNames.begin());
}

} // namespace

fs::path preferencesPath()
{
    const fs::path recent = recentFilesPath();
    return recent.empty() ? fs::path() : recent.parent_path() / "preferences";
}

Preferences readPreferences(const fs::path& file)
{
    Preferences preferences;
    std::error_code error;
    if (file.empty() || !fs::is_regular_file(file, error)) return preferences;
    if (const std::uintmax_t bytes = fs::file_size(file, error); error || bytes > mostBytes) return preferences;
    try {
        std::istringstream lines(detail::readFile(file));
        for (std::string line; std::getline(lines, line);) readLine(line, preferences);
    } catch (const IoError&) { // ignored, see the header
    }
    return preferences;
}

void writePreferences(const fs::path& file, const Preferences& preferences)
{
    if (file.empty()) return;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    try {
        writeFileAtomically(file, [&](std::ostream& out) {
            out << "keys " << keyMapNames[static_cast<std::size_t>(preferences.keys)] << '\n';
        });
    } catch (const IoError&) { // ignored, see the header
    }
}

} // namespace vdbcage::view
