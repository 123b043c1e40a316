#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include <tools/draw/picture.h>
#include <tools/view/jobs/cage_result.h>
#include <tools/view/posing/bound_model.h>
#include <tools/view/state/time_line.h>
#include <vdbcage/deform/binding.h>

/// The window's files beside scenes, as those of the command `make`. Each file appears completely or not at all.
namespace vdbcage::view {

/// Writes the cage. \throw InputError the window claims more of the cage than the file can hold; IoError; Cancelled
void saveCage(const CageResult& result, const std::filesystem::path& path, Interrupter* interrupter);
/// Writes the options for `preset FILE`. \throw IoError
void saveOptions(const CageOptions& options, const std::filesystem::path& path);
/// Writes the report as make --report does. \throw IoError
void saveReport(const CageResult& result, const std::filesystem::path& path);
/// Writes the stages as make --stages does; all files appear or none. \pre result.intermediates \throw IoError
void saveStages(const CageResult& result, const std::filesystem::path& folder);

/// A model posed by its cage, and the range of frames to save. A value, for any thread.
struct PosedScene {
    BindOrder order;
    std::shared_ptr<const Binding> binding; ///< null: it is computed when needed
    Elasticity elasticity;
    TimeLine poses;
    PosableCage cage;        ///< of `order`
    int first = 0, last = 0; ///< frames
};
/// Writes the posed cages. \throw InputError, IoError, Cancelled
void savePosedCages(PosedScene scene, const std::filesystem::path& path, Interrupter* interrupter);
/// Writes the posed models as the command deform does. `path` has a place for the number of the frame, such as %04d, if
/// there are several. All files appear or none. \throw InputError, IoError, Cancelled
void savePosedModels(PosedScene scene, const std::filesystem::path& path, Interrupter* interrupter);
/// Computes the weights and writes them as the command bind does. \throw InputError the name does not end in .npy, or
/// as computeWeights; IoError; Cancelled
void saveWeights(const BindOrder& order, const std::filesystem::path& path, Interrupter* interrupter);
/// Writes the model with its points at `points`, and colours that show one value for each (see draw::divergingColours).
/// \throw InputError the name does not end in .ply; IoError
void saveColours(const Mesh& model, const std::vector<openvdb::Vec3d>& points, const std::vector<double>& values,
                 const std::filesystem::path& path);

/// \throw InputError the name does not end in .png; IoError
void savePicture(const draw::Picture& picture, const std::filesystem::path& path);

} // namespace vdbcage::view
