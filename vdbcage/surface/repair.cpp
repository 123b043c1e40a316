// Repair by CGAL's Polygon_mesh_processing and Triangulation_2, which are GPL: this file is compiled only with
// VDBCAGE_WITH_CGAL_GPL.
// Based on: Zhou, Grinspun, Zorin, Jacobson, Mesh Arrangements for Solid Geometry, SIGGRAPH 2016 (Arrangement).
// Differs: winding numbers by a ray from each piece of surface instead of cells; coplanar triangles are cut together.

#include <vdbcage/surface/repair.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <CGAL/config.h>
#if CGAL_VERSION_NR < 1060200000
#include <CGAL/Polygon_mesh_processing/border.h>
#else
#include <CGAL/boost/graph/border.h>
#endif
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/stitch_borders.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/intersections.h>
#include <vdbcage/core/detail/held_by.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/topology.h>
#include <vdbcage/surface/detail/meetings.h>
#include <vdbcage/surface/detail/pull_apart.h>

namespace vdbcage {

namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
using Point = Kernel::Point_3;
using Polygon = std::vector<std::size_t>;
using Edge = std::array<std::size_t, 2>; // its points, the smaller index first
using Index = std::uint32_t;
using detail::Meetings;
using detail::UnionFind;

/// The soup in CGAL's form for polygon soups. Faces have three or four corners.
struct Soup {
    std::vector<Point> points;
    std::vector<Polygon> faces;

    const Point& corner(const Polygon& face, std::size_t i) const { return points[face[i % face.size()]]; }
};

/// Converts to faces in the order of the mesh: triangles first, then quads.
Soup toSoup(const Mesh& mesh)
{
    Soup soup;
    for (const openvdb::Vec3d& p : mesh.points) soup.points.emplace_back(p.x(), p.y(), p.z());
    for (const openvdb::Vec3I& t : mesh.triangles) soup.faces.push_back({t[0], t[1], t[2]});
    for (const openvdb::Vec4I& q : mesh.quads) soup.faces.push_back({q[0], q[1], q[2], q[3]});
    return soup;
}

/// Converts to a mesh. Faces keep their order, except for quads, which come last.
Mesh toMesh(const Soup& soup)
{
    Mesh mesh;
    for (const Point& p : soup.points) mesh.points.emplace_back(p.x(), p.y(), p.z());
    const auto index = [](std::size_t i) { return static_cast<Index>(i); };
    for (const Polygon& f : soup.faces) {
        if (f.size() == 3) {
            mesh.triangles.emplace_back(index(f[0]), index(f[1]), index(f[2]));
        } else {
            mesh.quads.emplace_back(index(f[0]), index(f[1]), index(f[2]), index(f[3]));
        }
    }
    return mesh;
}

/// Returns for each edge the faces around it.
std::map<Edge, std::vector<Index>> facesAroundEdges(const std::vector<Polygon>& faces)
{
    std::map<Edge, std::vector<Index>> edges;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        for (std::size_t i = 0; i < faces[f].size(); ++i) {
            const std::size_t a = faces[f][i], b = faces[f][(i + 1) % faces[f].size()];
            edges[{std::min(a, b), std::max(a, b)}].push_back(static_cast<Index>(f));
        }
    }
    return edges;
}

/// Returns the sets of faces that are connected over edges.
UnionFind partsOf(const std::vector<Polygon>& faces)
{
    UnionFind parts(faces.size());
    for (const auto& edge : facesAroundEdges(faces)) {
        for (const Index face : edge.second) parts.unite(edge.second[0], face);
    }
    return parts;
}

double areaOf(const Soup& soup, const Polygon& face)
{
    double sum = 0;
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        sum += std::sqrt(CGAL::squared_area(soup.corner(face, 0), soup.corner(face, i), soup.corner(face, i + 1)));
    }
    return sum;
}

/// Returns the volume of the cone from `tip` over a face.
double volumeOf(const Soup& soup, const Polygon& face, const Point& tip)
{
    double sum = 0;
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
        sum += CGAL::volume(tip, soup.corner(face, 0), soup.corner(face, i), soup.corner(face, i + 1));
    }
    return sum;
}

RepairMeasures measuresOf(const Soup& soup)
{
    RepairMeasures result;
    UnionFind parts = partsOf(soup.faces);
    std::set<Index> roots;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        roots.insert(parts.find(static_cast<Index>(f)));
        result.area += areaOf(soup, soup.faces[f]);
        result.volume += volumeOf(soup, soup.faces[f], soup.corner(soup.faces[0], 0));
    }
    result.faces = soup.faces.size();
    result.parts = roots.size();
    return result;
}

bool isDegenerate(const Soup& soup, const Polygon& face, const std::array<std::size_t, 3>& corners)
{
    return CGAL::collinear(soup.corner(face, corners[0]), soup.corner(face, corners[1]), soup.corner(face, corners[2]));
}

/// Returns the two triangles of a quad with the diagonal of corner `first` and the one opposite.
std::array<Polygon, 2> halves(const Polygon& quad, std::size_t first)
{
    const auto corner = [&](std::size_t i) { return quad[(first + i) % 4]; };
    return {Polygon{corner(0), corner(1), corner(2)}, Polygon{corner(0), corner(2), corner(3)}};
}

void removeFaces(Soup& soup, const std::vector<bool>& gone)
{
    std::vector<Polygon> kept;
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        if (!gone[f]) kept.push_back(std::move(soup.faces[f]));
    }
    soup.faces = std::move(kept);
}

/// Drops corners that follow themselves, faces with fewer than three corners left, and quads with equal opposite
/// corners. Quads with a degenerate half become the triangles of their other diagonal.
void simplifyFaces(Soup& soup)
{
    std::vector<Polygon> faces;
    for (Polygon& face : soup.faces) {
        face.erase(std::unique(face.begin(), face.end()), face.end());
        if (face.size() > 1 && face.front() == face.back()) face.pop_back();
        if (face.size() < 3) continue;
        if (face.size() == 3) {
            faces.push_back(face);
            continue;
        }
        if (face[0] == face[2] || face[1] == face[3]) continue;
        const bool firstIsBad = isDegenerate(soup, face, {0, 1, 2}) || isDegenerate(soup, face, {0, 2, 3});
        const bool secondIsBad = isDegenerate(soup, face, {1, 2, 3}) || isDegenerate(soup, face, {1, 3, 0});
        if (!firstIsBad && !secondIsBad) {
            faces.push_back(face);
        } else {
            for (const Polygon& half : halves(face, firstIsBad ? 1 : 0)) faces.push_back(half);
        }
    }
    soup.faces = std::move(faces);
}

/// Removes a degenerate triangle. The face beyond its longest side is split at the corner on that side, so that no gap
/// is left.
void removeDegenerate(Soup& soup, std::size_t index)
{
    const Polygon t = soup.faces[index];
    soup.faces.erase(soup.faces.begin() + static_cast<std::ptrdiff_t>(index));
    std::size_t middle = 0;
    while (middle < 2 && !CGAL::collinear_are_strictly_ordered_along_line(
                             soup.corner(t, middle + 2), soup.corner(t, middle), soup.corner(t, middle + 1))) {
        ++middle;
    }
    const std::size_t between = t[middle], a = t[(middle + 1) % 3], b = t[(middle + 2) % 3];
    std::vector<Polygon> more;
    for (Polygon& face : soup.faces) {
        if (std::find(face.begin(), face.end(), between) != face.end()) continue;
        for (std::size_t i = 0; i < face.size(); ++i) {
            const std::size_t from = face[i], to = face[(i + 1) % face.size()];
            if (!(from == a && to == b) && !(from == b && to == a)) continue;
            std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>((i + 1) % face.size()), face.end());
            for (std::size_t k = 1; k + 1 < face.size(); ++k) more.push_back({between, face[k], face[k + 1]});
            face = {between, face[0], face[1]};
            break;
        }
    }
    soup.faces.insert(soup.faces.end(), more.begin(), more.end());
}

/// Merges points at one place, and removes degenerate faces and copies of faces.
void clean(Soup& soup, RepairReport& report, Interrupter* interrupter)
{
    report.mergedPoints += pmp::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
    std::size_t before = soup.faces.size();
    simplifyFaces(soup);
    report.removedFaces += before - std::min(before, soup.faces.size());
    for (bool found = true; found;) { // a face that was split may then be degenerate
        found = false;
        for (std::size_t f = 0; f < soup.faces.size();) {
            if (soup.faces[f].size() != 3 || !isDegenerate(soup, soup.faces[f], {0, 1, 2})) {
                ++f;
                continue;
            }
            throwIfInterrupted(interrupter);
            removeDegenerate(soup, f);
            ++report.removedFaces;
            found = true;
        }
    }
    before = soup.faces.size();
    pmp::merge_duplicate_polygons_in_polygon_soup(
        soup.points, soup.faces, pmp::parameters::erase_all_duplicates(false).require_same_orientation(false));
    report.removedFaces += before - soup.faces.size();
}

/// Removes pieces of surface that hang in edges with more than two faces: first those with a boundary, then the
/// smallest, which of three that share their edges is the wall between the other two. Where an even number of faces
/// shares an edge, parts touch, and no piece without a boundary is removed.
void removeHanging(Soup& soup, RepairReport& report, Interrupter* interrupter)
{
    struct Piece {
        double area = 0;
        bool isOpen = false;
        std::vector<Index> faces;
        std::vector<std::size_t*> counts; // of the faces at each edge where it hangs, once a face
    };
    for (bool found = true; found;) { // the rest may be connected in other ways
        throwIfInterrupted(interrupter);
        found = false;
        const auto edges = facesAroundEdges(soup.faces);
        UnionFind connected(soup.faces.size());
        for (const auto& edge : edges) {
            if (edge.second.size() == 2) connected.unite(edge.second[0], edge.second[1]);
        }
        std::map<Index, Piece> pieces;
        for (Index f = 0; f < soup.faces.size(); ++f) {
            Piece& piece = pieces[connected.find(f)];
            piece.area += areaOf(soup, soup.faces[f]);
            piece.faces.push_back(f);
        }
        std::vector<std::size_t> counts;
        counts.reserve(edges.size());
        for (const auto& edge : edges) {
            counts.push_back(edge.second.size());
            for (const Index face : edge.second) {
                Piece& piece = pieces[connected.find(face)];
                piece.isOpen |= edge.second.size() == 1;
                if (edge.second.size() > 2) piece.counts.push_back(&counts.back());
            }
        }
        std::vector<const Piece*> order;
        for (const auto& piece : pieces) order.push_back(&piece.second);
        std::stable_sort(order.begin(), order.end(), [](const Piece* a, const Piece* b) {
            return a->isOpen != b->isOpen ? a->isOpen : a->area < b->area;
        });
        std::vector<bool> gone(soup.faces.size());
        for (const Piece* piece : order) {
            const auto& at = piece->counts;
            // Two faces of other pieces share an edge with it.
            const bool hangs = std::any_of(at.begin(), at.end(), [&](const std::size_t* n) {
                return *n >= 2 + static_cast<std::size_t>(std::count(at.begin(), at.end(), n));
            });
            const bool touches =
                std::any_of(at.begin(), at.end(), [](const std::size_t* n) { return *n > 2 && *n % 2 == 0; });
            if (!hangs || (touches && !piece->isOpen)) continue;
            for (std::size_t* n : at) --*n;
            for (const Index face : piece->faces) gone[face] = true;
            report.hangingFaces += piece->faces.size();
            found = true;
        }
        removeFaces(soup, gone);
    }
}

/// Reverses parts that enclose a negative volume.
void turnOutward(Soup& soup)
{
    UnionFind parts = partsOf(soup.faces);
    std::map<Index, double> volumes;
    const auto partOf = [&](std::size_t f) { return parts.find(static_cast<Index>(f)); };
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        // Relative to a point of the part, so that the volume of parts far away is exact enough.
        volumes[partOf(f)] += volumeOf(soup, soup.faces[f], soup.corner(soup.faces[partOf(f)], 0));
    }
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        if (volumes[partOf(f)] < 0) std::reverse(soup.faces[f].begin(), soup.faces[f].end());
    }
}

/// Returns whether a face runs through the same places as another, the other way round.
bool isReversed(const Soup& soup, const Polygon& face, const std::array<Point, 2>& firstEdge)
{
    for (std::size_t i = 0; i < face.size(); ++i) {
        if (soup.corner(face, i) == firstEdge[1] && soup.corner(face, i + 1) == firstEdge[0]) return true;
    }
    return false;
}

/// Makes the soup an oriented 2-manifold: cuts vertices and edges of several sheets, stitches boundaries at one place,
/// fills holes, and turns parts outward.
void sew(Soup& soup, RepairReport& report)
{
    std::vector<std::array<Point, 2>> firstEdges;
    for (const Polygon& face : soup.faces) firstEdges.push_back({soup.corner(face, 0), soup.corner(face, 1)});
    const std::size_t pointsBefore = soup.points.size();
    pmp::orient_polygon_soup(soup.points, soup.faces);
    report.splitVertices += soup.points.size() - pointsBefore;
    Surface surface;
    pmp::polygon_soup_to_polygon_mesh(soup.points, soup.faces, surface);
    report.stitchedEdges += pmp::stitch_borders(surface);
    std::vector<Surface::Halfedge_index> borders;
#if CGAL_VERSION_NR < 1060200000
    pmp::extract_boundary_cycles(surface, std::back_inserter(borders));
#else
    CGAL::extract_boundary_cycles(surface, std::back_inserter(borders));
#endif
    report.unfilledHoles = 0;
    for (const Surface::Halfedge_index border : borders) {
        std::vector<Surface::Face_index> patch;
#if CGAL_VERSION_MAJOR < 6
        pmp::triangulate_hole(surface, border, std::back_inserter(patch));
#else
        pmp::triangulate_hole(surface, border, CGAL::parameters::face_output_iterator(std::back_inserter(patch)));
#endif
        ++(patch.empty() ? report.unfilledHoles : report.filledHoles);
    }
    surface.collect_garbage();
    soup = {};
    for (const Surface::Vertex_index v : surface.vertices()) soup.points.push_back(surface.point(v));
    for (const Surface::Face_index f : surface.faces()) {
        Polygon corners;
        for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(f))) corners.push_back(v);
        soup.faces.push_back(std::move(corners));
    }
    turnOutward(soup);
    // Faces keep their order; those of filled holes come last.
    for (std::size_t f = 0; f < firstEdges.size(); ++f) {
        report.reoriented |= isReversed(soup, soup.faces[f], firstEdges[f]);
    }
}

/// Returns the pairs of faces that meet. A quad folded over a diagonal makes a pair with itself.
std::set<std::array<Index, 2>> facesThatMeet(const Meetings& meetings, Interrupter* interrupter)
{
    std::set<std::array<Index, 2>> result;
    for (const Meetings::Pair& pair : meetings.pairs(interrupter)) {
        result.insert({meetings.triangles()[pair[0]].face, meetings.triangles()[pair[1]].face});
    }
    return result;
}

/// Returns whether a mesh is valid as CageCheck::valid says, except that volumes are rounded.
bool isValid(Mesh mesh, Interrupter* interrupter)
{
    const MeshTopology topology = analyzeTopology(mesh, interrupter);
    if (topology.boundaryEdges + topology.nonManifoldEdges + topology.misorientedEdges + topology.nonManifoldVertices >
        0) {
        return false;
    }
    const Soup soup = toSoup(mesh);
    std::vector<double> volumes(topology.components());
    std::vector<std::size_t> firstFaces(topology.components(), soup.faces.size());
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        std::size_t& first = firstFaces[topology.faceComponent[f]];
        first = std::min(first, f);
        volumes[topology.faceComponent[f]] += volumeOf(soup, soup.faces[f], soup.corner(soup.faces[first], 0));
    }
    if (std::any_of(volumes.begin(), volumes.end(), [](double volume) { return !(volume > 0); })) return false;
    const Meetings meetings(mesh);
    for (Index t = 0; t < meetings.triangles().size(); ++t) {
        if (meetings.isDegenerate(t)) return false;
    }
    return meetings.pairs(interrupter).empty();
}

/// Splits quads that meet others under only one diagonal by the other one; with `all` also those that meet others under
/// both.
Mesh withQuadsSplit(Mesh mesh, bool all, Interrupter* interrupter)
{
    std::vector<std::array<bool, 2>> meets(faceCount(mesh));
    const Meetings meetings(mesh);
    for (const Meetings::Pair& pair : meetings.pairs(interrupter)) {
        for (const Index i : pair) meets[meetings.triangles()[i].face][meetings.triangles()[i].diagonal] = true;
    }
    Soup soup = toSoup(mesh);
    for (std::size_t f = mesh.triangles.size(), count = soup.faces.size(); f < count; ++f) {
        if (!meets[f][0] && !(meets[f][1])) continue;
        if (meets[f][0] && meets[f][1] && !all) continue;
        const std::array<Polygon, 2> triangles = halves(soup.faces[f], meets[f][0] && !meets[f][1] ? 1 : 0);
        soup.faces[f] = triangles[0];
        soup.faces.push_back(triangles[1]);
    }
    return toMesh(soup);
}

/// The faces of a closed surface, cut where they meet, in exact arithmetic.
class Arrangement {
public:
    /// \pre triangles come first, and faces that meet others are triangles; it is a cycle (see MeshTopology)
    Arrangement(Soup soup, Interrupter* interrupter) : interrupter_(interrupter)
    {
        pmp::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
        for (const Point& p : soup.points) idOf({p.x(), p.y(), p.z()});
        for (const Polygon& face : soup.faces) {
            for (std::size_t i = 1; i + 1 < face.size(); ++i) triangles_.push_back({face[0], face[i], face[i + 1]});
        }
        Mesh mesh = toMesh(soup);
        const Meetings meetings(mesh);
        std::vector<std::set<Index>> others(soup.faces.size()); // the faces that a face meets
        UnionFind planes(soup.faces.size());                    // faces that overlap in a plane
        for (const auto& pair : facesThatMeet(meetings, interrupter)) {
            others[pair[0]].insert(pair[1]);
            others[pair[1]].insert(pair[0]);
            if (areCoplanar(soup, soup.faces[pair[0]], soup.faces[pair[1]])) planes.unite(pair[0], pair[1]);
        }
        std::map<Index, std::vector<Index>> inPlane;
        for (Index f = 0; f < soup.faces.size(); ++f) {
            if (others[f].empty()) {
                pieces_.push_back({soup.faces[f], 1});
            } else {
                inPlane[planes.find(f)].push_back(f);
            }
        }
        for (const auto& plane : inPlane) {
            throwIfInterrupted(interrupter);
            cut(soup.faces, plane.second, others);
        }
    }

    /// Returns the surface of the space with a winding number of 1 or more, rounded to double.
    Soup outside()
    {
        Soup result;
        for (const Exact::Point_3& p : points_) {
            result.points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
        }
        // Winding numbers are the same all over a piece of surface between cuts: one ray is enough, from its largest
        // face.
        UnionFind pieces = connected();
        std::map<Index, std::pair<double, Index>> largest;
        for (Index f = 0; f < pieces_.size(); ++f) {
            const double area = areaOf(result, pieces_[f].corners);
            const auto place = largest.emplace(pieces.find(f), std::make_pair(area, f)).first;
            if (area > place->second.first) place->second = {area, f};
        }
        std::map<Index, bool> isOutside;
        for (const auto& entry : largest) {
            const Piece& piece = pieces_[entry.second.second];
            const int winding = windingBefore(piece);
            isOutside[entry.first] = winding < 1 && winding + piece.layers >= 1;
        }
        for (Index f = 0; f < pieces_.size(); ++f) {
            if (isOutside[pieces.find(f)]) result.faces.push_back(pieces_[f].corners);
        }
        return result;
    }

private:
    /// A part of a face, or several parts on each other.
    struct Piece {
        Polygon corners;
        int layers; ///< the increase of the winding number behind it
    };
    using Triangulation =
        CGAL::Constrained_Delaunay_triangulation_2<Exact, CGAL::Default, CGAL::Exact_intersections_tag>;

    static bool areCoplanar(const Soup& soup, const Polygon& a, const Polygon& b)
    {
        return std::all_of(b.begin(), b.end(), [&](std::size_t point) {
            return CGAL::coplanar(soup.corner(a, 0), soup.corner(a, 1), soup.corner(a, 2), soup.points[point]);
        });
    }

    std::size_t idOf(const Exact::Point_3& p)
    {
        const auto place = ids_.emplace(p, points_.size());
        if (place.second) points_.push_back(p);
        return place.first->second;
    }

    /// Cuts triangles of one plane by each other and by the faces that they meet.
    void cut(const std::vector<Polygon>& faces, const std::vector<Index>& inPlane,
             const std::vector<std::set<Index>>& others)
    {
        const auto triangle = [&](Index f) {
            return Exact::Triangle_3(points_[faces[f][0]], points_[faces[f][1]], points_[faces[f][2]]);
        };
        // In two dimensions, along the axis to which the plane is steepest. The arithmetic is exact, so any axis not
        // parallel to the plane is right; x, y and that axis are right-handed.
        const Exact::Point_3 origin = triangle(inPlane[0])[0];
        const Exact::Vector_3 normal =
            CGAL::cross_product(triangle(inPlane[0])[1] - origin, triangle(inPlane[0])[2] - origin);
        int axis = 0;
        for (int i = 1; i < 3; ++i) {
            if (CGAL::abs(normal[i]) > CGAL::abs(normal[axis])) axis = i;
        }
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        const auto flat = [&](const Exact::Point_3& p) { return Exact::Point_2(p[x], p[y]); };
        const auto lifted = [&](const Exact::Point_2& p) {
            std::array<Exact::FT, 3> place;
            place[static_cast<std::size_t>(x)] = p.x();
            place[static_cast<std::size_t>(y)] = p.y();
            place[static_cast<std::size_t>(axis)] =
                origin[axis] - (normal[x] * (p.x() - origin[x]) + normal[y] * (p.y() - origin[y])) / normal[axis];
            return Exact::Point_3(place[0], place[1], place[2]);
        };

        Triangulation cuts;
        std::vector<Exact::Triangle_2> members;
        for (const Index f : inPlane) {
            const Exact::Triangle_3 t = triangle(f);
            members.emplace_back(flat(t[0]), flat(t[1]), flat(t[2]));
            for (int i = 0; i < 3; ++i) cuts.insert_constraint(flat(t[i]), flat(t[i + 1]));
        }
        for (const Index f : inPlane) {
            for (const Index other : others[f]) {
                if (std::find(inPlane.begin(), inPlane.end(), other) != inPlane.end()) continue;
                throwIfInterrupted(interrupter_);
                const auto meeting = CGAL::intersection(triangle(f), triangle(other));
                if (!meeting) continue;
                if (const auto* point = detail::heldBy<Exact::Point_3>(*meeting)) cuts.insert(flat(*point));
                if (const auto* segment = detail::heldBy<Exact::Segment_3>(*meeting)) {
                    cuts.insert_constraint(flat(segment->source()), flat(segment->target()));
                }
            }
        }
        std::map<Triangulation::Vertex_handle, std::size_t> ids;
        for (auto face = cuts.finite_faces_begin(); face != cuts.finite_faces_end(); ++face) {
            const Exact::Point_2 middle =
                CGAL::centroid(face->vertex(0)->point(), face->vertex(1)->point(), face->vertex(2)->point());
            int layers = 0;
            for (const Exact::Triangle_2& member : members) {
                if (!member.has_on_unbounded_side(middle)) layers += member.orientation();
            }
            if (layers == 0) continue;
            Polygon corners;
            for (int i = 0; i < 3; ++i) {
                const auto vertex = face->vertex(i);
                const auto place = ids.emplace(vertex, 0);
                if (place.second) place.first->second = idOf(lifted(vertex->point()));
                corners.push_back(place.first->second);
            }
            if (layers < 0) std::reverse(corners.begin(), corners.end());
            pieces_.push_back({std::move(corners), std::abs(layers)});
        }
    }

    /// Returns the sets of pieces connected over edges at which the surface continues without a cut.
    UnionFind connected() const
    {
        std::vector<Polygon> faces;
        for (const Piece& piece : pieces_) faces.push_back(piece.corners);
        const auto runsAlong = [&](Index f, const Edge& edge) {
            for (std::size_t i = 0; i < faces[f].size(); ++i) {
                if (faces[f][i] == edge[0] && faces[f][(i + 1) % faces[f].size()] == edge[1]) return true;
            }
            return false;
        };
        UnionFind result(pieces_.size());
        for (const auto& edge : facesAroundEdges(faces)) {
            if (edge.second.size() != 2) continue;
            const Index a = edge.second[0], b = edge.second[1];
            if (pieces_[a].layers != pieces_[b].layers || runsAlong(a, edge.first) == runsAlong(b, edge.first))
                continue;
            result.unite(a, b);
        }
        return result;
    }

    /// Returns the winding number in front of a piece, by a ray from its middle that hits no edge.
    int windingBefore(const Piece& piece) const
    {
        const Exact::Point_3 &a = points_[piece.corners[0]], &b = points_[piece.corners[1]],
                             &c = points_[piece.corners[2]];
        const Exact::Point_3 from = CGAL::centroid(a, b, c);
        std::uint32_t state = 1;
        const auto random = [&] { // from -1 to 1
            state = state * 1664525U + 1013904223U;
            return static_cast<double>(state >> 16U) / 32768.0 - 1.0;
        };
        for (;;) {
            throwIfInterrupted(interrupter_);
            const double x = random(), y = random(), z = random();
            Exact::Vector_3 along(x, y, z);
            const Exact::FT slope = along * CGAL::normal(a, b, c);
            if (slope == 0) continue;
            if (slope < 0) along = -along;
            if (const std::optional<int> winding = windingAlong(from, along)) return *winding;
        }
    }

    /// Returns the winding number along a ray; nothing if the ray meets an edge. Triangles on which it starts do not
    /// count.
    std::optional<int> windingAlong(const Exact::Point_3& from, const Exact::Vector_3& along) const
    {
        const Exact::Point_3 to = from + along;
        int winding = 0;
        for (const std::array<std::size_t, 3>& t : triangles_) {
            const Exact::Point_3 &p = points_[t[0]], &q = points_[t[1]], &r = points_[t[2]];
            // The line passes the three edges on the same side.
            const CGAL::Orientation first = CGAL::orientation(from, to, p, q),
                                    second = CGAL::orientation(from, to, q, r);
            if (first != CGAL::COPLANAR && second != CGAL::COPLANAR && first != second) continue;
            const CGAL::Orientation third = CGAL::orientation(from, to, r, p);
            const auto [low, high] = std::minmax({first, second, third});
            if (low == CGAL::NEGATIVE && high == CGAL::POSITIVE) continue;
            const CGAL::Orientation side = CGAL::orientation(p, q, r, from);
            const CGAL::Sign slope = CGAL::sign(along * CGAL::normal(p, q, r));
            // The ray starts on the triangle, or goes away from it.
            if (slope != CGAL::ZERO && (side == CGAL::COPLANAR || side == slope)) continue;
            if (slope == CGAL::ZERO && side != CGAL::COPLANAR) continue;
            if (low == CGAL::COPLANAR || high == CGAL::COPLANAR) return std::nullopt;
            winding += slope;
        }
        return winding;
    }

    Interrupter* interrupter_;
    std::map<Exact::Point_3, std::size_t> ids_;
    std::vector<Exact::Point_3> points_;
    std::vector<std::array<std::size_t, 3>> triangles_; ///< as given
    std::vector<Piece> pieces_;
};

Mesh turnedOutward(const Mesh& mesh)
{
    Soup soup = toSoup(mesh);
    turnOutward(soup);
    return toMesh(soup);
}

std::size_t countMeetings(Mesh mesh, Interrupter* interrupter)
{
    return facesThatMeet(Meetings(mesh), interrupter).size();
}

/// Returns the number of faces of one soup that the other lacks, wherever their points are in the lists.
std::size_t countMissing(const Soup& from, const Soup& in)
{
    const auto places = [](const Soup& soup, const Polygon& face) {
        std::vector<Point> result;
        for (const std::size_t point : face) result.push_back(soup.points[point]);
        std::sort(result.begin(), result.end());
        return result;
    };
    std::set<std::vector<Point>> there;
    for (const Polygon& face : in.faces) there.insert(places(in, face));
    return static_cast<std::size_t>(std::count_if(from.faces.begin(), from.faces.end(), [&](const Polygon& face) {
        return there.count(places(from, face)) == 0;
    }));
}

/// Makes of parts that meet each other or themselves the surface of the enclosed space, if fewer faces meet then.
Soup resolved(const Soup& group, RepairReport& report, Interrupter* interrupter)
{
    constexpr int rounds = 3; // rounding to double may let some faces meet again
    const std::size_t movedBefore = report.movedPoints;
    Mesh best = withQuadsSplit(toMesh(group), true, interrupter);
    std::size_t least = countMeetings(best, interrupter);
    bool isBetter = false;
    for (int round = 0; round < rounds && least > 0 && analyzeTopology(best, interrupter).isCycle(); ++round) {
        Soup outside = Arrangement(toSoup(best), interrupter).outside();
        if (outside.faces.empty()) break;
        RepairReport ofPieces; // does not concern the given cage
        clean(outside, ofPieces, interrupter);
        removeHanging(outside, ofPieces, interrupter);
        sew(outside, ofPieces);
        Mesh mesh = toMesh(outside);
        const std::size_t moved = detail::pullApart(mesh, false, interrupter);
        mesh = turnedOutward(withQuadsSplit(std::move(mesh), true, interrupter));
        const std::size_t left = countMeetings(mesh, interrupter);
        if (left >= least || ofPieces.unfilledHoles > 0) break;
        best = std::move(mesh);
        least = left;
        isBetter = true;
        report.movedPoints += moved;
    }
    if (!isBetter) {
        report.movedPoints = movedBefore;
        return group;
    }
    Soup result = toSoup(best);
    report.cutFaces += countMissing(group, result);
    return result;
}

/// Resolves each group of parts that meet. Other parts stay unchanged.
Mesh withGroupsResolved(Mesh mesh, RepairReport& report, Interrupter* interrupter)
{
    const auto meeting = facesThatMeet(Meetings(mesh), interrupter);
    if (meeting.empty() || meeting.size() >= Meetings::most) return mesh;
    const Soup soup = toSoup(mesh);
    UnionFind groups = partsOf(soup.faces);
    for (const auto& pair : meeting) groups.unite(pair[0], pair[1]);
    std::map<Index, Soup> soups; // of groups that meet
    for (const auto& pair : meeting) soups[groups.find(pair[0])].points = soup.points;
    Soup result;
    result.points = soup.points;
    for (Index f = 0; f < soup.faces.size(); ++f) {
        const auto place = soups.find(groups.find(f));
        (place == soups.end() ? result : place->second).faces.push_back(soup.faces[f]);
    }
    for (auto& entry : soups) {
        pmp::remove_isolated_points_in_polygon_soup(entry.second.points, entry.second.faces);
        Soup group = resolved(entry.second, report, interrupter);
        for (Polygon& face : group.faces) {
            for (std::size_t& point : face) point += result.points.size();
            result.faces.push_back(std::move(face));
        }
        result.points.insert(result.points.end(), group.points.begin(), group.points.end());
    }
    pmp::remove_isolated_points_in_polygon_soup(result.points, result.faces);
    return toMesh(result);
}

} // namespace

bool hasRepair()
{
    return true;
}

RepairedCage repair(const Mesh& cage, Interrupter* interrupter)
{
    requireUsable(cage, "cage");
    RepairReport report;
    Soup soup = toSoup(cage);
    if (isValid(cage, interrupter)) {
        report.before = report.after = measuresOf(soup);
        return {cage, report};
    }
    throwIfInterrupted(interrupter, 10);
    report.mergedPoints = pmp::merge_duplicate_points_in_polygon_soup(soup.points, soup.faces);
    report.before = measuresOf(soup);
    clean(soup, report, interrupter);
    removeHanging(soup, report, interrupter);
    throwIfInterrupted(interrupter, 20);
    sew(soup, report);
    report.before.volume = measuresOf(soup).volume;
    throwIfInterrupted(interrupter, 30);

    Mesh mesh = toMesh(soup);
    report.selfIntersectionsBefore = countMeetings(mesh, interrupter);
    if (report.selfIntersectionsBefore > 0) {
        mesh = withQuadsSplit(std::move(mesh), false, interrupter);
        throwIfInterrupted(interrupter, 40);
        report.movedPoints = detail::pullApart(mesh, true, interrupter);
        mesh = turnedOutward(mesh); // before, parts pulled through decided
        throwIfInterrupted(interrupter, 60);
        mesh = withGroupsResolved(std::move(mesh), report, interrupter);
    }
    throwIfInterrupted(interrupter, 90);
    report.selfIntersectionsAfter = countMeetings(mesh, interrupter);
    report.after = measuresOf(toSoup(mesh));
    return {std::move(mesh), report};
}

} // namespace vdbcage
