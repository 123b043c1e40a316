// Based on: Thürmer and Wüthrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998 (angle weights).
// Differs: the mean is taken over the faces that smooth edges join, so that creases stay sharp.

#include <tools/draw/geometry.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/detail/half_edges.h>

namespace vdbcage::draw {

namespace {

using Index = Geometry::Index;
using detail::EdgeTable;
using detail::HalfEdges;
using detail::UnionFind;
using openvdb::Vec3d;

Vec3f toFloat(const Vec3d& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Vec3d unitOrZero(const Vec3d& v)
{
    const double length = v.length();
    return length > 0 ? v / length : Vec3d(0);
}

/// Returns for each point the one that represents all at its place. Points that no face uses (they may be anything)
/// represent themselves.
std::vector<Index> weld(const Mesh& mesh)
{
    const HalfEdges halfEdges(mesh);
    std::vector<Index> used(halfEdges.size());
    for (std::size_t h = 0; h < used.size(); ++h) used[h] = halfEdges.from(h);
    const auto key = [&](Index i) {
        const Vec3d& p = mesh.points[i];
        return std::make_tuple(p.x(), p.y(), p.z(), i);
    };
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::sort(used.begin(), used.end(), [&](Index a, Index b) { return key(a) < key(b); });
    std::vector<Index> same(mesh.points.size());
    std::iota(same.begin(), same.end(), Index(0));
    for (std::size_t i = 1; i < used.size(); ++i) {
        if (mesh.points[used[i]] == mesh.points[used[i - 1]]) same[used[i]] = same[used[i - 1]];
    }
    return same;
}

/// Returns the mesh with one point for each place that its faces use, in drawing coordinates.
Mesh weldedMesh(const Mesh& mesh, const Frame& frame)
{
    const std::vector<Index> same = weld(mesh);
    Mesh welded;
    welded.points.resize(mesh.points.size());
    welded.triangles = mesh.triangles;
    welded.quads = mesh.quads;
    const auto rename = [&](auto& faces, int size) {
        for (auto& face : faces) {
            for (int i = 0; i < size; ++i) {
                face[i] = same[face[i]];
                welded.points[face[i]] = frame.toDrawing(mesh.points[face[i]]);
            }
        }
    };
    rename(welded.triangles, 3);
    rename(welded.quads, 4);
    return welded;
}

template <typename Face>
Vec3d faceNormal(const std::vector<Vec3d>& points, const Face& face)
{
    const Vec3d& first = points[face[0]];
    if constexpr (Face::size == 3) {
        return unitOrZero((points[face[1]] - first).cross(points[face[2]] - first));
    } else {
        return unitOrZero((points[face[2]] - first).cross(points[face[3]] - points[face[1]])); // diagonals
    }
}

template <typename Face>
double angleAt(const std::vector<Vec3d>& points, const Face& face, int corner)
{
    const Vec3d& apex = points[face[corner]];
    const Vec3d a = points[face[(corner + 1) % Face::size]] - apex;
    const Vec3d b = points[face[(corner + Face::size - 1) % Face::size]] - apex;
    return std::atan2(a.cross(b).length(), a.dot(b));
}

/// Joins the corners at both ends of each smooth edge.
UnionFind joinSmooth(const Mesh& mesh, const HalfEdges& halfEdges, const EdgeTable& edges, double creaseDegrees)
{
    UnionFind sets(halfEdges.size());
    if (creaseDegrees <= 0) return sets;
    std::vector<Vec3d> normals;
    normals.reserve(faceCount(mesh));
    for (const openvdb::Vec3I& triangle : mesh.triangles) normals.push_back(faceNormal(mesh.points, triangle));
    for (const openvdb::Vec4I& quad : mesh.quads) normals.push_back(faceNormal(mesh.points, quad));
    const double smooth = std::cos(creaseDegrees * detail::pi / 180);
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const EdgeTable::Span both = edges[edge];
        if (both.size() != 2) continue;
        const std::size_t one = both[0], two = both[1];
        if (normals[halfEdges.face(one)].dot(normals[halfEdges.face(two)]) <= smooth) continue;
        const bool opposed = halfEdges.from(one) == halfEdges.to(two);
        const auto join = [&](std::size_t a, std::size_t b) {
            sets.unite(static_cast<Index>(a), static_cast<Index>(b));
        };
        join(one, opposed ? halfEdges.next(two) : two);
        join(halfEdges.next(one), opposed ? two : halfEdges.next(two));
    }
    return sets;
}

} // namespace

Geometry::Geometry(const Mesh& mesh, const Frame& frame, double creaseDegrees)
    : frame_(frame), pointCount_(mesh.points.size())
{
    const Mesh welded = weldedMesh(mesh, frame);
    const HalfEdges halfEdges(welded);
    const EdgeTable edges(halfEdges, welded.points.size());
    UnionFind sets = joinSmooth(welded, halfEdges, edges, creaseDegrees);

    // A set's first corner represents it, so it comes before the others.
    std::vector<Index> vertices(halfEdges.size());
    for (Index corner = 0; corner < vertices.size(); ++corner) {
        const Index first = sets.find(corner);
        if (first == corner) {
            vertices[corner] = static_cast<Index>(pointOfVertex_.size());
            pointOfVertex_.push_back(halfEdges.from(corner));
        } else {
            vertices[corner] = vertices[first];
        }
    }
    const Index* corner = vertices.data();
    meshTriangles_.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i, corner += 3) {
        meshTriangles_.emplace_back(corner[0], corner[1], corner[2]);
        triangles_.push_back({corner[0], corner[1], corner[2]});
    }
    meshQuads_.reserve(mesh.quads.size());
    for (std::size_t i = 0; i < mesh.quads.size(); ++i, corner += 4) {
        meshQuads_.emplace_back(corner[0], corner[1], corner[2], corner[3]);
        triangles_.push_back({corner[0], corner[1], corner[2]});
        triangles_.push_back({corner[0], corner[2], corner[3]});
    }
    edges_.reserve(edges.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const std::size_t h = edges[edge][0];
        const Index from = vertices[h], to = vertices[halfEdges.next(h)];
        if (halfEdges.from(h) < halfEdges.to(h)) {
            edges_.push_back({from, to});
        } else {
            edges_.push_back({to, from});
        }
    }
    setPoints(mesh.points);
}

Geometry::Geometry(const std::vector<std::pair<Vec3d, Vec3d>>& lines, const Frame& frame)
    : frame_(frame), pointCount_(2 * lines.size())
{
    std::vector<Vec3d> points;
    for (const auto& [from, to] : lines) {
        const auto first = static_cast<Index>(points.size());
        points.push_back(from);
        points.push_back(to);
        edges_.push_back({first, first + 1});
    }
    pointOfVertex_.resize(points.size());
    std::iota(pointOfVertex_.begin(), pointOfVertex_.end(), Index(0));
    setPoints(points);
}

void Geometry::setPoints(const std::vector<Vec3d>& points)
{
    if (points.size() != pointCount_) {
        throw InputError("picture", std::to_string(points.size()) + " points were given for a mesh of " +
                                        std::to_string(pointCount_) + "; one for each is needed");
    }
    std::vector<Vec3d> places(pointOfVertex_.size());
    for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
        const Vec3d& point = points[pointOfVertex_[vertex]];
        if (!point.isFinite()) {
            throw InputError("picture", "point " + std::to_string(pointOfVertex_[vertex]) +
                                            " is not finite; a point of a face must be");
        }
        places[vertex] = frame_.toDrawing(point);
    }
    std::vector<Vec3d> sums(places.size(), Vec3d(0));
    const auto add = [&](const auto& faces, int size) {
        for (const auto& face : faces) {
            const Vec3d normal = faceNormal(places, face);
            for (int i = 0; i < size; ++i) sums[face[i]] += angleAt(places, face, i) * normal;
        }
    };
    add(meshTriangles_, 3);
    add(meshQuads_, 4);
    positions_.resize(places.size());
    normals_.resize(places.size());
    for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
        positions_[vertex] = toFloat(places[vertex]);
        normals_[vertex] = toFloat(unitOrZero(sums[vertex]));
    }
}

} // namespace vdbcage::draw
