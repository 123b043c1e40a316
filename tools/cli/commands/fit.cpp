#include <algorithm>
#include <charconv>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>
#include <string_view>

#include <tools/files/naming_files.h>
#include <tools/report/fit_words.h>
#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/read_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>

#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/models.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

namespace {

constexpr std::string_view listPrefix = "points:";

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

/// Returns the points that --keep names, itself or in a file.
std::vector<std::size_t> keptPoints(const std::string& keep)
{
    if (keep.empty()) return {};
    if (keep.compare(0, listPrefix.size(), listPrefix) == 0) return numbersOf(keep.substr(listPrefix.size()), "--keep");
    return numbersOf(detail::readFile(keep), keep);
}

/// The ways of a cage's points, in world units.
struct Ways {
    std::vector<double> lengths; ///< by point
    std::size_t moved = 0, farthest = 0;
};

Ways waysOf(const Mesh& before, const Mesh& after)
{
    Ways ways;
    for (std::size_t i = 0; i < before.points.size(); ++i) {
        ways.lengths.push_back((after.points[i] - before.points[i]).length());
        if (before.points[i] != after.points[i]) ++ways.moved;
        if (ways.lengths[i] > ways.lengths[ways.farthest]) ways.farthest = i;
    }
    return ways;
}

std::string describe(const Mesh& cage, const Ways& ways, double longestSide)
{
    std::ostringstream text;
    text << "  points moved              " << ways.moved << " of " << cage.points.size();
    if (ways.moved > 0) {
        text << ", point " << ways.farthest << " the farthest, by " << std::fixed << std::setprecision(3)
             << 100 * ways.lengths[ways.farthest] / longestSide << " % of the model's longest side";
    }
    text << '\n';
    return text.str();
}

std::string inShort(const CageCheck& check)
{
    std::ostringstream text;
    text << verdict(check);
    const std::pair<std::size_t, const char*> counts[] = {
        {check.selfIntersections, "self-intersections"},
        {check.degenerateFaces, "degenerate faces"},
        {check.contactFaces, "faces that touch the model"},
        {check.modelVerticesOutside, "vertices of the model outside"}};
    const char* before = ": ";
    for (const auto& [count, name] : counts) {
        if (count == 0) continue;
        text << before << count << ' ' << name;
        before = ", ";
    }
    text << (before[0] == ':' ? ", " : "; ") << "mean distance " << std::fixed << std::setprecision(3)
         << 100 * check.meanDistance << " %";
    return text.str();
}

} // namespace

int runFit(Call call)
{
    std::filesystem::path cagePath, outputPath, reportPath;
    std::vector<std::filesystem::path> modelPaths;
    std::string keep;
    CLI::App app("vdbcage fit CAGE MODEL... -o OUT [OPTIONS]\n"
                 "Moves the points of a cage that somebody drew until it bounds the models.\n"
                 "Faces, their order and all else in the file stay.",
                 "fit");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("models", modelPaths)->required()->type_name("MODEL...");
    app.add_option("-o,--output", outputPath, "the fitted cage to write, as CAGE")->required()->type_name("OUT");
    FitOptions options;
    app.add_option("--tight", options.tightness, "0: least moves, 1: tightest, 0 to 1 [0.5]")->type_name("F");
    app.add_option("--keep", keep, "points that stay, counted from 0")->type_name("points:1-20,35|FILE");
    app.add_option("--report", reportPath, "what moved, and the verdicts, as JSON")->type_name("FILE.json");
    const TalkArguments talk(app, "progress without a terminal");
    const std::vector<std::string> arguments = call.words;
    if (!parse(app, std::move(call))) return exitGood;
    requireWithin(FitOptions::tightnesses, options.tightness, "--tight");
    detail::requireMeshExtension(outputPath);
    if (cagePath.extension() != outputPath.extension()) {
        throw InputError(outputPath.string(), "its extension must be that of the cage, " +
                                                  cagePath.extension().string() + ": all else in the file stays");
    }
    Outputs outputs;
    outputs.reads(cagePath);
    for (const std::filesystem::path& model : modelPaths) outputs.reads(model);
    if (!keep.empty() && keep.compare(0, listPrefix.size(), listPrefix) != 0) outputs.reads(keep);
    outputs.writes(outputPath);
    if (!reportPath.empty()) outputs.writes(reportPath);

    std::optional<Progress> progress(talk.progressForm());
    options.keptPoints = keptPoints(keep);
    options.tightening = tightenOptions(Effort::fair);
    const std::string cageFile = detail::readMeshBytes(cagePath);
    const MeshFile cage = detail::parseMesh(cageFile, cagePath);
    const std::size_t points = cage.mesh.points.size();
    for (const std::size_t point : options.keptPoints) {
        if (point < points) continue;
        throw InputError("--keep",
                         std::to_string(point) + " is not allowed; the cage has " + std::to_string(points) + " points");
    }
    std::vector<ModelFile> models = readModels(modelPaths, reportPath.empty() ? Hashes::none : Hashes::sha256);
    const std::string names = namesOf(models);
    const Mesh model = takeMesh(models);
    const CageChecker checker(model, &*progress);
    const CageCheck before = checker.check(cage.mesh, {}, &*progress);
    const std::map<std::string, std::string> files{{"cage", cagePath.string()}, {"model", names}};
    const Fit fit = files::namingFiles(files, [&] {
        const GuardOptions guardOptions = fitGuardOptions(movedPrecision(cagePath, outputPath));
        std::optional<Stage> examining(std::in_place, &*progress, StageName::guard);
        const BoundingGuard guard(model, guardOptions, &*progress);
        examining.reset();
        // A cage that bounds has nothing that has to move, whatever its shape is.
        if (options.tightness == 0 && before.bounding() && guard.facesTooNear(cage.mesh).empty()) return Fit{cage.mesh};
        return fitCage(cage.mesh, guard, options, &*progress);
    });
    std::ostringstream out;
    writeMoved(cagePath, fit.cage.points, out, outputPath);
    const std::string bytes = out.str();
    const Mesh written = detail::parseMesh(bytes, outputPath).mesh;
    const CageCheck check = checker.check(written, {}, &*progress);
    const Ways ways = waysOf(cage.mesh, fit.cage);
    const bool fits = fit.obstacle == Fit::Obstacle::none && check.bounding();
    if (!reportPath.empty()) {
        report::Json report = report::runFacts("fit", arguments);
        report["models"] = entryOf(models);
        report["cage"] = cagePath.string();
        report["cage_sha256"] = report::sha256Of(cageFile);
        report["cage_warnings"] = cage.summary.warnings;
        report["fitted"] = fits ? report::Json(outputPath.string()) : report::Json();
        report["before"] = report::toJson(before);
        report["check"] = report::toJson(check);
        report["moved_points"] = ways.moved;
        report["ways"] = ways.lengths;
        report["held_faces"] = fit.heldFaces;
        outputs.add(reportPath, [&](std::ostream& file) { file << report::toText(report); });
    }
    if (fits) outputs.add(outputPath, [&](std::ostream& file) { file << bytes; });
    progress->succeed();
    progress.reset();
    if (!fits) {
        outputs.commit();
        throw InputError(cagePath.string(), "no place was found where " + report::unfoundPlace(fit));
    }
    if (!talk.quiet()) {
        std::cout << printable(outputPath) << ": " << verdict(check) << '\n'
                  << "  before                    " << inShort(before) << '\n'
                  << describe(cage.mesh, ways, check.longestSide) << report::describe(check)
                  << report::warningLines(cagePath, cage.summary) << warningLines(models);
        flushOutput();
    }
    outputs.commit();
    return exitGood;
}

} // namespace vdbcage::cli
