#pragma once

#include <cstddef>
#include <vector>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/geometry/triangle_pair.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::test {

/// Returns the number of pairs of triangles of a surface that are nearer to each other than a guard allows, for either
/// split of its quads. `part` is a factor of the spacing, less than 1 if coordinates across a plane of symmetry are
/// rounded.
inline std::size_t pairsTooNear(const Mesh& surface, const BoundingGuard& guard, double part = 1)
{
    using openvdb::Vec3I;
    detail::Spacing spacing = detail::modelOf(guard).spacing();
    spacing.distance *= part;
    spacing.share *= part;
    spacing.sine *= part;
    struct Triangle {
        std::size_t face;
        int split; // 0: not of a quad
        detail::SurfaceTriangle triangle;
    };
    std::vector<Triangle> triangles;
    const auto add = [&](std::size_t face, int split, const Vec3I& t) {
        const auto corner = [&](int i) { return detail::modelOf(guard).scaled(surface.points[t[i]]); };
        triangles.push_back({face, split, {t, {corner(0), corner(1), corner(2)}}});
    };
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) add(i, 0, surface.triangles[i]);
    for (std::size_t i = 0; i < surface.quads.size(); ++i) {
        const openvdb::Vec4I& q = surface.quads[i];
        const std::size_t face = surface.triangles.size() + i;
        for (const Vec3I& t : {Vec3I(q[0], q[1], q[2]), Vec3I(q[0], q[2], q[3])}) add(face, 1, t);
        for (const Vec3I& t : {Vec3I(q[0], q[1], q[3]), Vec3I(q[1], q[2], q[3])}) add(face, 2, t);
    }
    std::size_t count = 0;
    for (const Triangle& a : triangles) {
        for (const Triangle& b : triangles) {
            if (&a >= &b || (a.face == b.face && a.split != b.split)) continue;
            count += detail::tooNear(a.triangle, b.triangle, spacing);
        }
    }
    return count;
}

} // namespace vdbcage::test
