#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <optional>
#include <sstream>

#include <tools/files/naming_files.h>
#include <tools/report/fit_words.h>
#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/bounding/fit.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/mesh/symmetry.h>

#include <tools/cli/arguments/fit_arguments.h>
#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/models.h>
#include <tools/cli/outputs.h>
#include <tools/cli/skip_done.h>

namespace vdbcage::cli {

namespace {

/// \throw InputError when the cage is the model and the model its cage
void requireNotSwapped(const Mesh& cage, const Mesh& model, const CageCheck& check, const std::string& cageFile,
                       const std::string& models, Interrupter* interrupter)
{
    if (check.modelVerticesOutside == 0 || faceCount(cage) <= faceCount(model)) return;
    CheckOptions verdictOnly;
    verdictOnly.measure = false;
    if (!CageChecker(cage, interrupter).check(model, verdictOnly, interrupter).bounding()) return;
    throw InputError(cageFile, "it is inside of " + models + ", which bounds it: give the cage first, then the model");
}

/// Returns a note for a cage that may be that of another model; nothing for others.
std::string noteIfFarOff(const Mesh& cage, const CageCheck& check, const Mesh& model, const std::string& place)
{
    constexpr double most = 0.95, mostRatio = 2; // of the model's vertices; of the longest sides, either way
    const auto all = static_cast<double>(model.points.size() - check.loosePoints);
    const double outside = static_cast<double>(check.modelVerticesOutside) / all;
    const double ratio = detail::longestSide(boundingBox(cage)) / check.longestSide;
    if (outside <= most && ratio <= mostRatio && mostRatio * ratio >= 1) return {};
    std::ostringstream note;
    note << "its longest side is " << std::setprecision(3) << ratio << " times the model's, and "
         << std::lround(100 * outside) << " % of the model's vertices are outside of it";
    if (place.empty()) note << "; --place scales and moves it into the model's box, --place turn turns it, too";
    if (place == "box") note << "; --place turn turns it, too";
    return note.str();
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

Mesh placed(const Mesh& cage, const std::string& place, const BoundingGuard& guard, Progress& progress)
{
    if (place.empty()) return cage;
    return placeCage(cage, guard, place == "turn" ? PlaceTurns::quarters : PlaceTurns::none, &progress);
}

} // namespace

int runFit(Call call)
{
    std::filesystem::path cagePath, outputPath, reportPath;
    std::vector<std::filesystem::path> modelPaths;
    CLI::App app("vdbcage fit CAGE MODEL... -o OUT [OPTIONS]\n"
                 "Moves the points of a cage that somebody drew until it bounds the models.\n"
                 "Faces, their order and all else in the file stay.",
                 "fit");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("models", modelPaths)->required()->type_name("MODEL...");
    app.add_option("-o,--output", outputPath, "the fitted cage to write, as CAGE")->required()->type_name("OUT");
    FitArguments fitting;
    FitOptions& options = fitting.options;
    const std::vector<CLI::Option*> fitOptions = addFitOptions(app, fitting);
    app.add_option("--report", reportPath, "what moved, and the verdicts, as JSON")->type_name("FILE.json");
    bool skipsDone = false;
    app.add_flag("--skip-done", skipsDone, "nothing if the report tells that it was done");
    const TalkArguments talk(app, "progress without a terminal");
    const std::vector<std::string> arguments = call.words;
    call.words = withPlaceValue(std::move(call.words));
    if (!parse(app, std::move(call))) return exitGood;
    requireReport(skipsDone, reportPath);
    requireValid(fitting);
    detail::requireMeshExtension(outputPath);
    if (cagePath.extension() != outputPath.extension()) {
        throw InputError(outputPath.string(), "its extension must be that of the cage, " +
                                                  cagePath.extension().string() + ": all else in the file stays");
    }
    Outputs outputs;
    std::vector<std::filesystem::path> inputPaths{cagePath};
    inputPaths.insert(inputPaths.end(), modelPaths.begin(), modelPaths.end());
    for (const std::filesystem::path& file : filesOf(fitting)) inputPaths.push_back(file);
    for (const std::filesystem::path& file : inputPaths) outputs.reads(file);
    outputs.writes(outputPath);
    if (!reportPath.empty()) outputs.writes(reportPath);

    const auto began = std::chrono::steady_clock::now();
    std::optional<Progress> progress(talk.progressForm());
    // Hashes the files before the work: a run is repeated if they change meanwhile.
    const std::string inputs = reportPath.empty() ? std::string() : fingerprint(inputPaths, valuesOf(fitOptions));
    const report::Json done{{"format", 1}, {"kind", "fit"}, {"fitted", outputPath.string()}, {"inputs", inputs}};
    if (skipsDone && wasDone(reportPath, done, {outputPath})) {
        progress->succeed();
        progress.reset();
        if (!talk.quiet()) std::cerr << printable(outputPath) << ": was done before\n";
        return exitGood;
    }
    const KeptPoints kept = keptPoints(fitting);
    options.keptPoints = kept.numbers;
    options.rails = kept.rails;
    options.tightening = tightenOptions(Effort::fair);
    const std::string cageFile = detail::readMeshBytes(cagePath);
    const MeshFile cage = detail::parseMesh(cageFile, cagePath);
    const std::size_t points = cage.mesh.points.size();
    if (!fitting.keep.empty() && kept.greatest() >= points) {
        throw InputError("--keep", std::to_string(kept.greatest()) + " is not allowed; the cage has " +
                                       std::to_string(points) + " points");
    }
    std::vector<ModelFile> models = readModels(modelPaths, reportPath.empty() ? Hashes::none : Hashes::sha256);
    const std::string names = namesOf(models);
    const Mesh model = takeMesh(models);
    const CageChecker checker(model, &*progress);
    const CageCheck before = checker.check(cage.mesh, {}, &*progress);
    requireNotSwapped(cage.mesh, model, before, cagePath.string(), names, &*progress);
    const std::map<std::string, std::string> files{{"cage", cagePath.string()}, {"model", names}};
    const bool isSymmetric = fitting.symmetry != "off";
    std::string note;
    const Fit fit = files::namingFiles(files, [&] {
        GuardOptions guardOptions = fitGuardOptions(movedPrecision(cagePath, outputPath));
        if (isSymmetric) guardOptions.symmetry = bestSymmetry(model, fitting.symmetry[0] - 'x', &*progress).plane;
        std::optional<Stage> examining(std::in_place, &*progress, StageName::guard);
        const BoundingGuard guard(model, guardOptions, &*progress);
        examining.reset();
        const Mesh drawn = placed(cage.mesh, fitting.place, guard, *progress);
        const CageCheck check = fitting.place.empty() ? before : checker.check(drawn, {}, &*progress);
        note = noteIfFarOff(drawn, check, model, fitting.place);
        if (!note.empty()) progress->say("vdbcage: " + cagePath.string() + ": " + note);
        // A cage that bounds has nothing that has to move, whatever its shape is.
        const bool mayStay = options.tightness == 0 && !isSymmetric && check.bounding();
        if (mayStay && guard.facesTooNear(drawn).empty()) return Fit{drawn};
        return fitCage(drawn, guard, options, &*progress);
    });
    std::ostringstream out;
    writeMoved(cagePath, fit.cage.points, out, outputPath);
    const std::string bytes = out.str();
    const Mesh written = detail::parseMesh(bytes, outputPath).mesh;
    const CageCheck check = checker.check(written, {}, &*progress);
    const Ways ways = waysOf(cage.mesh, fit.cage);
    const bool fits = fit.obstacle == Fit::Obstacle::none && check.bounding();
    const auto failure = [&] {
        return InputError(cagePath.string(),
                          "no place was found where " + report::unfoundPlace(fit) + (note.empty() ? "" : "; " + note));
    };
    if (!reportPath.empty()) {
        report::Json report = report::runFacts("fit", arguments);
        report["models"] = entryOf(models);
        report["cage"] = cagePath.string();
        report["cage_sha256"] = report::sha256Of(cageFile);
        report["cage_warnings"] = cage.summary.warnings;
        report["inputs"] = inputs;
        report["exit_status"] = fits ? exitGood : exitError;
        report["error"] = fits ? report::Json() : report::Json(detail::printable(failure().what()));
        report["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        report["memory_peak_mib"] = report::peakMemory();
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
        throw failure();
    }
    if (!talk.quiet()) {
        std::cout << printable(outputPath) << ": " << verdict(check) << '\n'
                  << "  before                    " << inShort(before) << '\n'
                  << (note.empty() ? "" : "  note                      " + note + '\n')
                  << describe(cage.mesh, ways, check.longestSide) << report::describe(check)
                  << report::warningLines(cagePath, cage.summary) << warningLines(models);
        flushOutput();
    }
    outputs.commit();
    return exitGood;
}

} // namespace vdbcage::cli
