#include <chrono>
#include <iomanip>
#include <iostream>
#include <optional>

#include <tools/report/models.h>
#include <tools/report/report.h>
#include <tools/report/stages.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>

#include "commands.h"
#include "drawing.h"
#include "interrupt.h"
#include "outputs.h"

namespace vdbcage::tool {

namespace {

namespace fs = std::filesystem;

struct MakeArguments {
    std::vector<fs::path> models;
    fs::path cage, stages, report, picture;
    CageOptions options;
    bool quiet = false, verbose = false;
};

/// Refuses what cannot work before any work is done: formats, folders, permissions, one file under two names.
void announce(const MakeArguments& arguments, Outputs& outputs)
{
    detail::requireMeshExtension(arguments.cage);
    if (!arguments.picture.empty()) requirePngExtension(arguments.picture);
    requireValid(arguments.options);
    for (const fs::path& model : arguments.models) outputs.reads(model);
    const CageOptions& options = arguments.options;
    for (const fs::path& file : {options.scale.file, options.density.file, options.joints.file}) {
        if (!file.empty()) outputs.reads(file);
    }
    if (!arguments.stages.empty()) outputs.writesInto(arguments.stages); // the others may go there too
    outputs.writes(arguments.cage);
    if (!arguments.report.empty()) outputs.writes(arguments.report);
    if (!arguments.picture.empty()) outputs.writes(arguments.picture);
    if (arguments.stages.empty()) return;
    for (const fs::path& file : stageFiles(arguments.stages)) outputs.writes(file);
}

/// Runs the pipeline; an objection to the model names its file.
Pipeline makePipeline(std::vector<ModelFile>& models, const MakeArguments& arguments, Interrupter& interrupter)
{
    try {
        Pipeline pipeline(takeMesh(models));
        pipeline.run(arguments.options, &interrupter);
        return pipeline;
    } catch (const InputError& error) {
        const std::string text = error.what(), prefix = "model: ";
        if (text.compare(0, prefix.size(), prefix) != 0) throw;
        throw InputError(namesOf(models) + ": " + text.substr(prefix.size()));
    }
}

void addStages(const Pipeline& pipeline, const MakeArguments& arguments, Interrupter* interrupter, Outputs& outputs)
{
    std::string source;
    for (const fs::path& model : arguments.models) source += (source.empty() ? "" : ", ") + model.filename().string();
    writeStages(
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
        << ", mean distance " << 100 * check.meanDistance << " % of the longest side, " << seconds << " s\n";
    for (const std::string& remark : remarks(report, arguments.options)) out << "  " << remark << '\n';
    out << describe(models);
    if (!arguments.verbose) return out.str();
    for (const StageTime& stage : stages) {
        out << "  " << std::left << std::setw(10) << stage.name << std::right << std::setw(8) << stage.seconds
            << " s\n";
    }
    out << "  resolution " << report.resolution << ", close radius " << report.closeRadius << ", memory peak "
        << peakMemory() << " MiB\n"
        << describe(check);
    return out.str();
}

/// Makes the cage, writes all files and returns what there is to say. All that it took is given back before the files
/// get their names: giving back may fail too (trees of OpenVDB ask for memory for it), and ends the process.
std::string makeFiles(const MakeArguments& arguments, Outputs& outputs, Interrupter& interrupter)
{
    const auto began = std::chrono::steady_clock::now();
    StageClock clock(&interrupter);

    std::optional<Stage> reading(std::in_place, &clock, "read");
    std::vector<ModelFile> models = readModels(arguments.models);
    reading.reset();

    Pipeline pipeline = makePipeline(models, arguments, clock);
    const Mesh& cage = pipeline.cage();
    checkEach(models, cage, &clock);

    std::optional<Stage> writing(std::in_place, &clock, "write");
    // All work first: while files are waiting a signal has to wait for work.
    const std::string picture = arguments.picture.empty() ? std::string() : encodePng(drawCage(pipeline.model(), cage));
    if (!arguments.stages.empty()) addStages(pipeline, arguments, &clock, outputs);
    outputs.add(arguments.cage, [&](std::ostream& out) { writeMesh(cage, out, arguments.cage); });
    if (!arguments.picture.empty()) outputs.add(arguments.picture, [&](std::ostream& out) { out << picture; });
    writing.reset();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!arguments.report.empty()) {
        const Json report = toJson(
            CageMade{entryOf(models), arguments.cage, arguments.options, seconds, clock.stages(), pipeline.report()});
        outputs.add(arguments.report, [&](std::ostream& out) { out << toText(report); });
    }
    return summaryOf(arguments, models, pipeline, clock.stages(), seconds);
}

} // namespace

int runMake(std::vector<std::string> words)
{
    MakeArguments arguments;
    CLI::App app("vdbcage make MODEL... -o CAGE [OPTIONS]: bounds them (.obj .off .ply .stl)", "make");
    app.add_option("models", arguments.models)->required()->type_name("MODEL...");
    app.add_option("-o,--output", arguments.cage, "the cage to write")->required()->type_name("CAGE");
    for (const OptionText& option : describeOptions()) {
        app.add_option_function<std::string>(
               "--" + option.name,
               [&arguments, name = option.name](const std::string& value) {
                   setOption(arguments.options, name, value);
               },
               option.help + (option.range.empty() ? "" : ", " + option.range) + " [" + option.defaultValue + "]")
            ->type_name(option.value)
            ->group(option.isRare ? rareOptions : "Options");
    }
    app.add_option("--stages", arguments.stages, "leave every stage there (.vdb, .obj)")->type_name("DIR");
    app.add_option("--report", arguments.report, "options, times, memory, verdict as JSON")->type_name("FILE.json");
    app.add_option("--picture", arguments.picture, "the model with its cage")->type_name("FILE.png");
    app.add_flag("-q,--quiet", arguments.quiet, "print nothing but errors");
    app.add_flag("-v,--verbose", arguments.verbose, "print progress, stage times, the whole verdict");
    app.set_help_all_flag("--help-all", "print this and the rarer options");
    if (!parse(app, std::move(words))) return exitGood;
    Outputs outputs;
    announce(arguments, outputs);

    std::optional<Progress> progress(verbosityOf(arguments.quiet, arguments.verbose));
    const std::string text = makeFiles(arguments, outputs, *progress);
    outputs.commit();
    progress.reset();
    if (!arguments.quiet) std::cerr << text;
    return exitGood;
}

} // namespace vdbcage::tool
