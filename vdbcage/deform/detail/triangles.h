#pragma once

#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// Returns the faces of a cage as triangles, by their points: its triangles, then two for each quad, with the quad's
/// orientation.
///
/// A quad is halved along its shorter diagonal. If both are equally long, it is halved along the one from the corner
/// with the least index.
/// Cost: O(faces).
std::vector<openvdb::Vec3I> triangulateByShorterDiagonal(const Mesh& cage);

/// Returns six times the volume in closed `triangles`; negative where they face inward.
double sixfoldVolume(const std::vector<openvdb::Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles);

} // namespace vdbcage::detail
