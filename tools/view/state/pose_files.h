#pragma once

#include <filesystem>
#include <string>

#include <tools/view/state/state.h>

/// Poses from files. What poses is the cage that is shown: each function throws InputError where there is none.
namespace vdbcage::view {

/// The pose of the view's frame is that of the posed cage at `path`. `remark` gets what the user is to know of it: that
/// points were put into the order of the cage.
/// \throw InputError, IoError naming the file: as posedPoints
Document withOpenedPose(const State& state, const ShownCage& cage, const std::filesystem::path& path,
                        std::string* remark = nullptr);

/// The poses of a sequence, or of a file of parameters (.param), in place of all that were there.
///
/// A sequence is a pattern such as walk.%04d.obj, or one of its files: the last number in the name is then that of the
/// frame. Each file is a key at its frame.
///
/// A file of parameters has numbers only, between blanks: the least factor, the largest factor, a count, and so many
/// times a point of the cage, from 0, and by what it moves, x y z. The pose at the first of `frames` frames has the
/// least factor times that, the last one the largest. (This is what CageModeler reads.)
/// \throw InputError, IoError naming the file, the value and what is allowed
Document withOpenedPoses(const State& state, const ShownCage& cage, const std::filesystem::path& path, int frames,
                         std::string* remark = nullptr);

/// The pattern of which `path` is a file: its last number becomes %0Nd, of as many digits, if it begins with 0, and
/// else that or %d, of which there are more files. The path itself if it is a pattern, or its name has no number.
std::filesystem::path patternOf(const std::filesystem::path& path);

} // namespace vdbcage::view
