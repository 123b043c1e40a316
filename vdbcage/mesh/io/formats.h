#pragma once

#include <ostream>
#include <string>
#include <string_view>

#include <vdbcage/mesh/mesh.h>
#include <vdbcage/mesh/mesh_io.h>

// One parser and one writer a format. A parser gets the bytes of a whole file and its name, which begins each message.
// `summary` may be null.
// \throw IoError naming the file
//
// They are written here, on std::from_chars over a buffer, because no library at hand does all that readMesh promises.
// tinyobjloader reads numbers by its own routine, not correctly rounded, and accepts NaN. CGAL's and OpenMesh's readers
// go through iostreams and report "failed" without a line or a value. Assimp keeps floats.

namespace vdbcage::detail {

Mesh parseObj(std::string_view bytes, const std::string& name, ReadSummary* summary);
Mesh parseOff(std::string_view bytes, const std::string& name, ReadSummary* summary);
Mesh parsePly(std::string_view bytes, const std::string& name, ReadSummary* summary);
Mesh parseStl(std::string_view bytes, const std::string& name, ReadSummary* summary);

void writeObj(const Mesh& mesh, const std::string& name, std::ostream& out);
void writeOff(const Mesh& mesh, const std::string& name, std::ostream& out);
void writePly(const Mesh& mesh, const std::string& name, std::ostream& out);
/// \throw IoError naming `name`: a coordinate does not fit a float
void writeStl(const Mesh& mesh, const std::string& name, std::ostream& out);

} // namespace vdbcage::detail
