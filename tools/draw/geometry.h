#pragma once

#include <array>
#include <utility>
#include <vector>

#include <tools/draw/frame.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::draw {

/// The drawable parts of a mesh, in a frame's coordinates: indexed triangles with normals, and edges. A value; needs no
/// OpenGL, so any thread may make one.
///
/// Points of the mesh at the same place count as one. A vertex is such a point together with the faces around it that
/// are joined by smooth edges, those whose two faces meet at less than the crease angle. The corners that share a
/// vertex are found once; `setPoints` finds the normals of another pose.
class Geometry {
public:
    using Index = openvdb::Index32;

    /// `creaseDegrees` 0: every face is flat. Takes some 1 us per face and O(n log n).
    /// \pre requireUsable(mesh)
    Geometry(const Mesh& mesh, const Frame& frame, double creaseDegrees);

    /// Lines without faces, from and to in world space: each is an edge, and its ends are points 2 i and 2 i + 1.
    Geometry(const std::vector<std::pair<openvdb::Vec3d, openvdb::Vec3d>>& lines, const Frame& frame);

    /// Moves the mesh's points (world space); points that were one stay one, sharp edges stay sharp. Takes some 0.1 us
    /// per face.
    /// \throw InputError unless there is one for each point of the mesh and those of faces are finite
    void setPoints(const std::vector<openvdb::Vec3d>& points);

    const Frame& frame() const { return frame_; }
    std::size_t pointCount() const { return pointCount_; }              ///< of the mesh
    std::size_t triangleCount() const { return meshTriangles_.size(); } ///< triangular faces of the mesh
    std::size_t quadCount() const { return meshQuads_.size(); }         ///< quads of the mesh

    const std::vector<Vec3f>& positions() const { return positions_; } ///< one per vertex
    /// Returns one per vertex: the mean of its faces' normals, weighted by angle; of length 1, or 0 where no face has
    /// an area.
    const std::vector<Vec3f>& normals() const { return normals_; }
    /// Returns for each vertex a point of the mesh at its place.
    const std::vector<Index>& pointOfVertex() const { return pointOfVertex_; }
    /// Returns three vertices each: the mesh's triangles, then two for each quad.
    const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
    /// Returns each edge of the faces once, as two vertices.
    const std::vector<std::array<Index, 2>>& edges() const { return edges_; }

private:
    Frame frame_;
    std::size_t pointCount_ = 0;
    std::vector<openvdb::Vec3I> meshTriangles_; ///< the mesh's faces, by vertices
    std::vector<openvdb::Vec4I> meshQuads_;
    std::vector<Index> pointOfVertex_;
    std::vector<std::array<Index, 3>> triangles_;
    std::vector<std::array<Index, 2>> edges_;
    std::vector<Vec3f> positions_, normals_;
};

} // namespace vdbcage::draw
