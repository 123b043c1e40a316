// Based on: Thürmer and Wüthrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998 (angle weights).
// Differs: the mean is taken over the faces that smooth edges join, so that creases stay sharp.

#include <tools/draw/geometry.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include <vdbcage/core/error.h>

namespace vdbcage::draw {

namespace {

using Index = Geometry::Index;
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

/// Triangles, then quads, as indices of points: those of one face are consecutive.
struct Faces {
    const std::vector<Index>& corners;
    std::size_t triangles, quads;

    std::size_t count() const { return triangles + quads; }
    std::size_t size(std::size_t face) const { return face < triangles ? 3 : 4; }
    std::size_t first(std::size_t face) const
    {
        return face < triangles ? 3 * face : 3 * triangles + 4 * (face - triangles);
    }
    const Vec3d& at(const std::vector<Vec3d>& points, std::size_t face, std::size_t corner) const
    {
        return points[corners[first(face) + corner]];
    }
};

/// For each point the one that stands for all at its place. Points that no face uses (they may be anything) stand for
/// themselves.
std::vector<Index> weld(const Mesh& mesh, const std::vector<Index>& corners)
{
    std::vector<Index> used = corners;
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

std::vector<Index> weldedCorners(const Mesh& mesh)
{
    std::vector<Index> corners;
    corners.reserve(3 * mesh.triangles.size() + 4 * mesh.quads.size());
    for (const openvdb::Vec3I& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) corners.push_back(triangle[i]);
    }
    for (const openvdb::Vec4I& quad : mesh.quads) {
        for (int i = 0; i < 4; ++i) corners.push_back(quad[i]);
    }
    const std::vector<Index> same = weld(mesh, corners);
    for (Index& corner : corners) corner = same[corner];
    return corners;
}

Vec3d faceNormal(const std::vector<Vec3d>& points, const Faces& faces, std::size_t face)
{
    const Vec3d& first = faces.at(points, face, 0);
    const Vec3d& second = faces.at(points, face, 1);
    const Vec3d& third = faces.at(points, face, 2);
    if (faces.size(face) == 3) return unitOrZero((second - first).cross(third - first));
    return unitOrZero((third - first).cross(faces.at(points, face, 3) - second)); // diagonals
}

double angleAt(const std::vector<Vec3d>& points, const Faces& faces, std::size_t face, std::size_t corner)
{
    const std::size_t size = faces.size(face);
    const Vec3d& apex = faces.at(points, face, corner);
    const Vec3d a = faces.at(points, face, (corner + 1) % size) - apex;
    const Vec3d b = faces.at(points, face, (corner + size - 1) % size) - apex;
    return std::atan2(a.cross(b).length(), a.dot(b));
}

/// One face's side: the points it joins, smaller index first, and the corners at them.
struct Side {
    Index low, high;
    std::size_t face;
    std::size_t lowCorner, highCorner;
};

std::vector<Side> makeSides(const Faces& faces)
{
    std::vector<Side> sides;
    sides.reserve(faces.corners.size());
    for (std::size_t face = 0; face < faces.count(); ++face) {
        const std::size_t size = faces.size(face);
        for (std::size_t i = 0; i < size; ++i) {
            std::size_t a = faces.first(face) + i;
            std::size_t b = faces.first(face) + (i + 1) % size;
            if (faces.corners[a] == faces.corners[b]) continue;
            if (faces.corners[a] > faces.corners[b]) std::swap(a, b);
            sides.push_back({faces.corners[a], faces.corners[b], face, a, b});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.face, a.lowCorner) < std::tie(b.low, b.high, b.face, b.lowCorner);
    });
    return sides;
}

/// Calls visit(begin, end) for the sides of each edge.
template <typename Visit>
void forEachEdge(const std::vector<Side>& sides, const Visit& visit)
{
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && sides[end].low == sides[begin].low && sides[end].high == sides[begin].high) ++end;
        visit(begin, end);
    }
}

/// Disjoint sets of corners.
class CornerSets {
public:
    explicit CornerSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0U); }

    std::size_t find(std::size_t corner)
    {
        while (parents_[corner] != corner) corner = parents_[corner] = parents_[parents_[corner]];
        return corner;
    }
    void join(std::size_t a, std::size_t b) { parents_[std::max(find(a), find(b))] = std::min(find(a), find(b)); }

private:
    std::vector<std::size_t> parents_;
};

/// Joins the corners at both ends of each smooth edge.
CornerSets joinSmooth(const Faces& faces, const std::vector<Side>& sides, const std::vector<Vec3d>& points,
                      double creaseDegrees)
{
    CornerSets sets(faces.corners.size());
    if (creaseDegrees <= 0) return sets;
    std::vector<Vec3d> normals(faces.count());
    for (std::size_t face = 0; face < normals.size(); ++face) normals[face] = faceNormal(points, faces, face);
    const double smooth = std::cos(creaseDegrees * 3.14159265358979323846 / 180);
    forEachEdge(sides, [&](std::size_t begin, std::size_t end) {
        if (end - begin != 2) return;
        const Side& one = sides[begin];
        const Side& two = sides[begin + 1];
        if (normals[one.face].dot(normals[two.face]) <= smooth) return;
        sets.join(one.lowCorner, two.lowCorner);
        sets.join(one.highCorner, two.highCorner);
    });
    return sets;
}

} // namespace

Geometry::Geometry(const Mesh& mesh, const Frame& frame, double creaseDegrees)
    : frame_(frame), pointCount_(mesh.points.size()), triangleCount_(mesh.triangles.size()),
      quadCount_(mesh.quads.size())
{
    const std::vector<Index> corners = weldedCorners(mesh);
    const Faces faces{corners, triangleCount_, quadCount_};
    std::vector<Vec3d> points(mesh.points.size());
    for (const Index corner : corners) points[corner] = frame.toDrawing(mesh.points[corner]);
    const std::vector<Side> sides = makeSides(faces);
    CornerSets sets = joinSmooth(faces, sides, points, creaseDegrees);

    // A set's first corner stands for it, so it comes before the others.
    corners_.resize(corners.size());
    for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        const std::size_t first = sets.find(corner);
        if (first == corner) {
            corners_[corner] = static_cast<Index>(pointOfVertex_.size());
            pointOfVertex_.push_back(corners[corner]);
        } else {
            corners_[corner] = corners_[first];
        }
    }
    triangles_.reserve(triangleCount_ + 2 * quadCount_);
    for (std::size_t face = 0; face < faces.count(); ++face) {
        const Index* corner = &corners_[faces.first(face)];
        for (std::size_t second = 1; second + 1 < faces.size(face); ++second) {
            triangles_.push_back({corner[0], corner[second], corner[second + 1]});
        }
    }
    forEachEdge(sides, [&](std::size_t begin, std::size_t) {
        edges_.push_back({corners_[sides[begin].lowCorner], corners_[sides[begin].highCorner]});
    });
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
        throw InputError("picture: " + std::to_string(points.size()) + " points were given for a mesh of " +
                         std::to_string(pointCount_) + "; one for each is needed");
    }
    std::vector<Vec3d> places(pointOfVertex_.size());
    for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
        const Vec3d& point = points[pointOfVertex_[vertex]];
        if (!point.isFinite()) {
            throw InputError("picture: point " + std::to_string(pointOfVertex_[vertex]) +
                             " is not finite; a point of a face must be");
        }
        places[vertex] = frame_.toDrawing(point);
    }
    std::vector<Vec3d> sums(places.size(), Vec3d(0));
    const Faces faces{corners_, triangleCount_, quadCount_};
    for (std::size_t face = 0; face < faces.count(); ++face) {
        const Vec3d normal = faceNormal(places, faces, face);
        for (std::size_t i = 0; i < faces.size(face); ++i) {
            sums[corners_[faces.first(face) + i]] += angleAt(places, faces, face, i) * normal;
        }
    }
    positions_.resize(places.size());
    normals_.resize(places.size());
    for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
        positions_[vertex] = toFloat(places[vertex]);
        normals_[vertex] = toFloat(unitOrZero(sums[vertex]));
    }
}

} // namespace vdbcage::draw
