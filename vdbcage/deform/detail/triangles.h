#pragma once

#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// The faces of a cage as triangles, by their points: its triangles, then two of each quad, with the quad's
/// orientation.
///
/// A quad is halved along its shorter diagonal. If both are as long, it is the one from the quad's corner with the
/// least index.
/// Cost: O(faces).
std::vector<openvdb::Vec3I> triangulateByShorterDiagonal(const Mesh& cage);

/// Six times the volume in closed `triangles`; negative where they face inward.
double sixfoldVolume(const std::vector<openvdb::Vec3d>& points, const std::vector<openvdb::Vec3I>& triangles);

} // namespace vdbcage::detail
