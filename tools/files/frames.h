#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace vdbcage::files {

/// The number of a frame, and the file name that a pattern gives it. Without a pattern there is one frame, of number 0.
struct Frame {
    long number;
    std::filesystem::path path;
};

/// True if the file name has a place for a frame's number, as %04d: four digits at least, with zeros before; or %d.
/// \throw InputError if it has more than one
bool isPattern(const std::filesystem::path& path);

/// The path, with a place for the frame's number before its extension, as walk.%04d.obj, unless it has one.
/// \throw InputError as isPattern
std::filesystem::path patternFor(const std::filesystem::path& path);

/// The files that there are of a pattern, by number; the path itself if it is none. \throw IoError if there are none
std::vector<Frame> findFrames(const std::filesystem::path& pattern);

/// How many there are, 0 too. \pre it is a pattern
std::size_t countFrames(const std::filesystem::path& pattern);

/// The path of a frame of a pattern; the path itself if it is none.
std::filesystem::path framePath(const std::filesystem::path& pattern, long number);

} // namespace vdbcage::files
