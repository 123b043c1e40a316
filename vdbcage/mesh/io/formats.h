#pragma once

#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>

#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/mesh_io.h>

// One parser and one writer a format. A parser gets the bytes of a whole file and its name, which begins each message.
// \throw IoError naming the file
//
// They are written here, on std::from_chars over a buffer, because no library at hand does all that readMesh promises.
// tinyobjloader reads numbers by its own routine, not correctly rounded, and accepts NaN. CGAL's and OpenMesh's readers
// go through iostreams and report "failed" without a line or a value. Assimp keeps floats.

namespace vdbcage::detail {

/// Checks that the extension of `path` is that of a format: .obj .off .ply .stl in any case.
/// \throw IoError naming the path and the extensions
VDBCAGE_API void requireMeshExtension(const std::filesystem::path& path);

/// All bytes of a mesh file. \throw IoError; ResourceError
VDBCAGE_API std::string readMeshBytes(const std::filesystem::path& path);
/// Makes of them what readMeshFile does. \throw as readMeshFile
VDBCAGE_API MeshFile parseMesh(const std::string& bytes, const std::filesystem::path& path);

MeshFile parseObj(std::string_view bytes, const std::string& name);
MeshFile parseOff(std::string_view bytes, const std::string& name);
MeshFile parsePly(std::string_view bytes, const std::string& name);
MeshFile parseStl(std::string_view bytes, const std::string& name);

void writeObj(const Mesh& mesh, const std::string& name, std::ostream& out);
void writeOff(const Mesh& mesh, const std::string& name, std::ostream& out);
void writePly(const Mesh& mesh, const std::string& name, std::ostream& out);
/// With a colour for each point, unless `colours` is null.
void writePly(const Mesh& mesh, const std::vector<PointColour>* colours, std::ostream& out);
/// \pre the points are floats
/// \throw IoError naming `name`: there are too many triangles
void writeStl(const Mesh& mesh, const std::string& name, std::ostream& out);

} // namespace vdbcage::detail
