#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include <vdbcage/deform/posed_points.h>

namespace vdbcage::files {

/// What the library objects to one of its arguments, as "cage: it faces inward", with the name of the file that this
/// was read from: `files` has it by the argument. Any other text stays as it is.
std::string namingFile(const std::string& text, const std::map<std::string, std::filesystem::path>& files);

/// posedPoints() of the cage that was read from `path`. \throw InputError as posedPoints, naming the file
PosedPoints posedPointsOf(const std::filesystem::path& path, const Mesh& posed, const Mesh& cage);

/// What users are to know of poses that were read: that of `reordered` of these files the points were put into the
/// order of the cage. Empty if there are none. `path` is the file, or the pattern of all `frames` files.
std::string describeOrder(const std::filesystem::path& path, std::size_t reordered, std::size_t frames);

} // namespace vdbcage::files
