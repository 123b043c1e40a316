#include <tools/view/saving.h>

#include <string>
#include <system_error>

#include <tools/report/report.h>
#include <tools/report/stages.h>
#include <tools/view/state/preset.h>
#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/error.h>
#include <vdbcage/deform/weights_io.h>

namespace vdbcage::view {

namespace fs = std::filesystem;

namespace {

void saveText(const std::string& text, const fs::path& path)
{
    writeFileAtomically(path, [&](std::ostream& out) { out << text; });
}

} // namespace

void saveOptions(const CageOptions& options, const fs::path& path)
{
    saveText(presetText(options), path);
}

void saveReport(const CageResult& result, const fs::path& path)
{
    const OpenedMesh& model = *result.order.model;
    const tool::CageMade made{tool::toJson(model.mesh, model.summary, model.path),
                              {},
                              result.order.options,
                              result.seconds,
                              result.stages,
                              result.report};
    saveText(tool::toText(tool::toJson(made)), path);
}

void saveStages(const CageResult& result, const fs::path& folder)
{
    const Intermediates& inner = *result.intermediates;
    std::error_code error;
    const bool isNew = fs::create_directory(folder, error);
    if (error) throw IoError(folder.string() + ": the folder cannot be made: " + error.message());
    try {
        PendingFiles files;
        tool::writeStages(
            {result.order.model->path.filename().string(), result.order.options, result.report, *inner.solid,
             *inner.closed, inner.surface, inner.smoothed, inner.decimated},
            folder, [&](const fs::path& file, const FileWriter& write) { files.add(file, write); }, nullptr);
        files.commit();
    } catch (...) {
        if (isNew) fs::remove(folder, error);
        throw;
    }
}

void saveWeights(const Mesh& cage, const OpenedMesh& model, Coordinates family, const std::filesystem::path& path)
{
    if (path.extension() != ".npy") throw InputError(path.string() + ": weights are written as .npy");
    const std::vector<openvdb::Vec3d>& points = model.mesh.points;
    writeWeights(cage, points, family, computeWeights(cage, points, family), path);
}

void savePicture(const draw::Picture& picture, const fs::path& path)
{
    if (path.extension() != ".png") throw InputError(path.string() + ": pictures are written as .png");
    saveText(draw::encodePng(picture), path);
}

} // namespace vdbcage::view
