#pragma once

#include <cstddef>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::draw {

/// A coarse picture of `mesh` of at most `mostTriangles` triangles, to be drawn while something moves. Any soup will
/// do, and nothing is promised of the result but that it looks alike. A mesh that is small enough is returned as it is.
/// Cost: some passes over the mesh, 0.1 us a face each. \pre requireUsable(mesh), mostTriangles >= 100
Mesh standIn(const Mesh& mesh, std::size_t mostTriangles);

} // namespace vdbcage::draw
