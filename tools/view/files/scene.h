#pragma once

#include <cstddef>
#include <filesystem>

#include <tools/view/jobs/cage_result.h>

/// Scenes: the whole state in one JSON file. It has the options, the view as commands, and the names and digests of the
/// files of the model and the cage. A cage that was made or edited lies beside it as NAME.cage.obj. Poses lie there as
/// NAME.pose.FRAME.obj, and the cages at rest that they belong to as NAME.rest.obj, NAME.rest.1.obj and so on.
namespace vdbcage::view {

/// Writes the state, and the cage that was made for it; `current` is null if there is none. All files appear together
/// or none does. The same state makes the same bytes.
/// \throw InputError there is no model, or the name does not end in .json; IoError
void saveScene(const State& state, const CageResult* current, const std::filesystem::path& path);

/// Returns the state of a scene. A cage that was made is to be made again.
/// \throw InputError, IoError naming the file: the scene or one of its files is gone, is no such file, or changed
State openScene(const std::filesystem::path& path);

/// Return the files in which saveScene puts the cage, the cages at rest of poses, and the posed cage of a frame.
std::filesystem::path cageBeside(const std::filesystem::path& scene);
std::filesystem::path restBeside(const std::filesystem::path& scene, std::size_t number);
std::filesystem::path poseBeside(const std::filesystem::path& scene, int frame);

} // namespace vdbcage::view
