#include <tools/cli/skip_done.h>

#include <algorithm>
#include <string_view>

#include <vdbcage/core/detail/hash.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>

namespace vdbcage::cli {

namespace fs = std::filesystem;

std::string fingerprint(const std::vector<fs::path>& files,
                        const std::vector<std::pair<std::string, std::string>>& options)
{
    detail::Hash hash;
    const auto add = [&](std::string_view bytes) {
        // The length keeps the end of a text apart from the beginning of the next.
        hash.add(std::to_string(bytes.size()) + ' ');
        hash.add(bytes);
    };
    add(VDBCAGE_VERSION);
    for (const auto& [name, value] : options) {
        add(name);
        add(value);
    }
    for (const fs::path& file : files) add(detail::readFile(file));
    return hash.digits();
}

void requireReport(bool skipsDone, const fs::path& reportFile)
{
    if (skipsDone && reportFile.empty()) {
        throw InputError("--skip-done needs --report FILE.json, the record of what it did");
    }
}

bool wasDone(const fs::path& reportFile, const report::Json& facts, const std::vector<fs::path>& results)
{
    const auto exists = [](const fs::path& file) {
        std::error_code ignored;
        return fs::is_regular_file(file, ignored);
    };
    std::error_code ignored;
    if (!std::all_of(results.begin(), results.end(), exists)) return false;
    if (!exists(reportFile) || fs::is_empty(reportFile, ignored)) return false;
    const report::Json report = report::Json::parse(detail::readFile(reportFile), nullptr, false);
    if (!report.is_object()) return false;
    for (const auto& [name, value] : facts.items()) {
        if (!report.contains(name) || report[name] != value) return false;
    }
    return true;
}

} // namespace vdbcage::cli
