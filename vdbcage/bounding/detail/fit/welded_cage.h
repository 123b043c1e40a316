#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

using openvdb::Vec4I;

/// A cage in the guard's units, as triangles, whose points at one place of a seam are one. Points that meet elsewhere
/// stay apart: an artist drew them onto each other.
///
/// Where the guard has a plane of symmetry, the cage is made exactly symmetric in it. The triangles beyond the plane
/// come first, as GuardedMesh numbers them, then their mirror images.
class WeldedCage {
public:
    enum class Splits { lessFolded, other }; ///< of quads into the triangles that they are until they are quads

    /// \param cage it must outlive this
    /// \param guard it must outlive this
    /// \throw InputError when the guard has a plane in which the cage is not symmetric, or has no edges
    WeldedCage(const Mesh& cage, const GuardModel& guard, Splits splits);

    /// Returns the places of the vertices, by number of point.
    const std::vector<Vec3d>& drawn() const { return drawn_; }
    /// Returns triangles by numbers of vertices: those of the cage that are in no quad, then two of each quad; mirror
    /// images come after them.
    const std::vector<Vec3I>& triangles() const { return triangles_; }
    /// Returns the number of triangles that are no mirror images.
    std::uint32_t guardedTriangles() const { return guardedTriangles_; }
    std::uint32_t firstOfQuads() const { return firstOfQuads_; }
    std::uint32_t vertexOf(std::size_t point) const { return vertexOf_[point]; }
    /// Returns the vertex's mirror image; without a plane the vertex.
    std::uint32_t partnerOf(std::uint32_t vertex) const { return partners_.empty() ? vertex : partners_[vertex]; }
    /// Returns the number of the cage's face that a triangle, or its mirror image, belongs to.
    std::size_t faceOf(std::size_t triangle) const { return faceOf_[triangle]; }
    /// Makes places of vertices symmetric, after those beyond the plane; without one it changes nothing.
    void mirror(std::vector<Vec3d>& places) const;
    /// Returns the triangles as a mesh in world units, with these places of the vertices.
    Mesh inWorld(const std::vector<Vec3d>& places) const;
    /// Returns the cage with these places of the vertices. Coordinates that are as in the cage keep their bits.
    Mesh cageWith(std::vector<Vec3d> places) const;

private:
    void weld();
    void addFaces(Splits splits);
    void addTriangle(const Vec3I& t, std::size_t face);
    void addQuad(const Vec4I& q, std::size_t face, Splits splits);
    /// Returns whether a face is beyond the plane; it is behind if not.
    template <typename Face>
    bool isBeyond(const Face& face, std::size_t number) const;
    bool isBehind(std::uint32_t vertex) const;

    const Mesh& cage_;
    const GuardModel& guard_;
    std::vector<std::uint32_t> vertexOf_; // by point: the first at the same place
    std::vector<Vec3d> asInCage_;         // by point, rounded as the guard asks
    std::vector<Vec3d> drawn_;            // by vertex: these, made symmetric
    std::vector<std::uint32_t> partners_; // by vertex: the mirror image; empty without a plane
    std::vector<Vec3I> triangles_;
    std::vector<std::size_t> faceOf_; // by triangle
    std::uint32_t firstOfQuads_ = 0, guardedTriangles_ = 0;
};

} // namespace vdbcage::detail
