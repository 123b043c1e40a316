#include <algorithm>
#include <iostream>
#include <optional>

#include <tools/cli/models.h>
#include <tools/files/frames.h>
#include <tools/files/naming_files.h>
#include <tools/files/posed_cage.h>
#include <vdbcage/check/check.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/inversions.h>
#include <vdbcage/deform/weights_io.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>

#include <tools/cli/arguments/coordinate_arguments.h>
#include <tools/cli/arguments/talk_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/commands/compare_families.h>
#include <tools/cli/drawing.h>
#include <tools/cli/interrupt.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

namespace {

namespace fs = std::filesystem;

/// Returns the result of `bind`; its objection to the points or the cage names their file.
template <typename Bind>
auto bindFiles(const fs::path& cagePath, const fs::path& modelPath, const Bind& bind)
{
    return files::namingFiles({{"cage", cagePath.string()}, {"points", modelPath.string()}}, bind);
}

/// Adds the model's points that no face uses to the options.
CoordinateOptions forModel(const Mesh& model, CoordinateOptions options)
{
    options.loose.indices = loosePoints(model);
    return options;
}

/// Returns a line such as "  points of MODEL that no face uses: 2; where the family is not defined they ride along by
/// mean value coordinates".
std::string describeLoose(const fs::path& path, const CoordinateOptions& options)
{
    if (options.loose.indices.empty()) return {};
    return "  points of " + printable(path) + " that no face uses: " + std::to_string(options.loose.indices.size()) +
           (options.loose.motion == LoosePoints::Motion::stay
                ? "; they stay where they are\n"
                : "; outside of the cage they ride along by mean value coordinates\n");
}

/// Returns a line if the cage at rest does not bound the model, or crosses itself: such weights pose it less well.
/// Empty if the cage is good.
std::string describeFit(const Mesh& cage, const Mesh& model, Interrupter* interrupter)
{
    CheckOptions options;
    options.measure = false;
    const CageCheck check = checkCage(cage, model, options, interrupter);
    std::string text;
    if (check.modelVerticesOutside > 0) {
        text = std::to_string(check.modelVerticesOutside) + " of " + std::to_string(model.points.size()) +
               " points are not inside the cage";
    }
    if (check.selfIntersections > 0) {
        text += (text.empty() ? "" : "; ") + ("the cage has " + std::to_string(check.selfIntersections)) +
                (check.selfIntersections == 1 ? " self-intersection" : " self-intersections");
    }
    return text.empty() ? text : "  " + text + '\n';
}

/// Returns a line for each frame: the number of triangles of the model that the pose turns inside out, and whether the
/// posed cage is valid.
std::string describeInversions(const Binding& binding, const Mesh& model, const std::vector<files::Frame>& frames,
                               const std::vector<std::vector<openvdb::Vec3d>>& poses, Interrupter* interrupter)
{
    const auto inverted = invertedTriangles(binding, model, poses, interrupter);
    const CageChecker checker(model, interrupter);
    CheckOptions options;
    options.measure = false;
    const std::size_t triangles = triangulate(model).size();
    std::string text;
    Mesh posed = binding.cage();
    for (std::size_t i = 0; i < frames.size(); ++i) {
        posed.points = poses[i];
        const bool valid = checker.check(posed, options, interrupter).valid();
        text += printable(frames[i].path) + ": " + (valid ? "a valid cage" : "NOT a valid cage") + ", " +
                std::to_string(inverted[i].size()) + " of " + std::to_string(triangles) + " triangles inverted\n";
    }
    return text;
}

/// Returns the files for the weights of each model: `output`, or for several models files in that folder, named after
/// them.
std::vector<fs::path> weightsFiles(const fs::path& output, const std::vector<fs::path>& models)
{
    if (models.size() == 1) {
        if (output.extension() == ".npy") return {output};
        throw InputError(output.string(), "weights are written as .npy; the name must end so");
    }
    if (output.extension() == ".npy") {
        throw InputError(output.string(), "for several models it must be a folder, which gets a .npy for each");
    }
    std::vector<fs::path> files;
    for (const fs::path& model : models) {
        files.push_back(output / model.stem().concat(".npy"));
        if (std::count(files.begin(), files.end(), files.back()) > 1) {
            throw InputError(model.string(), "another model has this name too, and the weights of both would be " +
                                                 files.back().string());
        }
    }
    return files;
}

/// Returns describeOrder() as a line for the terminal.
std::string orderLine(const fs::path& posedPath, std::size_t reordered, std::size_t frames)
{
    const std::string text = files::describeOrder(posedPath, reordered, frames);
    return text.empty() ? text : "  " + printable(text) + '\n';
}

/// Runs deform --compare.
int drawComparison(const fs::path& cagePath, const fs::path& posedPath, const fs::path& modelPath,
                   const fs::path& picture, const CoordinateArguments& arguments, const TalkArguments& talk)
{
    requirePngExtension(picture);
    const auto optionsOf = [&](Coordinates family) { return arguments.optionsOfEach(family); };
    optionsOf(coordinateFamilies().front().family); // throws before any file is read
    if (files::isPattern(posedPath))
        throw InputError("--compare is of one pose; POSED_CAGE must not have a frame number");
    Outputs outputs;
    for (const fs::path& input : {cagePath, posedPath, modelPath}) outputs.reads(input);
    outputs.writes(picture);
    std::optional<Progress> progress(talk.progressForm());
    std::string warnings;
    const Mesh cage = readMesh(cagePath, warnings);
    Mesh posed = readMesh(posedPath, warnings);
    const Mesh model = readMesh(modelPath, warnings);
    PosedPoints pose = files::posedPointsOf(posedPath, posed, cage);
    posed = cage;
    posed.points = std::move(pose.points);
    const auto ofModel = [&](Coordinates family) { return forModel(model, optionsOf(family)); };
    const FamilyComparison comparison =
        bindFiles(cagePath, modelPath, [&] { return compareFamilies(cage, posed, model, ofModel, &*progress); });
    const std::string bytes = encodePng(comparison.sheet);
    outputs.add(picture, [&](std::ostream& out) { out << bytes; });
    progress->succeed();
    progress.reset();
    std::cout << comparison.table;
    flushOutput();
    outputs.commit();
    if (talk.verbose()) std::cerr << warnings;
    if (!talk.quiet()) std::cerr << orderLine(posedPath, pose.reordered, 1);
    return exitGood;
}

} // namespace

int runBind(Call call)
{
    fs::path cagePath, output;
    std::vector<fs::path> modelPaths;
    CLI::App app("vdbcage bind CAGE MODEL... -o WEIGHTS.npy [OPTIONS]\n"
                 "Computes the weights by which the cage moves the model's points. For several\n"
                 "models WEIGHTS is a folder, which gets a .npy for each, by its name.\n"
                 "For vdbcage deform --weights, and for NumPy:\n"
                 "numpy.load(\"WEIGHTS.npy\")[\"weights\"] is float32, points x handles.",
                 "bind");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("models", modelPaths)->required()->type_name("MODEL...");
    app.add_option("-o,--output", output, "the weights to write")->required()->type_name("WEIGHTS");
    const CoordinateArguments arguments(app, CoordinateArguments::For::weights);
    const TalkArguments talk(app, "print warnings; progress without a terminal");
    if (!parse(app, std::move(call))) return exitGood;
    const CoordinateOptions coordinates = arguments.options();
    const std::vector<fs::path> files = weightsFiles(output, modelPaths);
    Outputs outputs;
    outputs.reads(cagePath);
    for (const fs::path& model : modelPaths) outputs.reads(model);
    if (files.size() > 1) outputs.writesInto(output);
    for (const fs::path& file : files) outputs.writes(file);

    std::optional<Progress> progress(talk.progressForm());
    std::string warnings;
    const Mesh cage = readMesh(cagePath, warnings);
    const std::size_t handles = handleCount(cage, coordinates.family);
    std::string text;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const Mesh model = readMesh(modelPaths[i], warnings);
        const CoordinateOptions ofModel = forModel(model, coordinates);
        const std::vector<float> weights =
            bindFiles(cagePath, modelPaths[i], [&] { return computeWeights(cage, model.points, ofModel, &*progress); });
        outputs.add(files[i], [&](std::ostream& out) {
            writeWeights(cage, model.points, coordinates.family, weights, out, files[i]);
        });
        text += printable(files[i]) + ": " + std::to_string(model.points.size()) + " points, " +
                std::to_string(handles) + " handles, " + coordinatesName(coordinates.family) + '\n' +
                describeLoose(modelPaths[i], ofModel) + describeFit(cage, model, &*progress);
    }
    outputs.commit();
    progress->succeed();
    progress.reset();
    if (talk.verbose()) text += warnings;
    if (!talk.quiet()) std::cerr << text;
    return exitGood;
}

int runDeform(Call call)
{
    fs::path cagePath, posedPath, modelPath, output, weights;
    bool inversions = false, compare = false;
    CLI::App app("vdbcage deform CAGE POSED_CAGE MODEL -o OUT [OPTIONS]\n"
                 "Moves the model as its cage moved. A sequence has the frame's number in the\n"
                 "names of POSED_CAGE and OUT: cage.%04d.obj. In the format of MODEL all stays\n"
                 "as it was but positions and normals. With --compare OUT is a picture (.png).",
                 "deform");
    app.add_option("cage", cagePath)->required()->type_name("CAGE");
    app.add_option("posed", posedPath)->required()->type_name("POSED_CAGE");
    app.add_option("model", modelPath)->required()->type_name("MODEL");
    app.add_option("-o,--output", output, "the posed model to write")->required()->type_name("OUT");
    const CoordinateArguments arguments(app, CoordinateArguments::For::poses);
    app.add_option("--weights", weights, "of bind, or a matrix (.npy, .dmat) [computed]")->type_name("WEIGHTS");
    app.add_flag("--inversions", inversions, "print how many triangles each pose inverts");
    app.add_flag("--compare", compare, "draw all families, and print their distortion");
    const TalkArguments talk(app, "print warnings; progress without a terminal");
    if (!parse(app, std::move(call))) return exitGood;
    if (compare) {
        if (!weights.empty() || arguments.familyIsGiven() || inversions) {
            throw InputError("--compare shows all families, and inversions too; it does not go with --weights, "
                             "--coordinates or --inversions");
        }
        return drawComparison(cagePath, posedPath, modelPath, output, arguments, talk);
    }
    const Coordinates family = coordinatesNamed(arguments.familyName());
    std::optional<CoordinateOptions> computed;
    if (weights.empty()) {
        computed = arguments.options();
    } else if (arguments.resolutionIsGiven()) {
        throw InputError("--resolution is of weights that are computed; it does not go with --weights");
    }
    detail::requireMeshExtension(output);
    if (files::isPattern(posedPath) != files::isPattern(output)) {
        throw InputError("POSED_CAGE and OUT", "both or none must have a frame number, as in cage.%04d.obj");
    }
    const std::vector<files::Frame> frames = files::findFrames(posedPath);
    Outputs outputs;
    for (const fs::path& input : {cagePath, modelPath, weights}) {
        if (!input.empty()) outputs.reads(input);
    }
    for (const files::Frame& frame : frames) outputs.reads(frame.path);
    for (const files::Frame& frame : frames) outputs.writes(files::framePath(output, frame.number));

    std::optional<Progress> progress(talk.progressForm());
    std::string warnings;
    const Mesh cage = readMesh(cagePath, warnings), model = readMesh(modelPath, warnings);
    if (computed) computed = forModel(model, *computed);
    Binding binding = weights.empty() ? bindFiles(cagePath, modelPath,
                                                  [&] { return Binding(cage, model.points, *computed, &*progress); })
                                      : readWeights(weights, cage, model.points);
    if (binding.family() == Coordinates::given) {
        const std::string made = weights.string() + ": its weights were made elsewhere; ";
        if (arguments.familyIsGiven()) {
            throw InputError(made + "they do not go with --coordinates " + arguments.familyName());
        }
        if (inversions) {
            throw InputError(made + "--inversions needs coordinates that can be computed at other points, as those of "
                                    "vdbcage bind");
        }
    }
    if (!weights.empty() && arguments.familyIsGiven() && binding.family() != family) {
        throw InputError(weights.string(), std::string("has ") + coordinatesName(binding.family()) +
                                               " coordinates; --coordinates asks for " + arguments.familyName());
    }
    const std::string fit = weights.empty() ? describeFit(cage, model, &*progress) : "";
    if (!weights.empty()) binding = binding.with(arguments.optionsOf(binding.family()).elasticity);
    std::vector<std::vector<openvdb::Vec3d>> poses; // kept for the printed text
    std::size_t reordered = 0;
    for (const files::Frame& frame : frames) {
        PosedPoints pose = files::posedPointsOf(frame.path, readMesh(frame.path, warnings), cage);
        const std::vector<openvdb::Vec3d> points = binding.pose(pose.points);
        reordered += pose.reordered;
        const fs::path path = files::framePath(output, frame.number);
        outputs.add(path, [&](std::ostream& out) { writeMoved(modelPath, points, out, path); });
        if (inversions) poses.push_back(std::move(pose.points));
    }
    const std::string report = inversions ? describeInversions(binding, model, frames, poses, &*progress) : "";
    progress->succeed();
    progress.reset();
    std::cout << report;
    flushOutput();
    std::string text = printable(output) + ": " + std::to_string(frames.size()) +
                       (frames.size() == 1 ? " pose" : " poses") + " of " + std::to_string(model.points.size()) +
                       " points\n" + orderLine(posedPath, reordered, frames.size()) + fit;
    if (computed) text += describeLoose(modelPath, *computed);
    if (talk.verbose()) text += warnings;
    outputs.commit();
    if (!talk.quiet()) std::cerr << text;
    return exitGood;
}

} // namespace vdbcage::cli
