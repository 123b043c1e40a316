#pragma once

#include <filesystem>

#include <tools/draw/picture.h>
#include <tools/view/state/cage_result.h>
#include <vdbcage/deform/binding.h>

/// What the window writes beside cages and scenes, as the command `make` does. Each file appears whole or not at all.
namespace vdbcage::view {

/// For `preset FILE`. \throw IoError
void saveOptions(const CageOptions& options, const std::filesystem::path& path);
/// As make --report. \throw IoError
void saveReport(const CageResult& result, const std::filesystem::path& path);
/// As make --stages; all files appear or none. \pre result.intermediates \throw IoError
void saveStages(const CageResult& result, const std::filesystem::path& folder);
/// As the command bind; the weights are computed here. \throw InputError the name does not end in .npy, or as
/// computeWeights; IoError
void saveWeights(const Mesh& cage, const OpenedMesh& model, Coordinates family, const std::filesystem::path& path);
/// \throw InputError the name does not end in .png; IoError
void savePicture(const draw::Picture& picture, const std::filesystem::path& path);

} // namespace vdbcage::view
