#pragma once

#include <filesystem>
#include <string>

#include <tools/view/state/state.h>

/// Poses from files. They pose the shown cage: each function throws InputError if there is none.
namespace vdbcage::view {

/// Sets the pose of the view's frame to that of the posed cage at `path`. `remark` gets a note for the user if points
/// were put into the order of the cage.
/// \throw InputError, IoError naming the file: as posedPoints
Document withOpenedPose(const State& state, const PosableCagePtr& cage, const std::filesystem::path& path,
                        std::string* remark = nullptr);

/// Replaces all poses by those of a sequence, or of a file of parameters (.param).
///
/// A sequence is a pattern such as walk.%04d.obj, or one of its files: the last number in the name is then the frame's.
/// Each file is a key at its frame.
///
/// A file of parameters has only numbers, between blanks: the least factor, the largest factor, a count, and that many
/// times a point of the cage, from 0, and its displacement, x y z. The pose at the first of `frames` frames has the
/// displacements times the least factor, the last one times the largest. (CageModeler reads this.)
/// \throw InputError, IoError naming the file, the value and the allowed values
Document withOpenedPoses(const State& state, const PosableCagePtr& cage, const std::filesystem::path& path, int frames,
                         std::string* remark = nullptr);

/// Returns the pattern of the file `path`: its last number becomes %0Nd, with as many digits, if it begins with 0, and
/// else the one of %0Nd and %d that more files match. Returns `path` if it is a pattern, or its name has no number.
std::filesystem::path patternOf(const std::filesystem::path& path);

} // namespace vdbcage::view
