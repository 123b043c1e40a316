#include <tools/view/files/file_contents.h>

#include <cmath>
#include <string>
#include <system_error>

#include <tools/draw/diverging_colours.h>
#include <tools/files/frames.h>
#include <tools/files/stages.h>
#include <tools/report/report.h>
#include <tools/view/state/preset.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/weights_io.h>
#include <vdbcage/mesh/io/formats.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/mesh/parts.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

void saveText(const std::string& text, const fs::path& path)
{
    writeFileAtomically(path, [&](std::ostream& out) { out << text; });
}

using Points = std::vector<openvdb::Vec3d>;

/// Writes a file for each frame; all appear or none.
template <class Write>
void saveFrames(PosedScene& scene, const fs::path& path, Interrupter* interrupter, const Write& write)
{
    const Stage stage(interrupter, StageName::write);
    PendingFiles files;
    for (int frame = scene.first; frame <= scene.last; ++frame) {
        throwIfInterrupted(interrupter, 100 * (frame - scene.first) / (scene.last - scene.first + 1));
        const std::vector<openvdb::Vec3d> points = pointsAt(scene.poses, frame, scene.cage);
        const fs::path file = files::framePath(path, frame);
        files.add(file, [&](std::ostream& out) { write(points, out, file); });
    }
    files.commit();
}

} // namespace

void saveCage(const CageResult& result, const fs::path& path, Interrupter* interrupter)
{
    const Mesh written = asWritten(result.cage, path);
    if (written.points != result.cage.points) {
        const CageCheck& said = result.report.check;
        CheckOptions options;
        options.measure = false;
        const Mesh& model = result.order.model->mesh;
        const double leastPart = result.order.options.leastPart;
        const CageCheck check = leastPart > 0
                                    ? checkCage(written, largeParts(model, leastPart).mesh, options, interrupter)
                                    : checkCage(written, model, options, interrupter);
        if (check.valid() < said.valid() || check.bounding() < said.bounding()) {
            throw InputError(path.string(),
                             path.extension().string() + " files hold float32, and so rounded " +
                                 (said.bounding() ? "the cage does not bound the model" : "it is no valid cage") +
                                 "; save it as .obj, .off or .ply, or make it with the precision float32");
        }
    }
    writeMesh(written, path);
}

void saveOptions(const CageOptions& options, const fs::path& path)
{
    saveText(presetText(options), path);
}

void saveReport(const CageResult& result, const fs::path& path)
{
    const OpenedMesh& model = *result.order.model;
    // No hash: the file may have changed.
    const report::Json facts = report::toJson(model.mesh, model.summary, model.path);
    const report::CageOrder order{{}, report::Json::array({facts}), "", "", result.order.options};
    const report::CageMade made{result.cage, "", result.seconds, result.stages, result.report};
    saveText(report::toText(report::reportOf(order, made)), path);
}

void saveStages(const CageResult& result, const fs::path& folder)
{
    const Intermediates& inner = *result.intermediates;
    std::error_code error;
    const bool isNew = fs::create_directory(folder, error);
    if (error) throw IoError(folder.string() + ": the folder cannot be made: " + error.message());
    try {
        PendingFiles files;
        files::writeStages(
            {result.order.model->path.filename().string(), result.order.options, result.report, *inner.solid,
             *inner.closed, inner.surface, inner.smoothed, inner.decimated},
            folder, [&](const fs::path& file, const FileWriter& write) { files.add(file, write); }, nullptr);
        files.commit();
    } catch (...) {
        if (isNew) fs::remove(folder, error);
        throw;
    }
}

void savePosedCages(PosedScene scene, const fs::path& path, Interrupter* interrupter)
{
    Mesh posed = *scene.order.cage;
    saveFrames(scene, path, interrupter, [&](const Points& points, std::ostream& out, const fs::path& file) {
        posed.points = points;
        writeMesh(posed, out, file);
    });
}

void savePosedModels(PosedScene scene, const fs::path& path, Interrupter* interrupter)
{
    detail::requireMeshExtension(path);
    if (!scene.binding) scene.binding = makeBinding(scene.order, interrupter);
    scene.binding = withMaterial(scene.binding, scene.elasticity);
    saveFrames(scene, path, interrupter, [&](const Points& points, std::ostream& out, const fs::path& file) {
        writeMoved(scene.order.model->path, scene.binding->pose(points), out, file);
    });
}

void saveWeights(const BindOrder& order, const fs::path& path, Interrupter* interrupter)
{
    if (path.extension() != ".npy") throw InputError(path.string(), "weights are written as .npy");
    const std::vector<openvdb::Vec3d>& points = order.model->mesh.points;
    const std::vector<float> weights = computeWeights(*order.cage, points, coordinateOptions(order), interrupter);
    writeWeights(*order.cage, points, order.family, weights, path);
}

void saveColours(const Mesh& model, const std::vector<openvdb::Vec3d>& points, const std::vector<double>& values,
                 const fs::path& path)
{
    if (path.extension() != ".ply") throw InputError(path.string(), "colours are written as .ply");
    Mesh coloured = model;
    coloured.points = points;
    std::vector<PointColour> colours;
    colours.reserve(values.size());
    for (const draw::Colour& colour : draw::divergingColours(values)) {
        PointColour& bytes = colours.emplace_back();
        for (std::size_t k = 0; k < 3; ++k) bytes[k] = static_cast<std::uint8_t>(std::lround(255 * colour[k]));
    }
    writeFileAtomically(path, [&](std::ostream& out) { writeColouredPly(coloured, colours, out, path); });
}

void savePicture(const draw::Picture& picture, const fs::path& path)
{
    if (path.extension() != ".png") throw InputError(path.string(), "pictures are written as .png");
    saveText(draw::encodePng(picture), path);
}

} // namespace vdbcage::view
