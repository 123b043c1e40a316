#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::draw {

/// A coarse picture of a mesh, and which of the mesh's points each of its points goes with.
struct StandIn {
    Mesh mesh;
    std::vector<openvdb::Index32> points; ///< for each point of `mesh` the nearest of those that it stands for
};

/// A stand-in of at most `mostTriangles` triangles, to be drawn while something moves. Any soup will do, and nothing is
/// promised of the result but that it looks alike. A mesh that is small enough stands for itself.
/// Cost: some passes over the mesh, 0.1 us a face each. \pre requireUsable(mesh), mostTriangles >= 100
StandIn standIn(const Mesh& mesh, std::size_t mostTriangles);

} // namespace vdbcage::draw
