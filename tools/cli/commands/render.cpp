#include <algorithm>
#include <charconv>
#include <iostream>
#include <map>

#include <tools/cli/models.h>
#include <tools/draw/diverging_colours.h>
#include <vdbcage/core/detail/grids.h>
#include <vdbcage/core/error.h>
#include <vdbcage/core/range.h>
#include <vdbcage/deform/binding.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/volume/extract.h>
#include <vdbcage/volume/vdb_io.h>

#include <tools/cli/arguments/coordinate_arguments.h>
#include <tools/cli/commands.h>
#include <tools/cli/drawing.h>
#include <tools/cli/outputs.h>

namespace vdbcage::cli {

namespace {

namespace fs = std::filesystem;

struct Size {
    int width, height;
};

Size parseSize(const std::string& text)
{
    Size size{};
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool separated = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = separated ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!separated || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1 ||
        size.width > maximumPictureSize || size.height > maximumPictureSize) {
        throw InputError("--size", "'" + text + "' is not allowed; it must be WIDTHxHEIGHT, each 1 to " +
                                       std::to_string(maximumPictureSize));
    }
    return size;
}

/// Colours the models of a panel by the weights of point `vertex` of the first cage.
void colourByInfluence(std::vector<Layer>& panel, int vertex, const CoordinateOptions& coordinates)
{
    const auto cageLayer = std::find_if(panel.begin(), panel.end(),
                                        [](const Layer& layer) { return layer.style == LayerStyle::wireframe; });
    if (cageLayer == panel.end()) throw InputError("--influence", "a panel needs a model and its cage");
    const Mesh& cage = *cageLayer->mesh;
    if (vertex < 0 || static_cast<std::size_t>(vertex) >= cage.points.size()) {
        throw InputError("--influence", std::to_string(vertex) + " is not a vertex of the cage; 0 to " +
                                            std::to_string(cage.points.size() - 1) + " are");
    }
    for (auto layer = panel.begin(); layer != cageLayer; ++layer) {
        const Mesh& model = *layer->mesh;
        const std::vector<double> rows = computeCoordinates(cage, model.points, coordinates);
        const std::size_t handles = rows.size() / model.points.size();
        std::vector<double> weights;
        for (std::size_t i = 0; i < model.points.size(); ++i) {
            weights.push_back(rows[i * handles + static_cast<std::size_t>(vertex)]);
        }
        layer->colour = {1, 1, 1};
        layer->pointColours = draw::divergingColours(weights);
    }
}

/// A file of a panel. A lone + joins it to the one before: both are drawn in the same way.
struct PanelFile {
    std::string name;
    bool isJoined = false;
};

/// Returns the files of each panel, from words with a lone / between panels.
std::vector<std::vector<PanelFile>> panelsOf(const std::vector<std::string>& words)
{
    std::vector<std::vector<PanelFile>> panels(1);
    const InputError wrongPlus("a lone + must stand between two files: FILE + FILE");
    bool isJoined = false; // a + came, and no file yet
    for (const std::string& word : words) {
        if (word != "/" && word != "+") {
            panels.back().push_back({word, isJoined});
            isJoined = false;
            continue;
        }
        if (isJoined || (word == "+" && panels.back().empty())) throw wrongPlus;
        if (word == "/") panels.emplace_back();
        isJoined = word == "+";
    }
    if (isJoined) throw wrongPlus;
    for (const auto& panel : panels) {
        if (panel.empty()) throw InputError("a panel has no file; write FILE... / FILE...");
    }
    return panels;
}

/// Returns the surface of a volume; an objection to it names its file.
Mesh readVoxels(const fs::path& path)
{
    const openvdb::MaskGrid::Ptr mask = readVdb(path);
    try {
        Mesh surface = extractSurface(*mask);
        if (faceCount(surface) == 0) throw InputError("it has no active voxels; at least one is needed");
        return surface;
    } catch (const InputError& error) {
        throw InputError(path.string(), error.what());
    }
}

} // namespace

int runRender(Call call)
{
    std::vector<std::string> files;
    fs::path picture;
    std::string sizeText = "1200x900";
    Scene scene;
    CLI::App app("vdbcage render FILE... [/ FILE...] -o PICTURE.png [OPTIONS]\n"
                 "Draws models shaded, cages as wireframes over them, .vdb volumes as voxels.\n"
                 "In each panel the first file is the model; a lone / begins the next panel.\n"
                 "A lone + has the next file drawn as the one before it: body.obj + hair.obj",
                 "render");
    app.add_option("files", files)->required()->type_name("FILE...");
    app.add_option("-o,--output", picture, "the picture to write")->required()->type_name("PICTURE.png");
    app.add_option("--size", sizeText, "in pixels [1200x900]")->type_name("WIDTHxHEIGHT");
    app.add_option("--columns", scene.columns, "panels side by side, 0 to 100 [0: as fits]")->type_name("N");
    app.add_option("--azimuth", scene.view.azimuthDegrees, "to the right of the front, -360 to 360 [35]")
        ->type_name("DEG");
    app.add_option("--elevation", scene.view.elevationDegrees, "above the horizon, -90 to 90 [18]")->type_name("DEG");
    int vertex = 0;
    CLI::Option* influence =
        app.add_option("--influence", vertex, "colour models by a cage vertex's weight")->type_name("VERTEX");
    const CoordinateArguments arguments(app, CoordinateArguments::For::weights, "of the weight");
    app.add_flag("--same-view", scene.sameView, "one scale and place for all panels");
    bool isVerbose = false;
    app.add_flag("-v,--verbose", isVerbose, "print warnings of oddities in the files");
    if (!parse(app, std::move(call))) return exitGood;
    requireWithin({0, 100}, scene.columns, "--columns");
    requireWithin({-360, 360}, scene.view.azimuthDegrees, "--azimuth");
    requireWithin({-90, 90}, scene.view.elevationDegrees, "--elevation");
    requirePngExtension(picture);
    Outputs outputs;
    const std::vector<std::vector<PanelFile>> panels = panelsOf(files);
    for (const std::vector<PanelFile>& panel : panels) {
        for (const PanelFile& file : panel) outputs.reads(file.name);
    }
    outputs.writes(picture);
    const Size size = parseSize(sizeText);
    const CoordinateOptions coordinates = arguments.options();

    std::string warnings;
    std::map<std::string, Mesh> meshes; // by file: many panels can show the same model; layers point at them
    for (const std::vector<PanelFile>& panelFiles : panels) {
        std::vector<Layer>& panel = scene.panels.emplace_back();
        for (const PanelFile& file : panelFiles) {
            const bool voxels = fs::path(file.name).extension() == ".vdb";
            const auto [known, isNew] = meshes.try_emplace(file.name);
            Mesh& mesh = known->second;
            if (isNew) mesh = voxels ? readVoxels(file.name) : readMesh(file.name, warnings);
            const bool isModel = panel.empty() || (file.isJoined && panel.back().style == LayerStyle::shaded);
            panel.push_back(voxels ? voxelsLayer(mesh) : isModel ? shadedLayer(mesh) : wireframeLayer(mesh));
        }
    }
    if (influence->count() > 0) {
        for (auto& panel : scene.panels) colourByInfluence(panel, vertex, coordinates);
    }
    const std::string bytes = encodePng(renderScene(scene, size.width, size.height));
    outputs.add(picture, [&](std::ostream& out) { out << bytes; });
    outputs.commit();
    if (isVerbose) std::cerr << warnings;
    return exitGood;
}

} // namespace vdbcage::cli
