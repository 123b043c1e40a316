#include <chrono>
#include <iomanip>
#include <iostream>
#include <optional>

#include <tools/cli/memory_limit.h>
#include <tools/cli/models.h>
#include <tools/files/naming_files.h>
#include <tools/files/stages.h>
#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/core/detail/joined.h>
#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include <tools/cli/arguments/cage_arguments.h>
#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/drawing.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/outputs.h>
#include <tools/cli/skip_done.h>

namespace vdbcage::cli {

namespace {

namespace fs = std::filesystem;

struct MakeArguments {
    std::vector<std::string> words;
    std::vector<fs::path> models;
    fs::path cage, stages, report, picture;
    CageOptions options;
    std::size_t memoryLimit = 0;
    bool isVerbose = false;
};

/// Returns all files that are read.
std::vector<fs::path> inputsOf(const MakeArguments& arguments)
{
    std::vector<fs::path> files = arguments.models;
    const CageOptions& options = arguments.options;
    for (const fs::path& file : {options.scale.file, options.density.file, options.joints.file}) {
        if (!file.empty()) files.push_back(file);
    }
    return files;
}

/// Returns all files that are written beside the report.
std::vector<fs::path> resultsOf(const MakeArguments& arguments)
{
    std::vector<fs::path> files{arguments.cage};
    if (!arguments.picture.empty()) files.push_back(arguments.picture);
    if (!arguments.stages.empty()) {
        for (const fs::path& file : files::stageFiles(arguments.stages)) files.push_back(file);
    }
    return files;
}

/// Refuses impossible calls before any work is done: formats, folders, permissions, one file under two names.
void announce(const MakeArguments& arguments, Outputs& outputs)
{
    if (!arguments.picture.empty()) requirePngExtension(arguments.picture);
    requireValid(arguments.options);
    for (const fs::path& file : inputsOf(arguments)) outputs.reads(file);
    if (!arguments.stages.empty()) outputs.writesInto(arguments.stages); // the others may go there too
    for (const fs::path& file : resultsOf(arguments)) outputs.writes(file);
    if (!arguments.report.empty()) outputs.writes(arguments.report);
}

/// Runs the pipeline; an objection to the model names its file.
Pipeline makePipeline(std::vector<ModelFile>& models, const MakeArguments& arguments, Interrupter& interrupter)
{
    return files::namingFiles({{"model", namesOf(models)}}, [&] {
        Pipeline pipeline(takeMesh(models));
        pipeline.run(arguments.options, &interrupter, arguments.memoryLimit);
        return pipeline;
    });
}

void addStages(const Pipeline& pipeline, const MakeArguments& arguments, Interrupter* interrupter, Outputs& outputs)
{
    const std::string source =
        detail::joined(arguments.models, ", ", [](const fs::path& model) { return model.filename().string(); });
    files::writeStages(
        {source, arguments.options, pipeline.report(), *pipeline.solid(), *pipeline.closed(), pipeline.surface(),
         pipeline.smoothed(), pipeline.decimated()},
        arguments.stages, [&](const fs::path& path, const FileWriter& write) { outputs.add(path, write); },
        interrupter);
}

std::string summaryOf(const MakeArguments& arguments, const std::vector<ModelFile>& models, const Pipeline& pipeline,
                      const std::vector<StageTime>& stages, double seconds)
{
    const CageReport& report = pipeline.report();
    const CageCheck& check = report.check;
    std::ostringstream out;
    out << std::fixed << std::setprecision(2);
    out << printable(arguments.cage) << ": " << check.triangles << " triangles";
    if (check.quads > 0) out << " and " << check.quads << " quads";
    out << (check.bounding() ? ", certified bounding"
            : check.valid()  ? ", NOT bounding"
                             : ", NOT a valid cage")
        << (check.bounding() && report.partsLeftOut > 0 ? " the parts that were not left out" : "")
        << ", mean distance " << 100 * check.meanDistance << " % of the longest side, resolution " << report.resolution
        << ", " << seconds << " s\n";
    for (const std::string& remark : report::remarks(report, arguments.options)) out << "  " << remark << '\n';
    out << describe(models);
    if (lieApart(models)) {
        out << "  one cage for " << models.size() << " models; for a cage each: vdbcage jobs\n";
    }
    if (!arguments.isVerbose) return out.str();
    out << warningLines(models);
    for (const StageTime& stage : stages) {
        out << "  " << std::left << std::setw(10) << stage.name << std::right << std::setw(8) << stage.seconds
            << " s\n";
    }
    for (const std::string& line : report.plan) out << "  tried " << line << '\n';
    out << "  close radius " << detail::numberText(report.closeRadius) << ", erode radius "
        << detail::numberText(report.erodeRadius);
    if (report.minAngle) out << ", least angle " << detail::numberText(*report.minAngle);
    if (report.mergeAngle) out << ", merge angle " << detail::numberText(*report.mergeAngle);
    out << ", smooth " << report.smooth << ", memory peak " << report::peakMemory() << " MiB\n"
        << report::describe(check);
    return out.str();
}

/// Writes a report of the failure if possible. Ignores errors of that: the first failure matters more.
void reportFailure(const MakeArguments& arguments, const Failure& failure) noexcept
{
    try {
        report::Json models = report::Json::array();
        for (const fs::path& model : arguments.models) models.push_back({{"file", model.string()}});
        const report::Json report =
            report::reportOf(report::CageOrder{arguments.words, models, "", arguments.cage, arguments.options},
                             detail::printable(failure.text), failure.status);
        writeFileAtomically(arguments.report, [&](std::ostream& out) { out << report::toText(report); });
    } catch (const std::exception&) {
    }
}

/// Makes the cage, writes all files and returns the text to print. All memory is freed before the files get their
/// names: freeing may fail too (trees of OpenVDB ask for memory for it), and ends the process.
std::string makeFiles(const MakeArguments& arguments, const std::string& inputs, Outputs& outputs,
                      Interrupter& interrupter)
{
    const auto began = std::chrono::steady_clock::now();
    StageClock clock(&interrupter);

    std::optional<Stage> reading(std::in_place, &clock, StageName::read);
    std::vector<ModelFile> models =
        readModels(arguments.models, arguments.report.empty() ? Hashes::none : Hashes::sha256);
    reading.reset();

    Pipeline pipeline = makePipeline(models, arguments, clock);
    const Mesh& cage = pipeline.cage();
    checkEach(models, cage, pipeline.report().leastPartSide, &clock);

    std::optional<Stage> writing(std::in_place, &clock, StageName::write);
    // All work comes first: while files are waiting a signal has to wait for work.
    const std::string picture = arguments.picture.empty() ? std::string() : encodePng(drawCage(pipeline.model(), cage));
    if (!arguments.stages.empty()) addStages(pipeline, arguments, &clock, outputs);
    const std::string cageFile = bytesOf(cage, arguments.cage);
    outputs.add(arguments.cage, [&](std::ostream& out) { out << cageFile; });
    if (!arguments.picture.empty()) outputs.add(arguments.picture, [&](std::ostream& out) { out << picture; });
    writing.reset();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!arguments.report.empty()) {
        const report::CageOrder order{arguments.words, entryOf(models), inputs, arguments.cage, arguments.options};
        const report::Json report = report::reportOf(
            order, report::CageMade{cage, report::sha256Of(cageFile), seconds, clock.stages(), pipeline.report()});
        outputs.add(arguments.report, [&](std::ostream& out) { out << report::toText(report); });
    }
    return summaryOf(arguments, models, pipeline, clock.stages(), seconds);
}

} // namespace

int runMake(Call call)
{
    MakeArguments arguments;
    bool skipsDone = false;
    std::string memory = "auto";
    CLI::App app("vdbcage make MODEL... -o CAGE [OPTIONS]: A cage for all (" + detail::joined(meshExtensions(), " ") +
                     ")",
                 "make");
    app.add_option("models", arguments.models)->required()->type_name("MODEL...");
    app.add_option("-o,--output", arguments.cage, "the cage to write")->required()->type_name("CAGE");
    addCageOptions(app, arguments.options);
    app.add_option("--stages", arguments.stages, "leave every stage there (.vdb, .obj)")->type_name("DIR");
    app.add_option("--report", arguments.report, "options, times, memory, verdict as JSON")->type_name("FILE.json");
    app.add_option("--picture", arguments.picture, "the model with its cage")->type_name("FILE.png");
    app.add_flag("--skip-done", skipsDone, "nothing if the report tells that it was done");
    addMemoryOption(app, memory);
    const TalkArguments talk(app, "progress, warnings, stage times, whole verdict");
    app.set_help_all_flag("--help-all", "print this and the rarer options");
    arguments.words = call.words;
    if (!parse(app, std::move(call))) return exitGood;
    arguments.isVerbose = talk.verbose();
    arguments.memoryLimit = memoryLimit(memory);
    requireReport(skipsDone, arguments.report);
    setPrecisionFor(arguments.cage, arguments.options);
    std::optional<Outputs> outputs(std::in_place);
    announce(arguments, *outputs);
    std::string text;
    std::optional<SignalHold> hold; // a cancelled run leaves a report, too
    if (!arguments.report.empty()) hold.emplace();
    try {
        std::optional<Progress> progress(talk.progressForm());
        // Hashes the files before the work: a run is repeated if they change meanwhile.
        const std::string inputs = arguments.report.empty()
                                       ? std::string()
                                       : fingerprint(inputsOf(arguments), optionValues(arguments.options));
        const report::Json done{{"format", 1}, {"cage", arguments.cage.string()}, {"inputs", inputs}};
        if (skipsDone && wasDone(arguments.report, done, resultsOf(arguments))) {
            text = printable(arguments.cage) + ": was done before\n";
        } else {
            text = makeFiles(arguments, inputs, *outputs, *progress);
            outputs->commit();
        }
        progress->succeed();
    } catch (const std::exception& exception) {
        outputs.reset(); // removes written files, which also makes room
        if (!arguments.report.empty()) reportFailure(arguments, failureOf(exception));
        throw;
    }
    if (!talk.quiet()) std::cerr << text;
    return exitGood;
}

} // namespace vdbcage::cli
