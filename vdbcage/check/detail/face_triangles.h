#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// All triangles of the faces of a mesh. A triangle has one. A quad has the two of the diagonal 0-2, then the two of
/// the diagonal 1-3.
class FaceTriangles {
public:
    explicit FaceTriangles(const Mesh& mesh) : plain_(mesh.triangles.size()), triangles_(mesh.triangles)
    {
        triangles_.reserve(plain_ + 4 * mesh.quads.size());
        for (const openvdb::Vec4I& q : mesh.quads) {
            triangles_.emplace_back(q[0], q[1], q[2]);
            triangles_.emplace_back(q[0], q[2], q[3]);
            triangles_.emplace_back(q[0], q[1], q[3]);
            triangles_.emplace_back(q[1], q[2], q[3]);
        }
    }

    const std::vector<openvdb::Vec3I>& triangles() const { return triangles_; }
    const openvdb::Vec3I& operator[](std::size_t triangle) const { return triangles_[triangle]; }
    std::size_t size() const { return triangles_.size(); }

    std::size_t faces() const { return plain_ + (triangles_.size() - plain_) / 4; }
    bool isQuad(std::size_t face) const { return face >= plain_; }
    /// Returns the first triangle of a face; the last is first(face + 1) - 1.
    std::size_t first(std::size_t face) const { return face < plain_ ? face : plain_ + 4 * (face - plain_); }

    std::uint32_t face(std::size_t triangle) const
    {
        return static_cast<std::uint32_t>(triangle < plain_ ? triangle : plain_ + (triangle - plain_) / 4);
    }
    bool ofQuad(std::size_t triangle) const { return triangle >= plain_; }
    /// Returns whether a triangle belongs to the surface in which every quad is split by its diagonal 0-2.
    bool ofFirstDiagonal(std::size_t triangle) const { return !ofQuad(triangle) || (triangle - plain_) % 4 < 2; }

private:
    std::size_t plain_;
    std::vector<openvdb::Vec3I> triangles_;
};

} // namespace vdbcage::detail
