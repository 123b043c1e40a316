#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <vdbcage/core/detail/atomic_file.h>
#include <vdbcage/core/grids.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/pipeline/pipeline.h>

namespace vdbcage::files {

/// The volumes and surfaces between the stages of a cage. None is owned.
struct Stages {
    std::string source; ///< the name of the model's file, for metadata
    const CageOptions& options;
    const CageReport& report;
    const openvdb::MaskGrid& solid;
    const openvdb::MaskGrid& closed;
    const Mesh& surface;
    const Mesh& smoothed;
    const Mesh& decimated;
};

/// Returns the files that writeStages makes in `folder`: solid, dilated, closed and contour (.vdb), surface, smoothed
/// and decimated (.obj).
std::vector<std::filesystem::path> stageFiles(const std::filesystem::path& folder);

/// Passes each of these files to `add`, in their order. \throw Cancelled, and all that `add` throws
void writeStages(const Stages& stages, const std::filesystem::path& folder,
                 const std::function<void(const std::filesystem::path&, const FileWriter&)>& add,
                 Interrupter* interrupter);

} // namespace vdbcage::files
