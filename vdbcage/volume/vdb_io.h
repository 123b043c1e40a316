#pragma once

#include <filesystem>
#include <map>
#include <string>

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>

namespace vdbcage {

/// Writes `mask` as a .vdb that Blender, Houdini and others open as a volume: one FloatGrid named `density`, 1 in the
/// active voxels (sparse tiles kept), background 0, class fog volume, the mask's transform, creator "vdbcage VERSION".
/// Each entry of `metadata` becomes a string named `vdbcage_KEY`. Written atomically (see core/atomic_file.h).
/// \throw IoError
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// Reads a mask back: the grid named `density` (or the only grid of the file); float grids are active where the value
/// is above 0.5 (level sets: below 0), bool and mask grids where it is true and active. \throw IoError
VDBCAGE_API openvdb::MaskGrid::Ptr readVdb(const std::filesystem::path& path);

} // namespace vdbcage
