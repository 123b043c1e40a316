#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>

namespace vdbcage {

/// Writes `mask` as a .vdb that Blender, Houdini and others open as a volume.
///
/// It has one FloatGrid named `density`, 1 in the active voxels, background 0, class fog volume. Tiles stay tiles. The
/// grid has the mask's transform and the creator "vdbcage VERSION", and is compressed as OpenVDB does by default. Each
/// entry of `metadata` becomes a string of the grid named `vdbcage_KEY`.
///
/// The file appears whole or not at all (see core/detail/atomic_file.h). Equal grids need not give equal bytes, as each
/// file gets a UUID.
/// \throw IoError naming the path
/// Cost: 2 KiB of memory for each leaf node while it is written.
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// writeVdb() to a stream that can seek, whose state tells whether it took all. `path` is the name in errors.
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, std::ostream& out, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// Reads a mask from a .vdb: its first grid named `density`, or else its only grid.
///
/// A voxel is active where a float or double grid is above 0.5 (where its class is level set: below 0), whatever its
/// active state. Of a bool or mask grid it is active where the grid is both true and active. The grid's transform is
/// kept, metadata is not.
///
/// The file need not be trusted. OpenVDB's reader, which in 10.0.1 can be made to write over the heap, is not used.
/// Memory is at most 80 times the file's size plus 2 MiB. Tiles of little memory can be as large as space, though.
///
/// Files of versions 222 (2013) to 225 of the format can be read, and trees of levels 5, 4 and 3. In a file without
/// offsets (a streamed one) the grids before the wanted one must be of types that can be read too.
/// \throw IoError naming the path: cannot be read; no regular file; not a .vdb; truncated or damaged; no grid `density`
/// among several, or none at all; a grid of another type; a grid whose background is inside (it fills all of space)
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> readVdb(const std::filesystem::path& path);

/// Reads a FloatGrid from a .vdb, with its metadata: its first grid of this name, or else its only grid.
///
/// The file need not be trusted, as for readVdb. Memory is at most 40 times its size plus 1 MiB. Values can be infinite
/// or not a number.
/// \throw IoError naming the path, as readVdb
VDBCAGE_API std::shared_ptr<openvdb::FloatGrid> readFloatGrid(const std::filesystem::path& path,
                                                              const std::string& gridName);

} // namespace vdbcage
