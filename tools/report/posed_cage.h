#pragma once

#include <filesystem>
#include <string>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::tool {

/// \throw InputError naming `posedPath` unless the posed cage that was read from there has the faces of the cage at
/// rest, which is called `cageName`. Readers split quads that are concave, which a pose may make of any: so only the
/// number of triangles counts, a quad being two.
void requireSameFaces(const std::filesystem::path& posedPath, const Mesh& posed, const std::string& cageName,
                      const Mesh& cage);

} // namespace vdbcage::tool
