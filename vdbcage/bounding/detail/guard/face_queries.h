#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

/// Adjacency of the faces, sides and corners of a surface, and their places. Side i of a face goes from its corner i to
/// the next one.
namespace vdbcage::detail {

/// Returns whether a number is that of a face in no quad.
inline bool isTriangle(const GuardedMesh& surface, std::uint32_t f)
{
    return surface.isFace(f) && !surface.isInQuad(f);
}

/// Returns the faces that are in no quad, ascending.
inline std::vector<std::uint32_t> trianglesOf(const GuardedMesh& surface)
{
    std::vector<std::uint32_t> list;
    for (std::uint32_t f = 0; f < surface.faces(); ++f) {
        if (isTriangle(surface, f)) list.push_back(f);
    }
    return list;
}

/// Returns the side of a face that goes from a to b, or -1.
inline int sideOf(const GuardedMesh& surface, std::uint32_t f, std::uint32_t a, std::uint32_t b)
{
    const Vec3I& t = surface.face(f);
    for (int i = 0; i < 3; ++i) {
        if (t[i] == a && t[(i + 1) % 3] == b) return i;
    }
    return -1;
}

/// Returns the face with a side from a to b, or GuardedMesh::none.
inline std::uint32_t faceAt(const GuardedMesh& surface, std::uint32_t a, std::uint32_t b)
{
    for (const std::uint32_t f : surface.facesOf(a)) {
        if (sideOf(surface, f, a, b) >= 0) return f;
    }
    return GuardedMesh::none;
}

/// Returns the face across side i of a face or an alternate, or `f` where there is none: on the plane of symmetry, and
/// at the diagonal between two alternates.
inline std::uint32_t faceAcross(const GuardedMesh& surface, std::uint32_t f, int i)
{
    const std::uint32_t next = faceAt(surface, surface.face(f)[(i + 1) % 3], surface.face(f)[i]);
    return next == GuardedMesh::none ? f : next;
}

/// Returns the corner of a face opposite to its side from a to b.
/// \pre it has that side
inline std::uint32_t cornerOpposite(const GuardedMesh& surface, std::uint32_t f, std::uint32_t a, std::uint32_t b)
{
    return surface.face(f)[(sideOf(surface, f, a, b) + 2) % 3];
}

/// Returns the number of a triangle or a quad: both faces of a quad have the same.
inline std::uint32_t polygonOf(const GuardedMesh& surface, std::uint32_t f)
{
    return std::min(f, surface.partnerOf(f)); // `none` is the largest number
}

inline std::array<Vec3d, 4> pointsOf(const GuardedMesh& surface, const Vec4I& quad)
{
    return {surface.point(quad[0]), surface.point(quad[1]), surface.point(quad[2]), surface.point(quad[3])};
}

/// Returns the normal of a face or an alternate; its length is twice the area.
inline Vec3d areaNormal(const GuardedMesh& surface, std::uint32_t f)
{
    const Corners t = surface.corners(f);
    return (t[1] - t[0]).cross(t[2] - t[0]);
}

} // namespace vdbcage::detail
