#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <tools/draw/picture.h>
#include <tools/view/jobs/cage_result.h>
#include <tools/view/state/bound_model.h>
#include <tools/view/state/time_line.h>
#include <vdbcage/deform/binding.h>

/// What the window writes beside cages and scenes, as the command `make` does. Each file appears whole or not at all.
namespace vdbcage::view {

/// \throw InputError the window says more of the cage than holds of what the file can have of it; IoError; Cancelled
void saveCage(const CageResult& result, const std::filesystem::path& path, Interrupter* interrupter);
/// For `preset FILE`. \throw IoError
void saveOptions(const CageOptions& options, const std::filesystem::path& path);
/// As make --report. \throw IoError
void saveReport(const CageResult& result, const std::filesystem::path& path);
/// As make --stages; all files appear or none. \pre result.intermediates \throw IoError
void saveStages(const CageResult& result, const std::filesystem::path& folder);

/// What is saved of a model that its cage poses. A value, to be saved on any thread.
struct PosedScene {
    BindOrder order;
    std::shared_ptr<const Binding> binding; ///< null: it is computed when it is needed
    Elasticity elasticity;
    TimeLine poses;
    PosableCage cage;        ///< that of `order`
    int first = 0, last = 0; ///< frames
};
/// The posed cages. \throw InputError, IoError, Cancelled
void savePosedCages(PosedScene scene, const std::filesystem::path& path, Interrupter* interrupter);
/// The posed models, as the command deform. `path` has a place for the number of the frame, as %04d, if there are more
/// than one. All files appear or none. \throw InputError, IoError, Cancelled
void savePosedModels(PosedScene scene, const std::filesystem::path& path, Interrupter* interrupter);
/// As the command bind; the weights are computed here. \throw InputError the name does not end in .npy, or as
/// computeWeights; IoError; Cancelled
void saveWeights(const BindOrder& order, const std::filesystem::path& path, Interrupter* interrupter);
/// The model with its points at `points`, and colours that tell one value for each (see draw::divergingColours).
/// \throw InputError the name does not end in .ply; IoError
void saveColours(const Mesh& model, const std::vector<openvdb::Vec3d>& points, const std::vector<double>& values,
                 const std::filesystem::path& path);

/// \throw InputError the name does not end in .png; IoError
void savePicture(const draw::Picture& picture, const std::filesystem::path& path);

} // namespace vdbcage::view
