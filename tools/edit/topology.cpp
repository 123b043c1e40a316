// Based on: Dey, Edelsbrunner, Guha and Nekhayev, Topology preserving edge contraction, 1999.
// Differs: quads beside a collapsed edge become triangles, so the link condition is tested on points, and the result is
// examined.
#include <tools/edit/topology.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/geometry/quad_shape.h>
#include <vdbcage/mesh/detail/degenerate.h>
#include <vdbcage/mesh/topology.h>

namespace vdbcage::edit {

namespace {

using openvdb::Vec3d;

/// Three or four points.
using Polygon = std::vector<Index>;

/// Returns a normal of the face; its length is twice the area.
Vec3d normalOf(const std::vector<Vec3d>& points, const Polygon& face)
{
    const Vec3d &a = points[face[0]], &c = points[face[2]];
    return face.size() == 3 ? (points[face[1]] - a).cross(c - a) : (c - a).cross(points[face[3]] - points[face[1]]);
}

/// A face that replaces another one in an edit.
struct Replacement {
    Polygon corners;
    Vec3d oldNormal;
};

bool isClosedManifold(const MeshTopology& topology)
{
    return topology.isCycle() && topology.boundaryEdges == 0 && topology.nonManifoldEdges == 0 &&
           topology.misorientedEdges == 0 && topology.nonManifoldVertices == 0;
}

/// One edit of a mesh: the surroundings of an edge or face, and the result.
class Edit {
public:
    /// Prepares an edit of the edge or face `id`.
    /// \throw InputError it is none; the mesh cannot be edited
    Edit(const Mesh& mesh, Element kind, Index id)
        : kind_(kind), id_(id), elements_(checked(mesh)), topology_(analyzeTopology(mesh))
    {
        if (id >= elements_.count(kind)) {
            fail("there are " + std::to_string(elements_.count(kind)) + " " + elementsName(kind) + ", counted from 0");
        }
        if (!isClosedManifold(topology_)) fail("the mesh is no closed 2-manifold, and edits need one");
    }

    const Elements& elements() const { return elements_; }

    [[noreturn]] void fail(const std::string& problem) const
    {
        throw InputError((kind_ == Element::edge ? "edge " : "face ") + std::to_string(id_), problem);
    }

    Polygon cornersOf(Index face) const
    {
        const Ids ids = elements_.pointsOfFace(face);
        return {ids.begin(), ids.end()};
    }

    /// A face beside the edge, its corners turned so that the edge is from the first to the second one.
    struct Side {
        Index face;
        Polygon corners;
    };
    /// Returns both sides: along the edge from its smaller point to its larger one, then the other way.
    std::pair<Side, Side> sides() const
    {
        const Ids faces = elements_.facesOfEdge(id_);
        if (faces.size() != 2) fail("a face uses it twice");
        const Index low = elements_.edges()[id_].first;
        const auto side = [&](Index face) {
            Side result{face, cornersOf(face)};
            const Ids edges = elements_.edgesOfFace(face);
            std::rotate(result.corners.begin(),
                        result.corners.begin() + (std::find(edges.begin(), edges.end(), id_) - edges.begin()),
                        result.corners.end());
            return result;
        };
        Side one = side(faces[0]), other = side(faces[1]);
        if (one.corners[0] != low) std::swap(one, other);
        return {std::move(one), std::move(other)};
    }

    /// Returns both sides, which must be triangles.
    std::pair<Side, Side> triangles() const
    {
        auto both = sides();
        if (both.first.corners.size() != 3 || both.second.corners.size() != 3) {
            fail("a quad is beside it; both faces must be triangles");
        }
        return both;
    }

    void requireEdgesAt(Index point, std::size_t fewest) const
    {
        const std::size_t count = elements_.edgesOfPoint(point).size();
        if (count >= fewest) return;
        fail("point " + std::to_string(point) + " would have " + std::to_string(count - 1) +
             " edges left; a point must have 3 or more");
    }

    void requireNoEdge(Index a, Index b) const
    {
        if (elements_.edgeBetween(a, b) == none) return;
        fail("points " + std::to_string(a) + " and " + std::to_string(b) + " have an edge already");
    }

    /// Returns the mesh with `added` instead of the faces `gone`, at `points`, and with corners renamed by
    /// `rename(corner)` in all faces that stay.
    template <typename Rename>
    Mesh replaced(std::vector<Vec3d> points, std::vector<Index> gone, const std::vector<Replacement>& added,
                  const Rename& rename) const
    {
        for (const Replacement& face : added) requireUpright(points, face);
        std::sort(gone.begin(), gone.end());
        Mesh result;
        result.points = std::move(points);
        const auto add = [&](const Polygon& c) {
            if (c.size() == 3) {
                result.triangles.emplace_back(rename(c[0]), rename(c[1]), rename(c[2]));
            } else {
                result.quads.emplace_back(rename(c[0]), rename(c[1]), rename(c[2]), rename(c[3]));
            }
        };
        for (Index face = 0; face < elements_.count(Element::face); ++face) {
            if (!std::binary_search(gone.begin(), gone.end(), face)) add(cornersOf(face));
        }
        for (const Replacement& face : added) add(face.corners);
        const MeshTopology topology = analyzeTopology(result);
        if (!isClosedManifold(topology) || topology.eulerCharacteristic() != topology_.eulerCharacteristic()) {
            fail("the surface would be no closed 2-manifold, or another one");
        }
        return result;
    }

    Mesh replaced(std::vector<Vec3d> points, std::vector<Index> gone, const std::vector<Replacement>& added) const
    {
        return replaced(std::move(points), std::move(gone), added, [](Index point) { return point; });
    }

private:
    static const Mesh& checked(const Mesh& mesh)
    {
        requireUsable(mesh, "mesh");
        return mesh;
    }

    void requireUpright(const std::vector<Vec3d>& points, const Replacement& face) const
    {
        const Polygon& c = face.corners;
        const bool isFlat = c.size() == 3 ? detail::isDegenerate(points[c[0]], points[c[1]], points[c[2]])
                                          : detail::isDegenerate(points[c[0]], points[c[1]], points[c[2]]) ||
                                                detail::isDegenerate(points[c[0]], points[c[2]], points[c[3]]);
        if (isFlat) fail("a face would have no area");
        if (!(normalOf(points, c).dot(face.oldNormal) > 0)) fail("a face would turn over");
    }

    Element kind_;
    Index id_;
    Elements elements_;
    MeshTopology topology_;
};

} // namespace

Mesh splitEdge(const Mesh& mesh, Index edge)
{
    const Edit edit(mesh, Element::edge, edge);
    const auto [low, high] = edit.elements().edges()[edge];
    std::vector<Vec3d> points = mesh.points;
    const auto middle = static_cast<Index>(points.size());
    points.push_back(0.5 * points[low] + 0.5 * points[high]);
    const auto [one, other] = edit.sides();
    std::vector<Replacement> added;
    for (const Edit::Side& side : {one, other}) {
        const Polygon& c = side.corners;
        const Vec3d normal = normalOf(mesh.points, c);
        added.push_back({{c[0], middle, c.back()}, normal});
        added.push_back({{middle, c[1], c[2]}, normal});
        if (c.size() == 4) added.push_back({{middle, c[2], c[3]}, normal});
    }
    return edit.replaced(std::move(points), {one.face, other.face}, added);
}

Mesh collapseEdge(const Mesh& mesh, Index edge)
{
    const Edit edit(mesh, Element::edge, edge);
    const Elements& elements = edit.elements();
    const auto [kept, gone] = elements.edges()[edge];
    const auto [one, other] = edit.sides();

    std::size_t lost = 1; // edges of the two points
    for (const Edit::Side& side : {one, other}) {
        if (side.corners.size() != 3) continue;
        edit.requireEdgesAt(side.corners[2], 4);
        ++lost;
    }
    std::size_t common = 0;
    for (const Index at : elements.edgesOfPoint(kept)) {
        const auto [a, b] = elements.edges()[at];
        if (elements.edgeBetween(a == kept ? b : a, gone) != none) ++common;
    }
    if (common + 1 != lost) edit.fail("its ends have a common neighbour that is no corner of a triangle beside it");
    if (elements.edgesOfPoint(kept).size() + elements.edgesOfPoint(gone).size() < lost + 1 + 3) {
        edit.fail("its middle would have fewer than 3 edges");
    }

    std::vector<Vec3d> points = mesh.points;
    points[kept] = points[gone] = 0.5 * points[kept] + 0.5 * points[gone];
    std::vector<Index> changed;
    std::vector<Replacement> added;
    for (const Index end : {kept, gone}) {
        for (const Index face : elements.facesOfPoint(end)) {
            if (end == gone && (face == one.face || face == other.face)) continue; // handled at the first end
            Polygon corners = edit.cornersOf(face);
            const Vec3d normal = normalOf(mesh.points, corners);
            const bool isBeside = face == one.face || face == other.face;
            if (!isBeside && std::count(corners.begin(), corners.end(), end == gone ? kept : gone) > 0) {
                edit.fail("its ends are opposite corners of a quad");
            }
            std::replace(corners.begin(), corners.end(), gone, kept);
            if (isBeside) { // it has the point twice, side by side
                corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
                if (corners.front() == corners.back()) corners.pop_back();
            }
            changed.push_back(face);
            if (corners.size() >= 3) added.push_back({std::move(corners), normal});
        }
    }
    Mesh result = edit.replaced(std::move(points), changed, added,
                                [gone = gone](Index point) { return point > gone ? point - 1 : point; });
    result.points.erase(result.points.begin() + gone);
    return result;
}

Mesh flipEdge(const Mesh& mesh, Index edge)
{
    const Edit edit(mesh, Element::edge, edge);
    const auto [one, other] = edit.triangles();
    const Index a = one.corners[0], b = one.corners[1], c = one.corners[2], d = other.corners[2];
    edit.requireEdgesAt(a, 4);
    edit.requireEdgesAt(b, 4);
    edit.requireNoEdge(c, d);
    const Vec3d first = normalOf(mesh.points, one.corners), second = normalOf(mesh.points, other.corners);
    const Polygon atA{a, d, c}, atB{d, b, c};
    // Each new triangle replaces a part of both old ones.
    for (const Polygon& corners : {atA, atB}) {
        if (!(normalOf(mesh.points, corners).dot(second) > 0)) edit.fail("a face would turn over");
    }
    return edit.replaced(mesh.points, {one.face, other.face}, {{atA, first}, {atB, first}});
}

Mesh mergeFaces(const Mesh& mesh, Index edge)
{
    constexpr double leastCosine = 0.5; // of 60 degrees
    const Edit edit(mesh, Element::edge, edge);
    const auto [one, other] = edit.triangles();
    const Polygon quad{one.corners[0], other.corners[2], one.corners[1], one.corners[2]};
    edit.requireEdgesAt(quad[0], 4);
    edit.requireEdgesAt(quad[2], 4);
    double deviation = 0;
    const auto at = [&](std::size_t corner) { return mesh.points[quad[corner]]; };
    if (!detail::isConvexQuad({at(0), at(1), at(2), at(3)}, leastCosine, deviation)) {
        edit.fail("the quad would not be convex, with corners of at most 160 degrees and a fold of less than 60");
    }
    return edit.replaced(mesh.points, {one.face, other.face}, {{quad, normalOf(mesh.points, one.corners)}});
}

Mesh cutQuad(const Mesh& mesh, Index face, std::optional<Diagonal> diagonal)
{
    const Edit edit(mesh, Element::face, face);
    Polygon c = edit.cornersOf(face);
    if (c.size() != 4) edit.fail("it is a triangle; only quads are cut");
    const auto squaredLength = [&](std::size_t from) {
        return (mesh.points[c[from]] - mesh.points[c[from + 2]]).lengthSqr();
    };
    const Diagonal shorter = squaredLength(1) < squaredLength(0) ? Diagonal::from1to3 : Diagonal::from0to2;
    if (diagonal.value_or(shorter) == Diagonal::from1to3) std::rotate(c.begin(), c.begin() + 1, c.end());
    edit.requireNoEdge(c[0], c[2]);
    const Vec3d normal = normalOf(mesh.points, c);
    return edit.replaced(mesh.points, {face}, {{{c[0], c[1], c[2]}, normal}, {{c[0], c[2], c[3]}, normal}});
}

} // namespace vdbcage::edit
