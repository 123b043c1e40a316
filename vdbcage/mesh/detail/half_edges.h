#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <vdbcage/mesh/mesh.h>

namespace vdbcage::detail {

/// The half-edges of a mesh: each side of a face, from one corner to the next. They have the numbers of their first
/// corners: 3 t + i for corner i of triangle t, then 4 for each quad. A view: `mesh` must outlive it.
class HalfEdges {
public:
    using Index = std::uint32_t;

    explicit HalfEdges(const Mesh& mesh) : mesh_(mesh), ofTriangles_(3 * mesh.triangles.size()) {}

    std::size_t size() const { return ofTriangles_ + 4 * mesh_.quads.size(); }
    /// Returns the face of a half-edge: triangles are numbered first, then quads.
    Index face(std::size_t h) const
    {
        return static_cast<Index>(h < ofTriangles_ ? h / 3 : mesh_.triangles.size() + (h - ofTriangles_) / 4);
    }
    Index from(std::size_t h) const { return point(h, 0); }
    Index to(std::size_t h) const { return point(h, 1); }
    /// Returns the first point of the half-edge before it in its face.
    Index before(std::size_t h) const { return point(h, h < ofTriangles_ ? 2 : 3); }
    /// Returns the half-edge after it in its face.
    std::size_t next(std::size_t h) const
    {
        if (h < ofTriangles_) return h % 3 == 2 ? h - 2 : h + 1;
        return (h - ofTriangles_) % 4 == 3 ? h - 3 : h + 1;
    }

private:
    /// Returns the point `step` corners further around the face.
    Index point(std::size_t h, std::size_t step) const
    {
        if (h < ofTriangles_) return mesh_.triangles[h / 3][static_cast<int>((h + step) % 3)];
        h -= ofTriangles_;
        return mesh_.quads[h / 4][static_cast<int>((h + step) % 4)];
    }

    const Mesh& mesh_;
    std::size_t ofTriangles_;
};

/// The edges of a mesh: each pair of points that a face joins, with the half-edges between them in both directions. A
/// half-edge from a point to itself belongs to no edge. Edges are in the order of their ends, the smaller end first.
class EdgeTable {
public:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// `points` is the number of points of the mesh.
    /// Cost: O(n log d) for n half-edges, where d is the largest number at one point.
    EdgeTable(const HalfEdges& halfEdges, std::size_t points);

    std::size_t size() const { return first_.size() - 1; }

    /// The half-edges of one edge: at least one, ascending.
    struct Span {
        const std::size_t* first;
        std::size_t count;

        const std::size_t* begin() const { return first; }
        const std::size_t* end() const { return first + count; }
        std::size_t operator[](std::size_t i) const { return first[i]; }
        std::size_t size() const { return count; }
    };
    Span operator[](std::size_t edge) const { return {sorted_.data() + first_[edge], first_[edge + 1] - first_[edge]}; }

    /// Returns the edge of a half-edge, or `none`.
    std::size_t edgeOf(std::size_t h) const { return edgeOf_[h]; }
    /// Returns the other half-edge of its edge, if there are two and they run opposite ways; else `none`.
    std::size_t opposite(std::size_t h) const { return opposite_[h]; }

private:
    std::vector<std::size_t> sorted_; ///< half-edges by edge
    std::vector<std::size_t> first_;  ///< of each edge in `sorted_`; and the end
    std::vector<std::size_t> edgeOf_, opposite_;
};

} // namespace vdbcage::detail
