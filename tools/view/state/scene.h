#pragma once

#include <filesystem>

#include <tools/view/state/cage_result.h>

/// Scenes: all that one works on in one JSON file. It has the options, the view as commands, and names the files of the
/// model and the cage, with digests. A cage that was made or edited lies beside it, as NAME.cage.obj. A pose lies there
/// as NAME.pose.obj, and the cage at rest that it belongs to as NAME.rest.obj.
namespace vdbcage::view {

/// Writes the state, and the cage that was made for it; `current` is null if there is none. All files appear together
/// or none does. The same state gives the same bytes.
/// \throw InputError there is no model, or the name does not end in .json; IoError
void saveScene(const State& state, const CageResult* current, const std::filesystem::path& path);

/// The state of a scene. Its cage, if it was made, is to be made again.
/// \throw InputError, IoError naming the file: the scene or one of its files is gone, is no such file, or changed
State openScene(const std::filesystem::path& path);

/// Where saveScene puts the cage, the cage at rest of a pose, and the posed one.
std::filesystem::path cageBeside(const std::filesystem::path& scene);
std::filesystem::path restBeside(const std::filesystem::path& scene);
std::filesystem::path poseBeside(const std::filesystem::path& scene);

} // namespace vdbcage::view
