#include <algorithm>
#include <iostream>

#include <tools/report/job_results.h>
#include <vdbcage/core/error.h>

#include <tools/cli/commands.h>
#include <tools/cli/commands/results_page.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

int runReport(Call call)
{
    std::vector<std::filesystem::path> paths;
    std::filesystem::path csv, html;
    CLI::App app("vdbcage report DIR|FILE.json... [OPTIONS]\n"
                 "Lists the reports of make and fit: failures first, then the loosest cages.\n"
                 "Exit status 2: a job failed, or a cage does not bound its model.",
                 "report");
    app.add_option("reports", paths)->required()->type_name("DIR|FILE.json...");
    app.add_option("--csv", csv, "the same for spreadsheets")->type_name("FILE.csv");
    app.add_option("--html", html, "the same with pictures (of jobs --pictures)")->type_name("FILE.html");
    if (!parse(app, std::move(call))) return exitGood;
    const auto requireExtension = [](const std::filesystem::path& file, const std::string& extension) {
        if (file.empty() || file.extension() == extension) return;
        throw InputError(file.string(), "the name must end in " + extension);
    };
    requireExtension(csv, ".csv");
    requireExtension(html, ".html");
    const std::vector<report::JobResult> results = report::readJobResults(paths);
    Outputs outputs;
    for (const report::JobResult& result : results) outputs.reads(result.report);
    if (!csv.empty()) outputs.writes(csv);
    if (!html.empty()) outputs.writes(html);
    if (!csv.empty()) outputs.add(csv, [&](std::ostream& out) { out << report::csvOf(results); });
    if (!html.empty()) {
        const std::string page = pageOf(results);
        outputs.add(html, [&](std::ostream& out) { out << page; });
    }
    std::cout << report::tableOf(results);
    flushOutput();
    outputs.commit();
    const bool allGood =
        std::all_of(results.begin(), results.end(), [](const report::JobResult& r) { return r.isBounding; });
    return allGood ? exitGood : exitNotBounding;
}

} // namespace vdbcage::cli
