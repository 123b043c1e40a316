#pragma once

#include <cstdint>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// Makes a quad of two triangles that share an edge, under the guard. Returns whether.
///
/// If they are too folded, or the model is in the other diagonal's way, the ends of the lower diagonal are pushed
/// outward. Only quads with four different polygons around them are made, and their corners keep three edges. If it
/// fails, nothing changes.
bool mergeTriangles(GuardedMesh& surface, std::uint32_t f, std::uint32_t g);

} // namespace vdbcage::detail
