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

/// The quads of a surface, kept beside its triangles.
///
/// A guard that held both diagonals of every quad would allow hardly a collapse. Here it holds the triangles, and this
/// says which two of them are a quad.
class QuadTable {
public:
    static constexpr std::uint32_t none = GuardedMesh::none;
    using Quads = boost::container::small_vector<std::uint32_t, 8>;

    /// Of a surface that was just made of a mesh of quads only.
    /// \throw InputError a triangle
    explicit QuadTable(const GuardedMesh& surface);
    /// Of the quads that the guard holds both diagonals of. Other faces are in no quad.
    static QuadTable ofPairs(const GuardedMesh& surface);

    std::size_t count() const { return count_; }
    std::uint32_t quads() const { return static_cast<std::uint32_t>(corners_.size()); } ///< ever, numbers below
    bool isQuad(std::uint32_t q) const { return corners_[q][0] != none; }
    const Vec4I& corners(std::uint32_t q) const { return corners_[q]; }
    const Quads& quadsOf(std::uint32_t v) const { return quadsOf_[v]; }
    /// The quad with a side from a to b, or `none`: beyond the plane of symmetry.
    std::uint32_t quadAt(std::uint32_t a, std::uint32_t b) const;
    /// Which side of a quad goes from a to b; 4 if none does. Side i begins at corner i.
    int sideOf(std::uint32_t q, std::uint32_t a, std::uint32_t b) const;

    /// `removed` becomes `kept` in all quads.
    /// \pre none has both
    void merge(std::uint32_t kept, std::uint32_t removed);
    void remove(std::uint32_t q);
    /// The corners of a new quad, or the new ones of an old quad.
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
    /// Takes back what was merged, removed, replaced and added among saved vertices and new ones: all is as before.
    void restore(const Saved& saved);

private:
    QuadTable() = default;

    std::vector<Vec4I> corners_; // {none, ...}: gone
    std::vector<Quads> quadsOf_; // by vertex
    std::size_t count_ = 0;
};

/// The corners of some quads, each once, ascending.
std::vector<std::uint32_t> cornersOf(const QuadTable& table, const std::vector<std::uint32_t>& quads);

/// How many edges a vertex has; on the plane of symmetry with those of the other half.
std::size_t valence(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v);

} // namespace vdbcage::detail
