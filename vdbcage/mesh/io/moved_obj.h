#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/Vec3.h>

namespace vdbcage::detail {

/// Returns the text of an OBJ file with its points at `points` and its normals turned with the faces that use them.
/// Everything else stays byte by byte. `name` is the file's.
/// \pre parseObj takes the text, which has as many points
std::string movedObj(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);

} // namespace vdbcage::detail
