// vdbcage-bench paper: the tables and figures of "Cage Generation with User Interaction in Cage Modeler", measured
// anew on our own models of the same kinds and sizes, as one page of HTML. What was published stands beside it.

#include <array>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>

#include <data/model.h>
#include <data/poses.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tools/cli/render.h>
#include <tools/report/report.h>
#include <tools/report/run_facts.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/deform/distortion.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/pipeline/pipeline.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/voxelize/voxelize.h>

#include "bench.h"
#include "log_plot.h"
#include "page.h"

namespace vdbcage::bench {

namespace {

namespace fs = std::filesystem;

/// Published wall seconds in 32, 64 and 128 voxels. Of the machine: 4 cores of an i7-8550U.
struct Published {
    const char* model;
    std::array<double, 3> total, voxelizeCgal, voxelizeGl;
};
constexpr std::array<int, 3> publishedResolutions{32, 64, 128};
constexpr Published published[] = {
    {"bishop", {0.97, 5.24, 105}, {0.87, 3.61, 31.9}, {0.39, 0.42, 0.42}},
    {"bench", {1.83, 5.56, 94}, {8.8, 9.9, 15.6}, {1.46, 1.65, 1.40}},
};

/// The value of a row of `published`; 0: there is none.
double publishedValue(const std::string& model, std::array<double, 3> Published::*values, int resolution)
{
    for (const Published& row : published) {
        for (std::size_t i = 0; i < publishedResolutions.size(); ++i) {
            if (model == row.model && publishedResolutions[i] == resolution) return (row.*values)[i];
        }
    }
    return 0;
}

/// A model of ours.
struct Subject {
    const char* name;
    data::Model (*make)();
    openvdb::Vec3d (*pose)(const openvdb::Vec3d&); ///< of its cage; null: none
    View view;
    fs::path path; ///< of its file, for other processes
    Mesh mesh;
};

std::vector<Subject> allSubjects()
{
    const auto walks = [](const openvdb::Vec3d& p) { return data::walking(p, 0.25); };
    return {{"bishop", data::makeBishop, data::bowing, {}, {}, {}},
            {"bench", data::makeBench, nullptr, {}, {}, {}},
            {"creature", data::makeCreature, walks, {}, {}, {}},
            {"botijo", data::makeBotijo, nullptr, {}, {}, {}}};
}

struct Arguments {
    std::string self, words; ///< the name of this program, and what stood behind it
    fs::path output;
    std::vector<std::string> models{"bishop", "bench", "creature", "botijo"};
    std::vector<int> resolutions{32, 64, 128, 256, 512, 1024};
    int wholeRuns = 256, divisions = 3, threads = tbb::info::default_concurrency();
};

std::string printed(const char* format, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// With two or three digits, below 0.1 in milliseconds; "-" for none.
std::string secondsText(double seconds)
{
    if (seconds <= 0) return "-";
    if (seconds < 0.1) {
        return printed(seconds < 0.001 ? "%.2f ms" : seconds < 0.01 ? "%.1f ms" : "%.0f ms", 1000 * seconds);
    }
    return printed(seconds >= 100 ? "%.0f" : seconds >= 10 ? "%.1f" : "%.2f", seconds);
}

std::string percentText(double share)
{
    return printed("%.2f %%", 100 * share);
}

std::string ratioText(double ratio)
{
    return ratio > 0 ? printed("%.2f", ratio) : "-";
}

/// The system's settings: cubes of half a size of 1/16, eroded by 0.4 of it; the cages of 400 faces.
CageOptions textbook(int resolution)
{
    CageOptions options;
    options.bounding = false;
    options.resolution = resolution;
    options.element = StructuringElement::cube;
    options.closeRadius = 1.0 / 16;
    options.erodeRadius = 0.4 / 16;
    return options;
}

/// A whole run in a process of its own, as `vdbcage-bench MODEL` prints it.
report::Json wholeRun(const Arguments& arguments, const fs::path& model, const std::vector<std::string>& options)
{
    std::vector<std::string> words{arguments.self, model.string(), "--threads", std::to_string(arguments.threads)};
    words.insert(words.end(), options.begin(), options.end());
    return report::Json::parse(runSelf(words));
}

report::Json textbookRun(const Arguments& arguments, const fs::path& model, int resolution)
{
    return wholeRun(arguments, model,
                    {"--resolutions", std::to_string(resolution), "--bounding", "off", "--element", "cube",
                     "--close-radius", "0.0625", "--erode-radius", "0.025"});
}

double stageSeconds(const report::Json& run, StageName stage)
{
    return run["stage_seconds"].value(stageInfo(stage).name, 0.0);
}

Picture drawn(const std::vector<std::vector<Layer>>& panels, int columns, const View& view, int width, int height)
{
    Scene scene;
    scene.panels = panels;
    scene.columns = columns;
    scene.sameView = true;
    scene.view = view;
    return renderScene(scene, width, height);
}

void addFigure(Page& page, const std::vector<std::vector<Layer>>& panels, int columns, const View& view,
               const std::string& caption)
{
    constexpr int panelWidth = 230, panelHeight = 200;
    const int rows = static_cast<int>(panels.size()) / columns;
    page.picture(draw::encodePng(drawn(panels, columns, view, columns * panelWidth, rows * panelHeight)), caption);
}

std::string processorName()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);) {
        if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

void addMachine(Page& page, const Arguments& arguments, const std::vector<Subject>& subjects)
{
    const report::Json facts = report::runFacts("paper", {});
    page.paragraph("What the paper \"Cage Generation with User Interaction in Cage Modeler\" measures, measured on "
                   "vdbcage. Its models are not public, so these are our own of the same kinds and sizes. Its figures "
                   "stand beside ours where there are any; they are wall seconds on four cores of an i7-8550U.");
    page.paragraph("Two ways lead to a cage here. Bounding is what vdbcage does by default: every cage is certified to "
                   "hold the whole model. Plain is the way of the paper, with its settings (cubes of a sixteenth of "
                   "the longest side, eroded by 0.4 of that, HC Laplacian smoothing, quadric decimation); nothing "
                   "holds such a cage off the model.");
    page.table("Where this was measured", {"", ""},
               {{"vdbcage", facts["vdbcage"].get<std::string>() + ", commit " +
                                (facts["commit"].is_null() ? "unknown" : facts["commit"].get<std::string>())},
                {"processor", processorName() + ", " + std::to_string(arguments.threads) + " threads"},
                {"command", "vdbcage-bench" + arguments.words}});
    std::vector<std::vector<std::string>> rows;
    for (const Subject& subject : subjects) {
        const std::size_t triangles = subject.mesh.triangles.size() + 2 * subject.mesh.quads.size();
        rows.push_back({subject.name, std::to_string(subject.mesh.points.size()), std::to_string(triangles)});
    }
    page.table("The models", {"model", "points", "triangles"}, rows);
}

/// What stages cost at each resolution, for tables and plots.
struct StageRow {
    int resolution = 0;
    double voxelize = 0, dilate = 0, erode = 0, close = 0;
    std::optional<report::Json> plain, bounding; ///< whole runs
};

StageRow stagesAt(const Arguments& arguments, const Subject& subject, int resolution)
{
    constexpr int runs = 3;
    StageRow row;
    row.resolution = resolution;
    VoxelizeOptions options;
    options.resolution = resolution;
    options.voxelizer = Voxelizer::cpu;
    openvdb::MaskGrid::Ptr solid;
    row.voxelize = leastCost(runs, [&] { solid = voxelize(subject.mesh, options).mask; }).wallSeconds;
    const double radius = resolution / 16.0, inner = 0.4 * radius;
    openvdb::MaskGrid::Ptr grown;
    row.dilate = leastCost(runs, [&] { grown = dilate(*solid, radius, StructuringElement::cube); }).wallSeconds;
    row.erode = leastCost(runs, [&] { return erode(*grown, inner, StructuringElement::cube); }).wallSeconds;
    row.close = leastCost(runs, [&] {
                    return closeMask(*solid, {radius, inner, StructuringElement::cube});
                }).wallSeconds;
    if (resolution <= arguments.wholeRuns) {
        row.plain = textbookRun(arguments, subject.path, resolution);
        row.bounding = wholeRun(arguments, subject.path, {"--resolutions", std::to_string(resolution)});
    }
    return row;
}

PlotSeries seriesOf(const std::string& name, const std::vector<StageRow>& rows, double StageRow::*value)
{
    PlotSeries series{name, {}};
    for (const StageRow& row : rows) {
        if (row.*value > 0) series.points.push_back({static_cast<double>(row.resolution), row.*value});
    }
    return series;
}

PlotSeries seriesOf(const std::string& name, const std::vector<StageRow>& rows,
                    std::optional<report::Json> StageRow::*run, const char* field)
{
    PlotSeries series{name, {}};
    for (const StageRow& row : rows) {
        if (row.*run) series.points.push_back({static_cast<double>(row.resolution), (*(row.*run))[field]});
    }
    return series;
}

void addStages(Page& page, const Arguments& arguments, const std::vector<Subject>& subjects)
{
    page.heading("Time by stage and resolution");
    page.paragraph("The paper's users wait for dilation and erosion: 96 of 105 seconds for the bishop in 128 voxels. "
                   "Here a closing takes milliseconds, as trees of voxels are closed without a grid of distances, and "
                   "the cube by three passes of words of 64 voxels. What takes time is to decimate and tighten under "
                   "a guard that keeps the cage off the model, and that hardly depends on the resolution.");
    for (const Subject& subject : subjects) {
        std::vector<StageRow> rows;
        for (const int resolution : arguments.resolutions) rows.push_back(stagesAt(arguments, subject, resolution));
        std::vector<std::vector<std::string>> cells;
        for (const StageRow& row : rows) {
            std::vector<std::string> line{std::to_string(row.resolution),
                                          secondsText(publishedValue(subject.name, &Published::total, row.resolution)),
                                          secondsText(row.voxelize),
                                          secondsText(row.dilate),
                                          secondsText(row.erode),
                                          secondsText(row.close)};
            if (row.plain) {
                const report::Json& run = *row.plain;
                line.push_back(secondsText(stageSeconds(run, StageName::surface) +
                                           stageSeconds(run, StageName::smooth) +
                                           stageSeconds(run, StageName::decimate)));
                line.push_back(secondsText(run["wall_seconds"]));
                line.push_back(printed("%.0f", run["memory_peak_mib"]));
                line.push_back(secondsText((*row.bounding)["wall_seconds"]));
                line.push_back(printed("%.0f", (*row.bounding)["memory_peak_mib"]));
            }
            line.resize(11, "-");
            cells.push_back(std::move(line));
        }
        page.table(std::string(subject.name) +
                       ": seconds where nothing else is said, and memory in MiB. Dilation and erosion are measured one "
                       "by one; a closing does both "
                       "at once. Totals are of whole runs, reading and certifying included; a bounding run also tries "
                       "the halves of its resolution.",
                   {"voxels", "paper, total", "voxelize", "dilation", "erosion", "closing", "remeshing", "plain, total",
                    "MiB", "bounding, total", "MiB"},
                   cells);
        std::vector<PlotSeries> times{seriesOf("voxelize", rows, &StageRow::voxelize),
                                      seriesOf("dilation", rows, &StageRow::dilate),
                                      seriesOf("erosion", rows, &StageRow::erode),
                                      seriesOf("plain, total", rows, &StageRow::plain, "wall_seconds"),
                                      seriesOf("bounding, total", rows, &StageRow::bounding, "wall_seconds")};
        PlotSeries paper{"the paper, total", {}, true};
        for (const int resolution : publishedResolutions) {
            const double seconds = publishedValue(subject.name, &Published::total, resolution);
            if (seconds > 0) paper.points.push_back({static_cast<double>(resolution), seconds});
        }
        if (!paper.points.empty()) times.push_back(std::move(paper));
        page.plots({logPlot(std::string(subject.name) + ": time", "voxels along the longest side", "seconds", times),
                    logPlot(std::string(subject.name) + ": memory", "voxels along the longest side", "MiB",
                            {seriesOf("plain", rows, &StageRow::plain, "memory_peak_mib"),
                             seriesOf("bounding", rows, &StageRow::bounding, "memory_peak_mib")})},
                   "Time and memory against the resolution. An exponent of 3 is that of a dense grid, 2 that of a "
                   "surface.");
    }
}

void addVoxelizers(Page& page, const Arguments& arguments, const std::vector<Subject>& subjects)
{
    page.heading("Voxelizers side by side");
    page.paragraph("All of them give the same voxels here, bit for bit. gl runs the paper's way, in shaders; without "
                   "hardware these are run by the processor.");
    std::vector<std::vector<std::string>> rows;
    std::string device;
    for (const Subject& subject : subjects) {
        std::string list;
        for (const int resolution : publishedResolutions) {
            list += (list.empty() ? "" : ",") + std::to_string(resolution);
        }
        std::istringstream lines(
            runSelf({arguments.self, "voxelize", subject.path.string(), "--resolutions", list, "--voxelizers",
                     VDBCAGE_BENCH_VOXELIZERS, "--threads", std::to_string(arguments.threads)}));
        for (std::string text; std::getline(lines, text);) {
            const report::Json line = report::Json::parse(text);
            if (line.contains("device")) device = line["device"];
            if (!line.contains("resolution")) continue;
            const int resolution = line["resolution"];
            const auto seconds = [&](const char* name) {
                return line.contains(name) ? secondsText(line[name]["wall_seconds"]) : "-";
            };
            rows.push_back({subject.name, std::to_string(resolution),
                            secondsText(publishedValue(subject.name, &Published::voxelizeCgal, resolution)),
                            secondsText(publishedValue(subject.name, &Published::voxelizeGl, resolution)),
                            seconds("cgal"), seconds("gl"), seconds("cpu")});
        }
    }
    page.table("Seconds. OpenGL here: " + device + ".",
               {"model", "voxels", "paper, CGAL", "paper, OpenGL", "cgal", "gl", "cpu"}, rows);
}

std::string verdictOf(const CageCheck& check)
{
    return check.bounding() ? "certified" : check.valid() ? "cuts the model" : "not valid";
}

/// A value of one option, to be compared with others.
struct Choice {
    std::string name;
    std::function<void(CageOptions&)> set;
};

/// Cages of all subjects by one option. Bounding ones have our own settings beside it, plain ones the paper's with 64
/// voxels, its middle resolution.
void addCages(Page& page, const std::vector<Subject>& subjects, const std::string& column,
              const std::vector<Choice>& choices)
{
    std::vector<std::vector<std::string>> rows;
    std::vector<std::vector<Mesh>> cages; // of each subject
    std::string names;
    for (const Choice& choice : choices) names += (names.empty() ? "" : ", ") + choice.name;
    for (const Subject& subject : subjects) {
        Pipeline pipeline(subject.mesh);
        cages.emplace_back();
        for (const bool bounding : {true, false}) {
            for (const Choice& choice : choices) {
                CageOptions options = bounding ? CageOptions{} : textbook(64);
                choice.set(options);
                cages.back().push_back(pipeline.run(options));
                const CageCheck& check = pipeline.report().check;
                rows.push_back({subject.name, bounding ? "bounding" : "plain", choice.name,
                                std::to_string(check.triangles), std::to_string(check.quads),
                                percentText(check.meanDistance), percentText(check.maxDistance),
                                ratioText(check.volumeRatio), verdictOf(check)});
            }
        }
    }
    page.table(
        "Distances are parts of the model's longest side.",
        {"model", "way", column, "triangles", "quads", "mean distance", "largest", "volume, of the model's", "verdict"},
        rows);
    for (std::size_t i = 0; i < subjects.size(); ++i) {
        std::vector<std::vector<Layer>> panels;
        for (const Mesh& cage : cages[i]) panels.push_back({shadedLayer(subjects[i].mesh), wireframeLayer(cage)});
        addFigure(page, panels, static_cast<int>(choices.size()), subjects[i].view,
                  std::string(subjects[i].name) + ", " + column + " " + names + ": bounding above, plain below.");
    }
}

void addResolutions(Page& page, const Arguments& arguments, const std::vector<Subject>& subjects)
{
    page.heading("Cages by resolution");
    page.paragraph("In the paper the resolution decides how close a cage is: the surface of the voxels is all there "
                   "is, and what was dilated and not eroded stays as an offset. Here the cage is tightened onto the "
                   "model itself. So it hugs the model in 32 voxels as in 128, and twice the voxels never make it "
                   "looser.");
    std::vector<Choice> choices;
    for (const int resolution : publishedResolutions) {
        if (resolution > arguments.wholeRuns) break;
        choices.push_back(
            {std::to_string(resolution), [resolution](CageOptions& options) { options.resolution = resolution; }});
    }
    addCages(page, subjects, "voxels", choices);
}

void addSmoothing(Page& page, const std::vector<Subject>& subjects)
{
    page.heading("Smoothing");
    page.paragraph("The paper smooths the surface of the voxels before it is decimated, 3 times by default. Plain "
                   "cages do so here. Bounding ones are smoothed at the end, each vertex as far as the guard allows, "
                   "so that they grow rounder and looser, and stay certified.");
    std::vector<Choice> choices;
    for (const int sweeps : {0, 3, 9}) {
        choices.push_back({std::to_string(sweeps), [sweeps](CageOptions& options) { options.smooth = sweeps; }});
    }
    addCages(page, subjects, "sweeps", choices);
}

void addMeshes(Page& page, const std::vector<Subject>& subjects)
{
    page.heading("Triangles and tri-quad");
    page.paragraph("Tri-quad cages have quads where two triangles are flat enough. As a quad counts once, they have "
                   "more vertices for as many faces. In bounding ones every quad is convex and holds the model under "
                   "both of its diagonals.");
    addCages(page, subjects, "faces",
             {{"triangles", [](CageOptions& options) { options.mesh = CageFaces::triangles; }},
              {"tri-quad", [](CageOptions& options) { options.mesh = CageFaces::triquad; }}});
}

void addPoses(Page& page, const std::vector<Subject>& subjects)
{
    page.heading("Deforming by either");
    page.paragraph("The same pose of a cage of triangles and of a tri-quad one, by mean value and by Green "
                   "coordinates, and what it does to the model's surface. Distortion 1 is none.");
    std::vector<std::vector<std::string>> rows;
    for (const Subject& subject : subjects) {
        if (!subject.pose) continue;
        Pipeline pipeline(subject.mesh);
        std::vector<Mesh> meshes; // models at rest and posed, cages
        for (const CageFaces faces : {CageFaces::triangles, CageFaces::triquad}) {
            CageOptions options;
            options.mesh = faces;
            const Mesh cage = pipeline.run(options);
            Mesh posed = cage;
            for (openvdb::Vec3d& p : posed.points) p = subject.pose(p);
            meshes.push_back(subject.mesh);
            meshes.push_back(cage);
            for (const Coordinates family : {Coordinates::meanValue, Coordinates::green}) {
                Mesh model = subject.mesh;
                model.points = Binding(cage, subject.mesh.points, family).pose(posed.points);
                const Distortion distortion = poseDistortion(subject.mesh, model.points);
                rows.push_back({subject.name, faces == CageFaces::triangles ? "triangles" : "tri-quad",
                                coordinatesName(family), printed("%.3f", distortion.mean),
                                printed("%.2f", distortion.percentile99),
                                distortion.volume ? printed("%.3f", *distortion.volume) : "-"});
                meshes.push_back(std::move(model));
                meshes.push_back(posed);
            }
        }
        std::vector<std::vector<Layer>> panels;
        for (std::size_t i = 0; i < meshes.size(); i += 2) {
            panels.push_back({shadedLayer(meshes[i]), wireframeLayer(meshes[i + 1])});
        }
        addFigure(page, panels, 3, subject.view,
                  std::string(subject.name) +
                      " at rest, posed by mvc, posed by green: triangles above, tri-quad below.");
    }
    page.table("Distortion of the model's surface, by area: mean, and what 99 % do not exceed.",
               {"model", "cage", "coordinates", "mean", "99 %", "volume, of that at rest"}, rows);
}

/// Each triangle as four.
Mesh divided(const Mesh& mesh)
{
    Mesh result{mesh.points, {}, {}};
    std::map<std::pair<openvdb::Index32, openvdb::Index32>, openvdb::Index32> middles;
    const auto middle = [&](openvdb::Index32 a, openvdb::Index32 b) {
        const auto [known, isNew] =
            middles.emplace(std::minmax(a, b), static_cast<openvdb::Index32>(result.points.size()));
        if (isNew) result.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
        return known->second;
    };
    for (const openvdb::Vec3I& t : triangulate(mesh)) {
        const openvdb::Index32 ab = middle(t[0], t[1]), bc = middle(t[1], t[2]), ca = middle(t[2], t[0]);
        result.triangles.insert(result.triangles.end(), {openvdb::Vec3I(t[0], ab, ca), openvdb::Vec3I(ab, t[1], bc),
                                                         openvdb::Vec3I(ca, bc, t[2]), openvdb::Vec3I(ab, bc, ca)});
    }
    return result;
}

void addScaling(Page& page, const Arguments& arguments, const fs::path& folder)
{
    page.heading("Time and memory by the model's size");
    page.paragraph("The creature, its triangles cut into four again and again. The voxels, the closing and the cage "
                   "are the same each time, so that what grows is reading, voxelizing, the trees over the triangles "
                   "and the certificate.");
    const auto stages = {StageName::read,     StageName::voxelize, StageName::guard,
                         StageName::decimate, StageName::tighten,  StageName::certify};
    std::vector<std::string> columns{"triangles"};
    for (const StageName stage : stages) columns.emplace_back(stageInfo(stage).name);
    columns.insert(columns.end(), {"total", "MiB"});
    std::vector<std::vector<std::string>> rows;
    PlotSeries time{"a whole run", {}}, rest{"all but decimate, tighten", {}}, memory{"a whole run", {}};
    Mesh mesh = cli::readMesh(folder / "creature.obj");
    mesh.triangles = triangulate(mesh);
    mesh.quads.clear();
    for (int i = 0; i <= arguments.divisions; ++i) {
        if (i > 0) mesh = divided(mesh);
        const fs::path path = folder / "divided.ply";
        writeMesh(mesh, path);
        const report::Json run = wholeRun(arguments, path, {"--resolutions", "64"});
        const auto triangles = static_cast<double>(mesh.triangles.size());
        const double seconds = run["wall_seconds"],
                     other = seconds - stageSeconds(run, StageName::decimate) - stageSeconds(run, StageName::tighten);
        time.points.push_back({triangles, seconds});
        rest.points.push_back({triangles, other});
        memory.points.push_back({triangles, run["memory_peak_mib"]});
        std::vector<std::string> row{std::to_string(mesh.triangles.size())};
        for (const StageName stage : stages) row.push_back(secondsText(stageSeconds(run, stage)));
        row.push_back(secondsText(seconds));
        row.push_back(printed("%.0f", run["memory_peak_mib"]));
        rows.push_back(std::move(row));
    }
    page.table("Seconds by stage of a bounding run of 400 faces in 64 voxels, and memory in MiB.", columns, rows);
    page.plots({logPlot("Time", "triangles of the model", "seconds", {time, rest}),
                logPlot("Memory", "triangles of the model", "MiB", {memory})},
               "Time and memory against the triangles.");
}

} // namespace

int runPaper(int argc, char** argv)
{
    Arguments arguments;
    arguments.self = argv[0];
    for (int i = 1; i < argc; ++i) arguments.words += std::string(" ") + argv[i];
    CLI::App app("vdbcage-bench paper: the tables and figures of \"Cage Generation with User Interaction in Cage\n"
                 "Modeler\" on our own models, as a page of HTML; about 5 minutes on two cores");
    app.add_option("-o,--output", arguments.output, "the page to write")->required()->type_name("FILE.html");
    addList(app, "--models", arguments.models, "[bishop,bench,creature,botijo]")->type_name("NAME,NAME");
    addList(app, "--resolutions", arguments.resolutions, "of stages [32,64,128,256,512,1024]")->type_name("N,N");
    app.add_option("--whole-runs", arguments.wholeRuns, "the finest resolution of whole runs, 32 or more [256]")
        ->type_name("N");
    app.add_option("--divisions", arguments.divisions, "times that triangles are cut into four [3]")->type_name("N");
    app.add_option("--threads", arguments.threads, "[all]")->type_name("N");
    CLI11_PARSE(app, argc - 1, argv + 1);
    for (const int resolution : arguments.resolutions) requirePositive("--resolutions", resolution);
    requirePositive("--threads", arguments.threads);
    if (arguments.wholeRuns < 32) throw InputError("--whole-runs: it must be 32 or more");

    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(arguments.threads));
    const ScratchFolder folder;
    std::vector<Subject> subjects;
    for (const std::string& name : arguments.models) {
        bool isKnown = false;
        for (Subject& subject : allSubjects()) {
            if (name != subject.name) continue;
            isKnown = true;
            subjects.push_back(std::move(subject));
        }
        if (!isKnown)
            throw InputError("--models: there is no '" + name + "'; there are bishop, bench, creature, botijo");
    }
    data::writeObj(data::makeCreature(), "creature", folder.path() / "creature.obj");
    for (Subject& subject : subjects) {
        subject.path = folder.path() / (std::string(subject.name) + ".obj");
        data::writeObj(subject.make(), subject.name, subject.path);
        subject.mesh = cli::readMesh(subject.path);
    }
    Page page;
    addMachine(page, arguments, subjects);
    addStages(page, arguments, subjects);
    addVoxelizers(page, arguments, subjects);
    addResolutions(page, arguments, subjects);
    addSmoothing(page, subjects);
    addMeshes(page, subjects);
    addPoses(page, subjects);
    addScaling(page, arguments, folder.path());
    writeFileAtomically(arguments.output,
                        [&](std::ostream& out) { out << page.text("vdbcage beside the paper it implements"); });
    return 0;
}

} // namespace vdbcage::bench
