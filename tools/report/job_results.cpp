#include <tools/report/job_results.h>

#include <algorithm>
#include <iomanip>
#include <optional>
#include <sstream>
#include <tuple>

#include <tools/report/report.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/detail/printable.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>

namespace vdbcage::report {

namespace {

namespace fs = std::filesystem;

std::string modelsOf(const Json& report)
{
    return detail::joined(report.at("models"), ", ",
                          [](const Json& model) { return model.at("file").get<std::string>(); });
}

/// Returns the result in `text`; none: it is no report of `make` or `fit`.
std::optional<JobResult> resultOf(const fs::path& file, const std::string& text)
{
    JobResult result;
    try {
        const Json report = Json::parse(text);
        result.report = file;
        const std::string kind = report.at("kind").get<std::string>();
        if (report.at("format") != 1 || (kind != "make" && kind != "fit")) return std::nullopt;
        // A report by the window has no file of the cage, nor has one of a cage that found no place.
        const Json& cage = report.at(kind == "make" ? "cage" : "fitted");
        result.cage = cage.is_null() ? file.string() : cage.get<std::string>();
        result.models = modelsOf(report);
        if (!report.at("error").is_null()) {
            result.error = report.at("error").get<std::string>();
            result.status = report.at("exit_status").get<int>();
            return result;
        }
        const Json& check = report.at("check");
        result.isBounding = check.at("bounding").get<bool>();
        result.triangles = check.at("triangles").get<std::size_t>();
        result.quads = check.at("quads").get<std::size_t>();
        result.meanDistance = check.at("mean_distance").get<double>();
        result.maxDistance = check.at("max_distance").get<double>();
        if (!check.at("volume_ratio").is_null()) result.volumeRatio = check.at("volume_ratio").get<double>();
        result.minAngleDegrees = check.at("min_angle_degrees").get<double>();
        result.seconds = report.at("seconds").get<double>();
        result.memoryMib = report.at("memory_peak_mib").get<double>();
        return result;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

void readFolder(const fs::path& folder, std::vector<JobResult>& results)
{
    std::error_code problem;
    for (fs::recursive_directory_iterator entry(folder, problem), end; !problem && entry != end;
         entry.increment(problem)) {
        if (!entry->is_regular_file() || entry->path().extension() != ".json" || entry->file_size() == 0) continue;
        if (auto result = resultOf(entry->path(), detail::readFile(entry->path()))) {
            results.push_back(std::move(*result));
        }
    }
    if (problem) throw IoError(folder.string() + ": cannot be read: " + problem.message());
}

bool comesBefore(const JobResult& a, const JobResult& b)
{
    const auto key = [](const JobResult& r) { return std::tuple(r.status == 0, r.isBounding, -r.meanDistance); };
    return std::tuple(key(a), a.report) < std::tuple(key(b), b.report);
}

std::string volumeText(const JobResult& result)
{
    if (!(result.volumeRatio > 0)) return "-";
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << result.volumeRatio;
    return text.str();
}

std::string csvField(const std::string& text)
{
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

} // namespace

std::vector<JobResult> readJobResults(const std::vector<fs::path>& paths)
{
    std::vector<JobResult> results;
    for (const fs::path& path : paths) {
        std::error_code ignored;
        if (fs::is_directory(path, ignored)) {
            readFolder(path, results);
            continue;
        }
        auto result = resultOf(path, detail::readFile(path));
        if (!result) throw IoError(path.string() + ": it is no report of vdbcage make or fit");
        results.push_back(std::move(*result));
    }
    if (results.empty()) throw IoError(paths.front().string() + ": there are no reports of vdbcage make or fit");
    std::sort(results.begin(), results.end(), comesBefore);
    return results;
}

std::string tableOf(const std::vector<JobResult>& results)
{
    std::size_t widest = 4;
    for (const JobResult& result : results) {
        widest = std::max(widest, detail::printable(result.report.stem().string()).size());
    }
    std::ostringstream out;
    const auto name = [&](const std::string& text) {
        out << std::left << std::setw(static_cast<int>(widest)) << text << std::right;
    };
    name("name");
    out << "  verdict     faces  distance  largest  volume  seconds    MiB\n" << std::fixed;
    for (const JobResult& r : results) {
        name(detail::printable(r.report.stem().string()));
        if (r.status != 0) {
            out << "  FAILED " << std::setw(3) << r.status << "  " << detail::printable(r.error) << '\n';
            continue;
        }
        out << (r.isBounding ? "  certified" : "  NOT BOUND") << std::setw(8) << r.triangles + r.quads
            << std::setprecision(2) << std::setw(8) << 100 * r.meanDistance << " %" << std::setw(7)
            << 100 * r.maxDistance << " %" << std::setw(8) << volumeText(r) << std::setprecision(1) << std::setw(9)
            << r.seconds << std::setprecision(0) << std::setw(7) << r.memoryMib << '\n';
    }
    out << sumOf(results) << '\n';
    return out.str();
}

std::string csvOf(const std::vector<JobResult>& results)
{
    std::string text = "report,cage,models,status,error,bounding,triangles,quads,mean_distance,max_distance,"
                       "volume_ratio,min_angle_degrees,seconds,memory_peak_mib\n";
    for (const JobResult& r : results) {
        text += csvField(r.report.string()) + ',' + csvField(r.cage) + ',' + csvField(r.models) + ',' +
                std::to_string(r.status) + ',' + csvField(r.error) + ',';
        if (r.status == 0) {
            const auto number = [](double value) { return ',' + detail::numberText(value); };
            text += std::string(r.isBounding ? "true" : "false") + ',' + std::to_string(r.triangles) + ',' +
                    std::to_string(r.quads) + number(r.meanDistance) + number(r.maxDistance) +
                    (r.volumeRatio > 0 ? number(r.volumeRatio) : ",") + number(r.minAngleDegrees) + number(r.seconds) +
                    number(r.memoryMib);
        } else {
            text += ",,,,,,,,"; // no cage, no numbers
        }
        text += '\n';
    }
    return text;
}

std::string sumOf(const std::vector<JobResult>& results)
{
    const auto failed = std::count_if(results.begin(), results.end(), [](const JobResult& r) { return r.status != 0; });
    const auto certified =
        std::count_if(results.begin(), results.end(), [](const JobResult& r) { return r.isBounding; });
    const auto others = static_cast<std::ptrdiff_t>(results.size()) - failed - certified;
    std::string text = std::to_string(results.size()) + (results.size() == 1 ? " job: " : " jobs: ") +
                       std::to_string(certified) + " certified";
    if (others > 0) text += ", " + std::to_string(others) + " not bounding";
    return text + (failed > 0 ? ", " + std::to_string(failed) + " failed" : "");
}

} // namespace vdbcage::report
