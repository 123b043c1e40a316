#pragma once

#include <filesystem>

#include <tools/draw/picture.h>
#include <tools/view/state/cage_result.h>

/// What the window writes beside cages and scenes, as the command `make` does. Each file appears whole or not at all.
namespace vdbcage::view {

/// For `preset FILE`. \throw IoError
void saveOptions(const CageOptions& options, const std::filesystem::path& path);
/// As make --report. \throw IoError
void saveReport(const CageResult& result, const std::filesystem::path& path);
/// As make --stages; all files appear or none. \pre result.intermediates \throw IoError
void saveStages(const CageResult& result, const std::filesystem::path& folder);
/// \throw InputError the name does not end in .png; IoError
void savePicture(const draw::Picture& picture, const std::filesystem::path& path);

} // namespace vdbcage::view
