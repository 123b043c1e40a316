#pragma once

#include <vdbcage/mesh/topology.h>

namespace vdbcage::test {

/// Returns whether the faces of a mesh form closed surfaces that meet nowhere, by their indices.
inline bool isClosedManifold(const Mesh& mesh)
{
    const MeshTopology topology = analyzeTopology(mesh);
    return topology.isCycle() && topology.boundaryEdges + topology.nonManifoldEdges + topology.misorientedEdges +
                                         topology.nonManifoldVertices ==
                                     0;
}

} // namespace vdbcage::test
