#include <tools/files/stages.h>

#include <algorithm>
#include <map>

#include <vdbcage/core/detail/number_text.h>
#include <vdbcage/mesh/mesh_io.h>
#include <vdbcage/volume/boundary_voxels.h>
#include <vdbcage/volume/morphology.h>
#include <vdbcage/volume/vdb_io.h>

namespace vdbcage::files {

namespace fs = std::filesystem;

namespace {

constexpr std::array<const char*, 4> volumeNames{"solid", "dilated", "closed", "contour"};
constexpr std::array<const char*, 3> surfaceNames{"surface", "smoothed", "decimated"};

fs::path volumeFile(const fs::path& folder, const char* name)
{
    return folder / (std::string(name) + ".vdb");
}

fs::path surfaceFile(const fs::path& folder, const char* name)
{
    return folder / (std::string(name) + ".obj");
}

} // namespace

std::vector<fs::path> stageFiles(const fs::path& folder)
{
    std::vector<fs::path> files;
    for (const char* name : volumeNames) files.push_back(volumeFile(folder, name));
    for (const char* name : surfaceNames) files.push_back(surfaceFile(folder, name));
    return files;
}

void writeStages(const Stages& stages, const fs::path& folder,
                 const std::function<void(const fs::path&, const FileWriter&)>& add, Interrupter* interrupter)
{
    std::map<std::string, std::string> metadata{{"source", stages.source}};
    for (const auto& option : optionValues(stages.options)) {
        std::string key = option.first;
        std::replace(key.begin(), key.end(), '-', '_');
        metadata["option_" + key] = option.second;
    }
    const CageReport& report = stages.report; // the values that vdbcage chose by itself
    metadata["resolution"] = std::to_string(report.resolution);
    metadata["close_radius"] = detail::numberText(report.closeRadius);
    metadata["erode_radius"] = detail::numberText(report.erodeRadius);
    const double radius = report.closeRadius * report.resolution;
    const auto dilated = stages.options.element == StructuringElement::cube
                             ? dilate(stages.solid, radius, StructuringElement::cube, interrupter)
                             : dilate(stages.solid, radius, stages.options.scale, interrupter);
    const auto border = contour(stages.closed, interrupter);
    const std::array<const openvdb::MaskGrid*, volumeNames.size()> volumes{&stages.solid, dilated.get(), &stages.closed,
                                                                           border.get()};
    const std::array<const Mesh*, surfaceNames.size()> surfaces{&stages.surface, &stages.smoothed, &stages.decimated};
    for (std::size_t i = 0; i < volumes.size(); ++i) {
        metadata["stage"] = volumeNames[i];
        const fs::path path = volumeFile(folder, volumeNames[i]);
        add(path, [&](std::ostream& out) { writeVdb(*volumes[i], out, path, metadata); });
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const fs::path path = surfaceFile(folder, surfaceNames[i]);
        add(path, [&](std::ostream& out) { writeMesh(*surfaces[i], out, path); });
    }
}

} // namespace vdbcage::files
