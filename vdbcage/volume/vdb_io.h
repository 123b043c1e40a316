#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <memory>
#include <string>

#include <vdbcage/core/export.h>
#include <vdbcage/core/grids.h>

namespace vdbcage {

/// Writes a mask as a .vdb that Blender, Houdini and others open as a volume: one FloatGrid named `density`. The
/// \ref volume "page of this room" has its details.
///
/// The file appears whole or not at all: it is written under a temporary name in the same folder, then renamed.
/// \param mask 1 in its active voxels, 0 in others
/// \param path a file there is replaced
/// \param metadata each entry becomes a string of the grid named `vdbcage_KEY`
/// \throw IoError naming the path, when it cannot be written
/// Cost: 2 KiB of memory for each leaf node while it is written.
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// As writeVdb() to a file, but to a stream that can seek, whose state tells whether it took all; `path` is for errors.
VDBCAGE_API void writeVdb(const openvdb::MaskGrid& mask, std::ostream& out, const std::filesystem::path& path,
                          const std::map<std::string, std::string>& metadata = {});

/// Reads a mask from a .vdb: its first grid named `density`, or else its only grid. The \ref volume "page of this room"
/// says which voxels are active, and which files can be read.
///
/// The grid's transform is kept, metadata is not. The file need not be trusted.
/// \param path a regular file
/// \throw IoError naming the path, when it cannot be read, is no regular file, no .vdb, truncated or damaged, has no
/// grid `density` among several, or none at all, or a grid of another type, or one whose background is inside (it fills
/// all of space)
/// Cost: memory of at most 80 times the file's size plus 2 MiB.
VDBCAGE_API std::shared_ptr<openvdb::MaskGrid> readVdb(const std::filesystem::path& path);

/// Reads a FloatGrid from a .vdb, with its metadata: its first grid of a name, or else its only grid.
///
/// The file need not be trusted, as for readVdb(). Values can be infinite or not a number.
/// \param path a regular file
/// \param gridName of the wanted grid
/// \throw IoError naming the path, as readVdb()
/// Cost: memory of at most 40 times the file's size plus 1 MiB.
VDBCAGE_API std::shared_ptr<openvdb::FloatGrid> readFloatGrid(const std::filesystem::path& path,
                                                              const std::string& gridName);

} // namespace vdbcage
