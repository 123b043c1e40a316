#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <OpenMesh/Core/Mesh/Traits.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/half_edges.h>
#include <vdbcage/mesh/mesh.h>

/// Conversions between Mesh and OpenMesh's half-edge structure, all in this place.
namespace vdbcage::detail {

struct OpenMeshTraits : OpenMesh::DefaultTraitsDouble {
    VertexAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge | OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
};
using OpenTriMesh = OpenMesh::TriMesh_ArrayKernelT<OpenMeshTraits>;

inline openvdb::Vec3d toVec3d(const OpenMesh::Vec3d& p)
{
    return {p[0], p[1], p[2]};
}

inline OpenMesh::Vec3d fromVec3d(const openvdb::Vec3d& p)
{
    return {p.x(), p.y(), p.z()};
}

/// \throw InputError an edge is not between one or two faces in opposite directions; a triangle repeats a corner
inline void requireOriented(const HalfEdges& halfEdges, const EdgeTable& edges)
{
    for (std::size_t h = 0; h < halfEdges.size(); ++h) {
        const auto fail = [&](const char* problem) {
            throw InputError("the surface is not an oriented 2-manifold: the edge between points " +
                             std::to_string(halfEdges.from(h)) + " and " + std::to_string(halfEdges.to(h)) + problem);
        };
        if (edges.edgeOf(h) == EdgeTable::none) fail(" has no length");
        for (const std::size_t other : edges[edges.edgeOf(h)]) {
            if (other < h && halfEdges.from(other) == halfEdges.from(h)) fail(" has two faces on the same side");
        }
    }
}

/// Converts `mesh` to an OpenMesh, with its quads split. Points and, after the split, faces keep their numbers.
/// Boundaries are allowed.
/// \throw InputError not an oriented 2-manifold
/// Cost: O(faces).
inline OpenTriMesh toOpenMesh(const Mesh& mesh)
{
    using Handle = OpenTriMesh::HalfedgeHandle;
    Mesh split;
    split.triangles = triangulate(mesh);
    const std::vector<openvdb::Vec3I>& triangles = split.triangles;
    const HalfEdges halfEdges(split);
    const EdgeTable table(halfEdges, mesh.points.size());
    requireOriented(halfEdges, table);

    // Built directly: add_face() searches, and prints its complaints.
    OpenTriMesh result;
    result.resize(mesh.points.size(), table.size(), triangles.size());
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        result.set_point(OpenTriMesh::VertexHandle(int(p)), fromVec3d(mesh.points[p]));
    }
    std::vector<Handle> handles(halfEdges.size());
    int edge = 0;
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (table.opposite(h) < h) {
            handles[h] = result.opposite_halfedge_handle(handles[table.opposite(h)]);
        } else {
            handles[h] = result.halfedge_handle(OpenTriMesh::EdgeHandle(edge++), 0);
        }
        result.set_vertex_handle(handles[h], OpenTriMesh::VertexHandle(int(halfEdges.to(h))));
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        const OpenTriMesh::FaceHandle face{int(t)};
        result.set_halfedge_handle(face, handles[3 * t]);
        for (std::size_t i = 0; i < 3; ++i) {
            const Handle handle = handles[3 * t + i];
            result.set_face_handle(handle, face);
            result.set_next_halfedge_handle(handle, handles[3 * t + (i + 1) % 3]);
            result.set_halfedge_handle(OpenTriMesh::VertexHandle(int(triangles[t][int(i)])), handle);
        }
    }
    // Boundary half-edges: one leaves each boundary vertex, and the vertex must refer to it.
    const auto failAt = [](std::size_t p) {
        throw InputError("the surface is not a 2-manifold: the faces at point " + std::to_string(p) +
                         " form more than one umbrella");
    };
    std::vector<Handle> leaving(mesh.points.size());
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (table.opposite(h) != EdgeTable::none) continue;
        const Handle boundary = result.opposite_halfedge_handle(handles[h]);
        const std::size_t to = halfEdges.from(h), from = halfEdges.to(h);
        result.set_vertex_handle(boundary, OpenTriMesh::VertexHandle(int(to)));
        result.set_boundary(boundary);
        if (leaving[from].is_valid()) failAt(from);
        leaving[from] = boundary;
        result.set_halfedge_handle(OpenTriMesh::VertexHandle(int(from)), boundary);
    }
    std::vector<std::size_t> degree(mesh.points.size(), 0);
    for (const openvdb::Vec3I& triangle : triangles) {
        for (int i = 0; i < 3; ++i) ++degree[triangle[i]];
    }
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (leaving[p].is_valid()) {
            // The boundary arrives at p on the half-edge before, found by turning around p through its faces.
            Handle arriving = result.opposite_halfedge_handle(leaving[p]);
            while (!result.is_boundary(arriving)) {
                arriving = result.opposite_halfedge_handle(result.next_halfedge_handle(arriving));
            }
            result.set_next_halfedge_handle(arriving, leaving[p]);
        }
    }
    for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (degree[p] == 0) continue;
        std::size_t incident = 0;
        for (auto face = result.cvf_iter(OpenTriMesh::VertexHandle(int(p))); face.is_valid(); ++face) ++incident;
        if (incident != degree[p]) failAt(p);
    }
    return result;
}

/// Returns the faces of `mesh` that are not deleted, and the points they use, in order.
inline Mesh fromOpenMesh(const OpenTriMesh& mesh)
{
    Mesh result;
    std::vector<openvdb::Index32> number(mesh.n_vertices());
    for (const auto vertex : mesh.vertices()) { // skips deleted ones
        if (mesh.is_isolated(vertex)) continue;
        number[std::size_t(vertex.idx())] = openvdb::Index32(result.points.size());
        result.points.push_back(toVec3d(mesh.point(vertex)));
    }
    for (const auto face : mesh.faces()) {
        openvdb::Vec3I triangle;
        OpenTriMesh::HalfedgeHandle side = mesh.halfedge_handle(face);
        for (int i = 0; i < 3; ++i) {
            triangle[i] = number[std::size_t(mesh.from_vertex_handle(side).idx())];
            side = mesh.next_halfedge_handle(side);
        }
        result.triangles.push_back(triangle);
    }
    return result;
}

} // namespace vdbcage::detail
