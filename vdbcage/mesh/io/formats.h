#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include <vdbcage/core/precision.h>
#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/mesh_io.h>

// One parser, one mover and one writer for each format. A parser gets the bytes of a whole file and its name, which
// begins each message.
// \throw IoError naming the file
//
// They are written here, with std::from_chars on a buffer, because no available library keeps all promises of readMesh.
// tinyobjloader reads numbers by its own routine, not correctly rounded, and accepts NaN. CGAL's and OpenMesh's readers
// use iostreams and report "failed" without a line or a value. Assimp keeps floats.

namespace vdbcage::detail {

/// Checks that `path` has the extension of a format: .obj .off .ply .stl in any case.
/// \throw IoError naming the path and the extensions
VDBCAGE_API void requireMeshExtension(const std::filesystem::path& path);

/// Returns all bytes of a mesh file. \throw IoError; ResourceError
VDBCAGE_API std::string readMeshBytes(const std::filesystem::path& path);
/// Parses these bytes as readMeshFile does. \throw as readMeshFile
VDBCAGE_API MeshFile parseMesh(const std::string& bytes, const std::filesystem::path& path);

MeshFile parseObj(std::string_view bytes, const std::string& name);
MeshFile parseOff(std::string_view bytes, const std::string& name);
MeshFile parsePly(std::string_view bytes, const std::string& name);
MeshFile parseStl(std::string_view bytes, const std::string& name);

// Each returns the bytes of a file with its points at `points`. Numbers of coordinates that stay to the bit stay as
// they are written, and so does all else, except for normals in an OBJ, which turn with the faces that use them, and in
// an STL, which are computed. Text of UTF-16 becomes UTF-8. `name` is the file's.
// \pre the parser takes the bytes, which have as many points; these are finite and fit the numbers of the file
// Those of a PLY must not be integers (see plyPrecision).

std::string movedObj(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);
std::string movedOff(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);
std::string movedPly(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);
std::string movedStl(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);

/// Returns float32 if a coordinate of the points of a PLY is a float, float64 if all are doubles, and nothing if one is
/// an integer.
/// \throw IoError naming `name`, when the header is malformed
std::optional<Precision> plyPrecision(std::string_view bytes, const std::string& name);

void writeObj(const Mesh& mesh, const std::string& name, std::ostream& out);
void writeOff(const Mesh& mesh, const std::string& name, std::ostream& out);
void writePly(const Mesh& mesh, const std::string& name, std::ostream& out);
/// Writes a colour for each point, too, unless `colours` is null.
void writePly(const Mesh& mesh, const std::vector<PointColour>* colours, std::ostream& out);
/// \pre the points are floats
/// \throw IoError naming `name`: there are too many triangles
void writeStl(const Mesh& mesh, const std::string& name, std::ostream& out);

} // namespace vdbcage::detail
