#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <vdbcage/bounding/detail/guard/star_change.h>
#include <vdbcage/bounding/detail/quads/quad_table.h>

/// Local changes of connectivity that bring vertices of quads and triangles nearer to four edges. The surface has
/// triangles only; a table has the pairs that are quads.
namespace vdbcage::detail {

/// A change of a few polygons, identified by vertices.
struct QuadChange {
    enum class Kind {
        rotation, ///< the edge from 0 to 1, between two polygons of which one is a quad, turns to go from 2 to 3
        merge,    ///< the triangles on both sides of the edge from 0 to 1 become a quad
        collapse, ///< the opposite corners 0 and 1 of a quad become one
        split     ///< vertex 0 becomes two: they and its neighbours 1 and 2 are the corners of a new quad
    };
    Kind kind;
    std::array<std::uint32_t, 4> vertices;
    double gain; ///< the irregularity that it removes
};

/// Returns how far a vertex is from four edges: 0 at four, 1 at three or five, more above, infinite below three.
double irregularity(std::size_t valence);

/// Returns the number of edges of a vertex of quads and triangles; on the plane of symmetry with those of the other
/// half.
std::size_t polygonValence(const GuardedMesh& surface, const QuadTable& table, std::uint32_t v);

/// Returns the changes of all kinds that gain more than `least`, best first.
/// Cost: O(n log n)
std::vector<QuadChange> quadChanges(const GuardedMesh& surface, const QuadTable& table, double least);

/// A change of the surface and of the table.
struct PlannedChange {
    StarChange star;
    Vec3d place;                                           ///< of the star's centre, on the present surface
    std::vector<std::uint32_t> vertices;                   ///< of the polygons that change, before
    std::vector<std::uint32_t> removed;                    ///< quads
    std::vector<std::pair<std::uint32_t, Vec4I>> replaced; ///< quads with new corners; `none`: new ones
};

/// Returns the plan of a change, or nothing where the present surface does not allow it.
std::optional<PlannedChange> planned(const GuardedMesh& surface, const QuadTable& table, const QuadChange& change);

/// Changes the table. \pre the surface is changed
void apply(QuadTable& table, const PlannedChange& plan);

} // namespace vdbcage::detail
