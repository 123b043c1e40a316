#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include <openvdb/openvdb.h>
#include <vdbcage/core/export.h>

namespace vdbcage {

/// Writes `mask` as a .vdb that Blender, Houdini and others open as a volume: one FloatGrid named `density`, 1 in the
/// active voxels (tiles stay tiles), background 0, class fog volume, the mask's transform, creator "vdbcage VERSION",
/// compressed as OpenVDB does by default. Each entry of `metadata` becomes a string of the grid named `vdbcage_KEY`.
/// The file appears whole or not at all (see core/atomic_file.h); equal grids need not give equal bytes (each file gets
/// a UUID). Cost: 2 KiB of memory for each leaf node while it is written. \throw IoError naming the path
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// The same to a stream that can seek, whose state tells whether it took all; `path` is the name in errors.
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, std::ostream& out, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// Reads a mask from a .vdb: its grid named `density` (the first of them) or else its only grid. A voxel is active
/// where a float or double grid is above 0.5 (where its class is level set: below 0), whatever its active state, and
/// where a bool or mask grid is both true and active. The grid's transform is kept, metadata is not.
/// \throw IoError naming the path: cannot be read, not a .vdb, truncated or damaged, no grid `density` among several
///        or none at all, a grid of another type, a grid whose background is inside (it fills all of space)
VDBCAGE_API openvdb::MaskGrid::Ptr readVdb(const std::filesystem::path& path);

/// Reads a FloatGrid from a .vdb: its grid of this name (the first of them) or else its only grid.
/// \throw IoError naming the path, as readVdb
VDBCAGE_API openvdb::FloatGrid::Ptr readFloatGrid(const std::filesystem::path& path, const std::string& gridName);

} // namespace vdbcage
