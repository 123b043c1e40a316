#include <tools/view/files/folder.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <tuple>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t mostRecentFiles = 10;

std::string lower(std::string text)
{
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

} // namespace

std::vector<FolderEntry> listFolder(const fs::path& folder, const std::vector<std::string>& extensions,
                                    const std::string& text)
{
    std::error_code error;
    fs::directory_iterator entries(folder, fs::directory_options::skip_permission_denied, error);
    if (error) throw IoError(folder.string() + ": the folder cannot be read: " + error.message());
    const std::string wanted = lower(text);
    std::vector<FolderEntry> list;
    for (; entries != fs::directory_iterator(); entries.increment(error)) {
        FolderEntry entry{entries->path().filename().string()};
        std::error_code ignored; // an entry that cannot be examined is shown as a file
        entry.isFolder = entries->is_directory(ignored);
        if (entry.name[0] == '.' && wanted.rfind('.', 0) != 0) continue;
        if (lower(entry.name).find(wanted) == std::string::npos) continue;
        if (!entry.isFolder) {
            const std::string extension = lower(entries->path().extension().string());
            if (!extensions.empty() && std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
                continue;
            }
            entry.bytes = entries->file_size(ignored);
            if (ignored) entry.bytes = 0;
        }
        list.push_back(std::move(entry));
    }
    if (error) throw IoError(folder.string() + ": the folder cannot be read: " + error.message());
    std::sort(list.begin(), list.end(), [](const FolderEntry& a, const FolderEntry& b) {
        const std::string left = lower(a.name), right = lower(b.name);
        return std::tie(b.isFolder, left, a.name) < std::tie(a.isFolder, right, b.name);
    });
    return list;
}

fs::path recentFilesPath()
{
    if (const char* const folder = std::getenv("XDG_CONFIG_HOME"); folder && *folder == '/') {
        return fs::path(folder) / "vdbcage" / "recent";
    }
    if (const char* const home = std::getenv("HOME"); home && *home == '/') {
        return fs::path(home) / ".config" / "vdbcage" / "recent";
    }
    return {};
}

std::vector<fs::path> recentFiles(const fs::path& list)
{
    std::vector<fs::path> files;
    std::error_code error;
    if (list.empty() || !fs::is_regular_file(list, error)) return files;
    try {
        std::istringstream lines(detail::readFile(list));
        for (std::string line; std::getline(lines, line) && files.size() < mostRecentFiles;) {
            if (fs::is_regular_file(line, error)) files.emplace_back(line);
        }
    } catch (const IoError&) { // an unreadable list counts as none
    }
    return files;
}

void addRecentFile(const fs::path& list, const fs::path& file)
{
    if (list.empty() || file.string().find('\n') != std::string::npos) return;
    std::vector<fs::path> files = recentFiles(list);
    files.erase(std::remove(files.begin(), files.end(), file), files.end());
    files.insert(files.begin(), file);
    files.resize(std::min(files.size(), mostRecentFiles));
    std::error_code error;
    fs::create_directories(list.parent_path(), error);
    try {
        writeFileAtomically(list, [&](std::ostream& out) {
            for (const fs::path& path : files) out << path.string() << '\n';
        });
    } catch (const IoError&) { // ignored, see the header
    }
}

} // namespace vdbcage::view
