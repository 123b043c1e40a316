#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/core/export.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage {

/// The connectivity of the faces of a mesh, by their indices alone.
///
/// Points at the same place are not merged. A quad is one face. Faces are numbered triangles first, then quads. An edge
/// is a pair of different points that follow each other around a face. A face that uses an edge twice, as one with a
/// repeated corner may, counts there twice.
struct MeshTopology {
    std::size_t faces = 0;               ///< triangles and quads
    std::size_t edges = 0;               ///< each counted once, however many faces use it
    std::size_t vertices = 0;            ///< points that faces use
    std::size_t boundaryEdges = 0;       ///< edges with one face
    std::size_t nonManifoldEdges = 0;    ///< edges with more than two faces
    std::size_t misorientedEdges = 0;    ///< edges whose two faces run along them in the same direction
    std::size_t nonManifoldVertices = 0; ///< vertices whose faces form more than one umbrella

    /// For each face its component (connected over edges). Components are numbered by their first face.
    std::vector<std::uint32_t> faceComponent;
    /// For each component, 1 if its faces run along each edge equally often in both directions. Then it has a signed
    /// volume, and every point off its faces has a winding number.
    std::vector<std::uint8_t> componentIsCycle;

    /// Returns the number of parts that are connected over edges. Parts that share only a vertex are two.
    std::size_t components() const { return componentIsCycle.size(); }
    /// Returns whether there are faces, and all components are cycles.
    bool isCycle() const;
    /// Returns vertices - edges + faces.
    long eulerCharacteristic() const;
    /// Returns the genus, summed over the components. It means something only if no edge is a boundary, and all edges
    /// and vertices are manifold.
    long genus() const { return static_cast<long>(components()) - eulerCharacteristic() / 2; }
};

/// Examines how the faces of a mesh hang together.
/// \param mesh any polygon soup
/// \param interrupter asked whether to stop; may be null
/// \pre all indices are valid
/// \throw Cancelled when the interrupter asks to stop
/// Cost: O(faces) for ordinary meshes, in parallel.
VDBCAGE_API MeshTopology analyzeTopology(const Mesh& mesh, Interrupter* interrupter = nullptr);

} // namespace vdbcage
