#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <boost/container/small_vector.hpp>
#include <vdbcage/bounding/detail/guard/guarded_mesh.h>

namespace vdbcage::detail {

/// An edge by its ends.
using Rung = std::array<std::uint32_t, 2>;

/// The quads of a surface of triangles, each a pair of them.
///
/// A guard that held both diagonals of every quad would allow hardly any collapse. Here it holds the triangles, and
/// this table has the pairs that are quads.
class QuadTable {
public:
    static constexpr std::uint32_t none = GuardedMesh::none;
    using Quads = boost::container::small_vector<std::uint32_t, 8>;

    /// Takes the quads of a surface that was just made of a mesh of quads only.
    /// \throw InputError a triangle
    explicit QuadTable(const GuardedMesh& surface);
    /// Takes the quads of which the guard holds both diagonals. Other faces are in no quad.
    static QuadTable ofPairs(const GuardedMesh& surface);

    std::size_t count() const { return count_; }
    std::uint32_t quads() const { return static_cast<std::uint32_t>(corners_.size()); } ///< ever; numbers are less
    bool isQuad(std::uint32_t q) const { return corners_[q][0] != none; }
    const Vec4I& corners(std::uint32_t q) const { return corners_[q]; }
    const Quads& quadsOf(std::uint32_t v) const { return quadsOf_[v]; }
    /// Returns the quad with a side from a to b, or `none`: beyond the plane of symmetry.
    std::uint32_t quadAt(std::uint32_t a, std::uint32_t b) const;
    /// Returns the side of a quad that goes from a to b; 4 if none does. Side i begins at corner i.
    int sideOf(std::uint32_t q, std::uint32_t a, std::uint32_t b) const;

    /// Replaces `removed` by `kept` in all quads.
    /// \pre none has both
    void merge(std::uint32_t kept, std::uint32_t removed);
    void remove(std::uint32_t q);
    void add(const Vec4I& corners);
    void replace(std::uint32_t q, const Vec4I& corners);

    /// The quads around some vertices.
    struct Saved {
        std::vector<std::pair<std::uint32_t, Vec4I>> corners;
        std::vector<std::pair<std::uint32_t, Quads>> quadsOf;
        std::size_t count;
        std::uint32_t quads;
        std::size_t vertices;
    };
    Saved saved(const std::vector<std::uint32_t>& vertices) const;
    /// Undoes all changes among the saved vertices and new ones.
    void restore(const Saved& saved);

private:
    QuadTable() = default;

    std::vector<Vec4I> corners_; // {none, ...}: gone
    std::vector<Quads> quadsOf_; // by vertex
    std::size_t count_ = 0;
};

/// Returns the corners of some quads, each once, ascending.
std::vector<std::uint32_t> cornersOf(const QuadTable& table, const std::vector<std::uint32_t>& quads);

/// Returns the number of edges of a vertex; on the plane of symmetry with those of the other half.
std::size_t valence(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v);

} // namespace vdbcage::detail
