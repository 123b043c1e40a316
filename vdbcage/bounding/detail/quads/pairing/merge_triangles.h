#pragma once

#include <cstdint>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// Makes a quad of two triangles that share an edge, under the guard. Returns whether.
///
/// Where they are too folded, or the other diagonal is in the model's way, the ends of the lower diagonal are pushed
/// outward. Around a quad there are four different polygons, and its corners keep three edges. Where it fails nothing
/// changes.
bool mergeTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g);

} // namespace vdbcage::detail
