#include <algorithm>
#include <array>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <map>
#include <optional>

#include <vdbcage/core/error.h>
#include <vdbcage/core/version.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/volume/boundary_voxels.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/volume/vdb_io.h>

#include "commands.h"
#include "drawing.h"
#include "interrupt.h"
#include "outputs.h"
#include "report.h"

namespace vdbcage::tool {

namespace {

namespace fs = std::filesystem;

struct MakeArguments {
    fs::path model, cage, stages, report, picture;
    CageOptions options;
    bool quiet = false, verbose = false;
};

/// The names of the files that --stages leaves, without their extensions.
constexpr std::array<const char*, 4> volumeStages{"solid", "dilated", "closed", "contour"};
constexpr std::array<const char*, 3> surfaceStages{"surface", "smoothed", "decimated"};

/// Refuses what cannot work before any work is done: formats, folders, permissions, one file under two names.
void announce(const MakeArguments& arguments, Outputs& outputs)
{
    detail::requireMeshExtension(arguments.cage);
    if (!arguments.picture.empty()) requirePngExtension(arguments.picture);
    requireValid(arguments.options);
    outputs.reads(arguments.model);
    if (!arguments.options.scale.file.empty()) outputs.reads(arguments.options.scale.file);
    if (!arguments.stages.empty()) outputs.writesInto(arguments.stages); // the others may go there too
    outputs.writes(arguments.cage);
    if (!arguments.report.empty()) outputs.writes(arguments.report);
    if (!arguments.picture.empty()) outputs.writes(arguments.picture);
    if (arguments.stages.empty()) return;
    for (const char* stage : volumeStages) outputs.writes(arguments.stages / (std::string(stage) + ".vdb"));
    for (const char* stage : surfaceStages) outputs.writes(arguments.stages / (std::string(stage) + ".obj"));
}

/// Runs the pipeline; an objection to the model names its file.
Pipeline makePipeline(Mesh model, const MakeArguments& arguments, Interrupter& interrupter)
{
    try {
        Pipeline pipeline(std::move(model));
        pipeline.run(arguments.options, &interrupter);
        return pipeline;
    } catch (const InputError& error) {
        const std::string text = error.what(), prefix = "model: ";
        if (text.compare(0, prefix.size(), prefix) != 0) throw;
        throw InputError(arguments.model.string() + ": " + text.substr(prefix.size()));
    }
}

void addStages(const Pipeline& pipeline, const MakeArguments& arguments, Interrupter* interrupter, Outputs& outputs)
{
    std::map<std::string, std::string> metadata{{"source", arguments.model.filename().string()}};
    for (const auto& option : optionValues(arguments.options)) {
        std::string key = option.first;
        std::replace(key.begin(), key.end(), '-', '_');
        metadata["option_" + key] = option.second;
    }
    const double radius = pipeline.report().closeRadius * pipeline.report().resolution;
    const auto dilated = arguments.options.element == StructuringElement::cube
                             ? dilate(*pipeline.solid(), radius, StructuringElement::cube, interrupter)
                             : dilate(*pipeline.solid(), radius, arguments.options.scale, interrupter);
    const auto border = contour(*pipeline.closed(), interrupter);
    const std::array<const openvdb::MaskGrid*, volumeStages.size()> volumes{pipeline.solid().get(), dilated.get(),
                                                                            pipeline.closed().get(), border.get()};
    const std::array<const Mesh*, surfaceStages.size()> surfaces{&pipeline.surface(), &pipeline.smoothed(),
                                                                 &pipeline.decimated()};
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        metadata["stage"] = volumeStages[i];
        const fs::path path = arguments.stages / (std::string(volumeStages[i]) + ".vdb");
        outputs.add(path, [&](std::ostream& out) { writeVdb(*volumes[i], out, path, metadata); });
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const fs::path path = arguments.stages / (std::string(surfaceStages[i]) + ".obj");
        outputs.add(path, [&](std::ostream& out) { writeMesh(*surfaces[i], out, path); });
    }
}

std::string summaryOf(const MakeArguments& arguments, const ReadSummary& summary, const Pipeline& pipeline,
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
    if (report.start == CageStart::hull) {
        out << "  shrunk from the convex hull: the closing has too many parts or handles for so few faces\n";
    } else if (report.start == CageStart::box) {
        out << "  this is the model's bounding box: nothing tighter with so few faces was certified\n";
    }
    if (report.symmetry) {
        const SymmetryPlane& plane = report.symmetry->plane;
        const bool isFound = arguments.options.symmetry == CageSymmetry::automatic;
        std::ostringstream offset; // with as many digits as it needs
        offset << plane.offset;
        out << "  symmetric in the plane "
            << "xyz"[plane.axis] << " = " << offset.str() << (isFound ? ", found" : ", asked for")
            << "; the model is, within " << 100 * report.symmetry->deviation << " % of its longest side\n";
    } else if (!report.noSymmetry.empty()) {
        out << "  not symmetric: " << report.noSymmetry << '\n';
    }
    if (!report.voxels.fallback.empty()) {
        out << "  voxels by the CPU: " << printable(report.voxels.fallback) << '\n';
    }
    if (report.cavitiesFilled > 0) {
        out << "  " << report.cavitiesFilled << " hollows inside the closing were filled\n";
    }
    const bool isSameThroughout = report.solidParts == report.parts && report.parts == check.components &&
                                  report.solidHandles == report.handles && report.handles == check.genus;
    if (report.start == CageStart::closing && !isSameThroughout) {
        out << "  parts and handles: " << report.solidParts << " and " << report.solidHandles << " of the solid, "
            << report.parts << " and " << report.handles << " of the closing, " << check.components << " and "
            << check.genus << " of the cage\n";
    }
    out << describe(summary);
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
    MeshFile file = readMeshFile(arguments.model);
    const Json modelReport = toJson(file, arguments.model);
    reading.reset();

    Pipeline pipeline = makePipeline(std::move(file.mesh), arguments, clock);
    const Mesh& cage = pipeline.cage();

    std::optional<Stage> writing(std::in_place, &clock, "write");
    // All work first: while files are waiting a signal has to wait for work.
    const std::string picture = arguments.picture.empty() ? std::string() : encodePng(drawCage(pipeline.model(), cage));
    if (!arguments.stages.empty()) addStages(pipeline, arguments, &clock, outputs);
    outputs.add(arguments.cage, [&](std::ostream& out) { writeMesh(cage, out, arguments.cage); });
    if (!arguments.picture.empty()) outputs.add(arguments.picture, [&](std::ostream& out) { out << picture; });
    writing.reset();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
    if (!arguments.report.empty()) {
        Json report{{"vdbcage", VDBCAGE_VERSION},
                    {"model", modelReport},
                    {"cage", arguments.cage.string()},
                    {"options", toJson(arguments.options)},
                    {"seconds", seconds},
                    {"stages", toJson(clock.stages())},
                    {"memory_peak_mib", peakMemory()},
                    {"result", toJson(pipeline.report())},
                    {"check", toJson(pipeline.report().check)}};
        outputs.add(arguments.report, [&](std::ostream& out) { out << toText(report); });
    }
    return summaryOf(arguments, file.summary, pipeline, clock.stages(), seconds);
}

} // namespace

int runMake(std::vector<std::string> words)
{
    MakeArguments arguments;
    CLI::App app("vdbcage make MODEL -o CAGE [OPTIONS]: bounds MODEL (.obj .off .ply .stl)", "make");
    app.add_option("model", arguments.model)->required()->type_name("MODEL");
    app.add_option("-o,--output", arguments.cage, "the cage to write")->required()->type_name("CAGE");
    for (const OptionText& option : describeOptions()) {
        app.add_option_function<std::string>(
               "--" + option.name,
               [&arguments, name = option.name](const std::string& value) {
                   setOption(arguments.options, name, value);
               },
               option.help + (option.range.empty() ? "" : ", " + option.range) + " [" + option.defaultValue + "]")
            ->type_name(option.value);
    }
    app.add_option("--stages", arguments.stages, "leave every stage there (.vdb, .obj)")->type_name("DIR");
    app.add_option("--report", arguments.report, "options, times, memory, verdict as JSON")->type_name("FILE.json");
    app.add_option("--picture", arguments.picture, "the model with its cage")->type_name("FILE.png");
    app.add_flag("-q,--quiet", arguments.quiet, "print nothing but errors");
    app.add_flag("-v,--verbose", arguments.verbose, "print stage times and the whole verdict");
    if (!parse(app, std::move(words))) return exitGood;
    Outputs outputs;
    announce(arguments, outputs);

    std::optional<Progress> progress(arguments.quiet);
    const std::string text = makeFiles(arguments, outputs, *progress);
    outputs.commit();
    progress.reset();
    if (!arguments.quiet) std::cerr << text;
    return exitGood;
}

} // namespace vdbcage::tool
