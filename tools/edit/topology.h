#pragma once

#include <optional>

#include <tools/edit/elements.h>

/// The smallest edits of a mesh. Edges and faces are numbered as Elements numbers them.
///
/// The mesh must be a closed 2-manifold, and so is the result, of the same Euler characteristic. No edit leaves a point
/// with fewer than three edges. Points that remain keep their order. Faces that remain keep theirs, among triangles and
/// among quads; new ones follow them. The alternatives of a mesh are dropped.
///
/// Edits that would break this are refused, and those that would turn a face over or leave one without area. A face
/// turns over if its normal is at a right angle or more to that of a face which it replaces; a quad's is the cross
/// product of its diagonals. All of them throw InputError, which names the edge or face and the reason. Cost: O(n log
/// n).
namespace vdbcage::edit {

/// Puts a point, the last one, in the middle of an edge. A triangle beside it becomes two. A quad becomes three
/// triangles: one at each end of the edge, one at the opposite side.
Mesh splitEdge(const Mesh& mesh, Index edge);

/// Collapses an edge to its middle. The smaller index remains. Triangles beside the edge vanish, quads become
/// triangles.
///
/// Refused unless the link condition holds: the only points joined to both ends by edges are the third corners of the
/// triangles beside it.
/// Based on: Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving edge contraction, 1999.
Mesh collapseEdge(const Mesh& mesh, Index edge);

/// Turns the edge between two triangles to their other corners. Each new triangle replaces both old ones. Refused if
/// these have an edge already, or if an end of the edge would be left with two edges.
Mesh flipEdge(const Mesh& mesh, Index edge);

/// Makes a quad of the two triangles beside an edge. It must be convex under both diagonals and no corner above 160
/// degrees. Under both diagonals its fold must be less than 60 degrees.
Mesh mergeFaces(const Mesh& mesh, Index edge);

/// A quad's diagonal, by the corners that it joins.
enum class Diagonal : std::uint8_t { from0to2, from1to3 };

/// Makes two triangles of a quad: by the given diagonal, or else by the shorter one (of equal ones from0to2). Refused
/// if its ends have an edge already.
Mesh cutQuad(const Mesh& mesh, Index face, std::optional<Diagonal> diagonal = std::nullopt);

} // namespace vdbcage::edit
