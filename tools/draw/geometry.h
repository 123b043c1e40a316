#pragma once

#include <array>
#include <utility>
#include <vector>

#include <tools/draw/frame.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::draw {

/// What one draws of a mesh, in a frame's coordinates: indexed triangles with normals, and edges. A value; needs no
/// OpenGL, so any thread may make one.
///
/// Points of the mesh at the same place count as one. A vertex is such a point together with the faces around it that
/// are joined by smooth edges, those whose two faces meet at less than the crease angle. Which corners share a vertex
/// is found once; `setPoints` finds the normals of another pose.
class Geometry {
public:
    using Index = openvdb::Index32;

    /// `creaseDegrees` 0: every face is flat. Takes some 1 us a face and O(n log n).
    /// \pre requireUsable(mesh)
    Geometry(const Mesh& mesh, const Frame& frame, double creaseDegrees);

    /// Lines without faces, from and to in world space: each is an edge, and its ends are points 2 i and 2 i + 1.
    Geometry(const std::vector<std::pair<openvdb::Vec3d, openvdb::Vec3d>>& lines, const Frame& frame);

    /// Puts the mesh's points elsewhere (world space); what was one point stays one, what was sharp stays sharp. Takes
    /// some 0.1 us a face.
    /// \throw InputError unless there is one for each point of the mesh and those of faces are finite
    void setPoints(const std::vector<openvdb::Vec3d>& points);

    const Frame& frame() const { return frame_; }
    std::size_t pointCount() const { return pointCount_; }              ///< of the mesh
    std::size_t triangleCount() const { return meshTriangles_.size(); } ///< faces of the mesh that are triangles
    std::size_t quadCount() const { return meshQuads_.size(); }         ///< faces of the mesh that are quads

    const std::vector<Vec3f>& positions() const { return positions_; } ///< one a vertex
    /// One a vertex: the mean of its faces' normals, weighted by angle; of length 1, or 0 where no face has an area.
    const std::vector<Vec3f>& normals() const { return normals_; }
    /// For each vertex a point of the mesh that is there.
    const std::vector<Index>& pointOfVertex() const { return pointOfVertex_; }
    /// Three vertices each: the mesh's triangles, then two for each quad.
    const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
    /// Each edge of the faces once, as two vertices.
    const std::vector<std::array<Index, 2>>& edges() const { return edges_; }

private:
    Frame frame_;
    std::size_t pointCount_ = 0;
    std::vector<openvdb::Vec3I> meshTriangles_; ///< the mesh's faces, of vertices
    std::vector<openvdb::Vec4I> meshQuads_;
    std::vector<Index> pointOfVertex_;
    std::vector<std::array<Index, 3>> triangles_;
    std::vector<std::array<Index, 2>> edges_;
    std::vector<Vec3f> positions_, normals_;
};

} // namespace vdbcage::draw
