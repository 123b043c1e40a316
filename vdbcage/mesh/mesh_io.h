#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// What a reader met beside plain triangles and quads: for reports, never needed to use the mesh.
struct ReadSummary {
    std::size_t polygons = 0;        ///< faces with more than four corners, split into triangles
    std::size_t degenerateFaces = 0; ///< faces that repeat a corner or have zero area (kept: they are geometry)
    std::size_t ignoredElements = 0; ///< lines, points, curves and other elements that are not faces
};

/// Checks that readMesh and writeMesh know the format of `path` by its extension: .obj .off .ply .stl in any case.
/// \throw IoError naming the path and the extensions
VDBCAGE_API void requireMeshExtension(const std::filesystem::path& path);

/// Reads a model or cage: OBJ, OFF (also COFF, NOFF, STOFF), PLY (ascii, binary of both byte orders) or STL (ascii,
/// binary), told apart by the file name's extension in any case. Points keep their order and exact values; corners
/// of an STL with the same coordinates become one point. Faces with more than four corners, and quads that are
/// concave, are split into triangles. The reader does not depend on the locale.
/// \throw IoError naming the path, the line or byte, and the value: the file cannot be read, is truncated or
///        malformed, has a coordinate that is not finite, an index out of range, no face, or only degenerate faces.
/// Cost: one pass over the file, held in memory.
VDBCAGE_API Mesh readMesh(const std::filesystem::path& path, ReadSummary* summary = nullptr);

/// Writes `mesh` to `path` in the format of its extension: OBJ, OFF, PLY (binary little endian, doubles) or STL
/// (binary: float coordinates, quads as two triangles). OBJ, OFF and PLY read back bit-equal. The file appears whole
/// or not at all: it is written under a temporary name in the same folder, then renamed.
/// \throw IoError
VDBCAGE_API void writeMesh(const Mesh& mesh, const std::filesystem::path& path);

} // namespace vdbcage
