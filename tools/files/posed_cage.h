#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include <vdbcage/deform/posed_points.h>

namespace vdbcage::files {

/// Returns posedPoints() of the cage that was read from `path`. \throw InputError as posedPoints, naming the file
PosedPoints posedPointsOf(const std::filesystem::path& path, const Mesh& posed, const Mesh& cage);

/// Returns a note that the points of `reordered` of the read poses were put into the order of the cage. Empty if there
/// are none. `path` is the file, or the pattern of all `frames` files.
std::string describeOrder(const std::filesystem::path& path, std::size_t reordered, std::size_t frames);

} // namespace vdbcage::files
