#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::draw {

/// A coarse copy of a mesh, with a point of the mesh for each of its points.
struct StandIn {
    Mesh mesh;
    std::vector<openvdb::Index32> points; ///< for each point of `mesh` the nearest of the points that it replaces
};

/// Returns a stand-in of at most `mostTriangles` triangles, for drawing while something moves. It takes any soup, and
/// guarantees only that the result looks similar. The stand-in of a mesh that is small enough is the mesh.
/// Cost: some passes over the mesh, 0.1 us per face each. \pre requireUsable(mesh), mostTriangles >= 100
StandIn standIn(const Mesh& mesh, std::size_t mostTriangles);

} // namespace vdbcage::draw
