#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <openvdb/Types.h>
#include <openvdb/math/Vec3.h>

namespace vdbcage::detail {

/// The text of an OBJ file with its points at `points` and its normals turned as the faces that use them turn.
/// Everything else stays byte by byte. `name` is the file's.
/// \pre the text is one that parseObj takes, with as many points
std::string movedObj(std::string_view bytes, const std::string& name, const std::vector<openvdb::Vec3d>& points);

} // namespace vdbcage::detail
