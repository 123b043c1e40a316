#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/mesh/mesh.h>

namespace vdbcage::edit {

using Index = openvdb::Index32;

/// Stands for "no such element".
constexpr Index none = std::numeric_limits<Index>::max();

/// The kinds of a mesh's elements.
enum class Element : std::uint8_t { point, edge, face };

/// Their names, in the order of Element.
inline constexpr std::array<const char*, 3> elementNames{"points", "edges", "faces"};
inline const char* elementsName(Element kind)
{
    return elementNames[static_cast<std::size_t>(kind)];
}

/// Some elements of one kind.
struct Selection {
    Element kind = Element::face;
    std::vector<Index> ids; ///< ascending, each once

    friend bool operator==(const Selection& a, const Selection& b) { return a.kind == b.kind && a.ids == b.ids; }
    friend bool operator!=(const Selection& a, const Selection& b) { return !(a == b); }
};

/// Element numbers that follow each other in memory. A view: its source must outlive it.
class Ids {
public:
    Ids(const Index* first, const Index* last) : first_(first), last_(last) {}

    const Index* begin() const { return first_; }
    const Index* end() const { return last_; }
    std::size_t size() const { return static_cast<std::size_t>(last_ - first_); }
    Index operator[](std::size_t i) const { return first_[i]; }

private:
    const Index *first_, *last_;
};

/// The points, edges and faces of a mesh and their connections, by indices alone.
///
/// Points have the mesh's indices. Faces are numbered triangles first, then quads. An edge is a pair of different
/// points that follow each other around a face; edges are numbered in the order of their points, the smaller one first.
/// It takes any soup. Immutable: any number of threads may use it.
class Elements {
public:
    /// \pre the indices of faces are in range
    /// Cost: O(n log d) for n faces, where d is the most at one point.
    explicit Elements(const Mesh& mesh);

    /// Returns the number of elements; of points all, even if no face uses them.
    std::size_t count(Element kind) const;

    /// Returns the points of each edge, the smaller index first.
    const std::vector<std::pair<Index, Index>>& edges() const { return edges_; }
    /// Returns the edge between two points, in either order; `none` if there is none.
    Index edgeBetween(Index a, Index b) const;

    /// Returns three or four points, counter-clockwise seen from outside.
    Ids pointsOfFace(Index face) const { return pointsOfFaces_[face]; }
    /// Returns as many edges: edge i joins point i and the next one. It is `none` if these are the same point.
    Ids edgesOfFace(Index face) const { return edgesOfFaces_[face]; }
    /// Return ascending numbers, each once, even if a face uses the edge twice.
    Ids facesOfEdge(Index edge) const { return facesOfEdges_[edge]; }
    Ids edgesOfPoint(Index point) const { return edgesOfPoints_[point]; }
    Ids facesOfPoint(Index point) const { return facesOfPoints_[point]; }

    /// Returns whether a face uses the point.
    bool isUsed(Index point) const { return facesOfPoint(point).size() > 0; }

private:
    /// A list of elements for each of some others.
    class Lists {
    public:
        Lists() = default;
        /// Adds the list of the next element.
        void add(const std::vector<Index>& ids);
        /// Returns for each of `count` elements the numbers of the lists of `of` that name it, each once; `none` is
        /// skipped.
        static Lists inverse(const Lists& of, std::size_t count);

        Ids operator[](std::size_t i) const { return {ids_.data() + first_[i], ids_.data() + first_[i + 1]}; }
        std::size_t size() const { return first_.size() - 1; }

    private:
        std::vector<std::size_t> first_{0};
        std::vector<Index> ids_;
    };

    std::size_t points_;
    std::vector<std::pair<Index, Index>> edges_;
    Lists pointsOfFaces_, edgesOfFaces_, facesOfEdges_, edgesOfPoints_, facesOfPoints_;
};

} // namespace vdbcage::edit
