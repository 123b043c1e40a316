#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vdbcage::files {

/// The number of a frame, and its file by a pattern. A path that is no pattern has one frame, of number 0.
struct Frame {
    long number;
    std::filesystem::path path;
};

/// Returns whether the file name has a place for a frame's number, such as %04d: at least four digits, with leading
/// zeros; or %d.
/// \throw InputError if it has more than one
bool isPattern(const std::filesystem::path& path);

/// Returns the path with a place for the frame's number before its extension, such as walk.%04d.obj, unless it has one.
/// \throw InputError as isPattern
std::filesystem::path patternFor(const std::filesystem::path& path);

/// Returns the existing files of a pattern, by number; the path itself if it is none. \throw IoError if there are none
std::vector<Frame> findFrames(const std::filesystem::path& pattern);

/// Returns the number of existing files, which may be 0. \pre it is a pattern
std::size_t countFrames(const std::filesystem::path& pattern);

/// Returns the path of a frame of a pattern; the path itself if it is none.
std::filesystem::path framePath(const std::filesystem::path& pattern, long number);

} // namespace vdbcage::files
