#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/dynamic_bvh.h>
#include <vdbcage/geometry/triangle_pair.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// A triangle of a face: a quad has two for each diagonal. Faces are numbered triangles first, then quads.
struct SplitTriangle {
    Vec3I corners;
    std::uint32_t face;
    std::uint32_t diagonal; ///< 0: of the quad's corners 0 and 2, 1: of the other two; 0 for a triangle

    bool has(std::uint32_t point) const { return corners[0] == point || corners[1] == point || corners[2] == point; }
};

/// The pairs of triangles of a surface that meet in more than the corners and edges that they share, by exact
/// predicates. Points of the surface may be moved.
///
/// Points are the same only if their indices are. Degenerate triangles meet nothing. The triangles of a quad meet only
/// where it is folded over their diagonal.
class Meetings {
public:
    /// Two indices in triangles(), the smaller one first.
    using Pair = std::array<std::uint32_t, 2>;
    /// The largest number of pairs that are sought: n triangles have up to n^2 / 2.
    static constexpr std::size_t most = 1'000'000;

    /// `mesh` must outlive this.
    /// \pre all indices are valid, and all points finite
    explicit Meetings(Mesh& mesh);

    const std::vector<SplitTriangle>& triangles() const { return triangles_; }
    /// Returns the triangles with a corner at `point`.
    const std::vector<std::uint32_t>& around(std::uint32_t point) const { return around_[point]; }
    /// Returns all pairs, sorted; or the first `most` that were found. \throw Cancelled
    std::vector<Pair> pairs(Interrupter* interrupter) const;
    /// Calls visit(other) for each triangle that `triangle` meets.
    template <typename Visit>
    void forEachMeeting(std::uint32_t triangle, const Visit& visit) const
    {
        if (isDegenerate(triangle)) return;
        const Plane plane(cornersOf(triangle));
        tree_.forEachOverlap(boxOf(triangle), [&](std::uint32_t other, const Box&) {
            if (!isBeside(plane, other) && meet(triangle, other)) visit(other);
            return true;
        });
    }
    /// Returns whether a triangle has no area, exactly.
    bool isDegenerate(std::uint32_t triangle) const { return degenerate_[triangle]; }
    void move(std::uint32_t point, const Vec3d& place);

private:
    Corners cornersOf(std::uint32_t triangle) const
    {
        const Vec3I& t = triangles_[triangle].corners;
        return {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
    }
    /// Returns whether a triangle certainly lies on one side of the plane, as most in the box of a long triangle do.
    bool isBeside(const Plane& plane, std::uint32_t triangle) const
    {
        const Corners t = cornersOf(triangle);
        const int side = plane.side(t[0], 0);
        return side != 0 && plane.side(t[1], 0) == side && plane.side(t[2], 0) == side;
    }
    Box boxOf(std::uint32_t triangle) const;
    bool meet(std::uint32_t a, std::uint32_t b) const;
    bool isEdge(std::uint32_t face, std::uint32_t a, std::uint32_t b) const;

    Mesh& mesh_;
    std::vector<SplitTriangle> triangles_;
    std::vector<std::vector<std::uint32_t>> around_;
    std::vector<char> degenerate_;
    DynamicBvh tree_;
};

} // namespace vdbcage::detail
