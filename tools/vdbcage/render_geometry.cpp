// Based on: Thürmer and Wüthrich, Computing vertex normals from polygonal facets, JGT 3(1), 1998 (angle weights).
// Differs: the mean is taken over the faces that smooth edges join, so that creases stay sharp.

#include <tools/vdbcage/render_geometry.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace vdbcage::render {

namespace {

using openvdb::Index32;
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

/// A face's corners are consecutive in `Soup::corners`.
struct Face {
    std::size_t first;
    int size;
    Vec3d normal;
};

/// The mesh with points welded, in the frame's coordinates.
struct Soup {
    std::vector<Vec3d> points;
    std::vector<Index32> corners; ///< indices into points
    std::vector<Face> faces;

    const Vec3d& point(const Face& face, int corner) const
    {
        return points[corners[face.first + static_cast<std::size_t>(corner)]];
    }
};

/// For each point the one that stands for all at its place. Points that no face uses (they may be anything) stand for
/// themselves.
std::vector<Index32> weld(const Mesh& mesh, const std::vector<Index32>& corners)
{
    std::vector<Index32> used = corners;
    const auto key = [&](Index32 i) {
        const Vec3d& p = mesh.points[i];
        return std::make_tuple(p.x(), p.y(), p.z(), i);
    };
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    std::sort(used.begin(), used.end(), [&](Index32 a, Index32 b) { return key(a) < key(b); });
    std::vector<Index32> same(mesh.points.size());
    std::iota(same.begin(), same.end(), Index32(0));
    for (std::size_t i = 1; i < used.size(); ++i) {
        if (mesh.points[used[i]] == mesh.points[used[i - 1]]) same[used[i]] = same[used[i - 1]];
    }
    return same;
}

Vec3d normal(const Soup& soup, const Face& face)
{
    const Vec3d& first = soup.point(face, 0);
    if (face.size == 3) return unitOrZero((soup.point(face, 1) - first).cross(soup.point(face, 2) - first));
    return unitOrZero((soup.point(face, 2) - first).cross(soup.point(face, 3) - soup.point(face, 1))); // diagonals
}

Soup makeSoup(const Mesh& mesh, const Frame& frame)
{
    Soup soup;
    const auto add = [&](const auto& face, int size) {
        soup.faces.push_back({soup.corners.size(), size, Vec3d(0)});
        for (int i = 0; i < size; ++i) soup.corners.push_back(face[i]);
    };
    soup.faces.reserve(faceCount(mesh));
    soup.corners.reserve(3 * mesh.triangles.size() + 4 * mesh.quads.size());
    for (const openvdb::Vec3I& triangle : mesh.triangles) add(triangle, 3);
    for (const openvdb::Vec4I& quad : mesh.quads) add(quad, 4);

    const std::vector<Index32> same = weld(mesh, soup.corners);
    soup.points.resize(mesh.points.size());
    for (Index32& corner : soup.corners) {
        corner = same[corner];
        soup.points[corner] = frame(mesh.points[corner]);
    }
    for (Face& face : soup.faces) {
        face.normal = normal(soup, face);
    }
    return soup;
}

/// One face's side: the points it joins, smaller index first, and the corners at them.
struct Side {
    Index32 low, high;
    std::size_t face;
    std::size_t lowCorner, highCorner;
};

std::vector<Side> makeSides(const Soup& soup)
{
    std::vector<Side> sides;
    sides.reserve(soup.corners.size());
    for (std::size_t f = 0; f < soup.faces.size(); ++f) {
        const Face& face = soup.faces[f];
        for (int i = 0; i < face.size; ++i) {
            std::size_t a = face.first + static_cast<std::size_t>(i);
            std::size_t b = face.first + static_cast<std::size_t>((i + 1) % face.size);
            if (soup.corners[a] == soup.corners[b]) continue;
            if (soup.corners[a] > soup.corners[b]) std::swap(a, b);
            sides.push_back({soup.corners[a], soup.corners[b], f, a, b});
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

double angleAt(const Soup& soup, const Face& face, int corner)
{
    const Vec3d& apex = soup.point(face, corner);
    const Vec3d a = soup.point(face, (corner + 1) % face.size) - apex;
    const Vec3d b = soup.point(face, (corner + face.size - 1) % face.size) - apex;
    return std::atan2(a.cross(b).length(), a.dot(b));
}

std::vector<Vec3d> cornerNormals(const Soup& soup, const std::vector<Side>& sides, double creaseDegrees)
{
    CornerSets sets(soup.corners.size());
    const double smooth = std::cos(creaseDegrees * 3.14159265358979323846 / 180);
    forEachEdge(sides, [&](std::size_t begin, std::size_t end) {
        if (end - begin != 2 || creaseDegrees <= 0) return;
        const Side& one = sides[begin];
        const Side& two = sides[begin + 1];
        if (soup.faces[one.face].normal.dot(soup.faces[two.face].normal) <= smooth) return;
        sets.join(one.lowCorner, two.lowCorner);
        sets.join(one.highCorner, two.highCorner);
    });
    std::vector<Vec3d> sums(soup.corners.size(), Vec3d(0));
    for (const Face& face : soup.faces) {
        for (int i = 0; i < face.size; ++i) {
            sums[sets.find(face.first + static_cast<std::size_t>(i))] += angleAt(soup, face, i) * face.normal;
        }
    }
    std::vector<Vec3d> normals(soup.corners.size());
    for (std::size_t i = 0; i < normals.size(); ++i) normals[i] = unitOrZero(sums[sets.find(i)]);
    return normals;
}

} // namespace

Frame::Frame(const openvdb::BBoxd& box)
{
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(box.min()[i]), std::abs(box.max()[i])});
    std::frexp(largest, &exponent_);
    const Vec3d min = scaled(box.min());
    const Vec3d max = scaled(box.max());
    centre_ = 0.5 * (min + max);
    const double length = 0.5 * (max - min).length();
    if (length > 0) radius_ = length;
}

Vec3d Frame::operator()(const Vec3d& point) const
{
    return (scaled(point) - centre_) / radius_;
}

Vec3d Frame::scaled(const Vec3d& point) const
{
    return {std::ldexp(point.x(), -exponent_), std::ldexp(point.y(), -exponent_), std::ldexp(point.z(), -exponent_)};
}

Geometry makeGeometry(const Mesh& mesh, const Frame& frame, double creaseDegrees,
                      const std::vector<Vec3f>& pointColours)
{
    const Soup soup = makeSoup(mesh, frame);
    const std::vector<Side> sides = makeSides(soup);
    const std::vector<Vec3d> normals = cornerNormals(soup, sides, creaseDegrees);
    Geometry geometry;
    geometry.corners.reserve(3 * mesh.triangles.size() + 6 * mesh.quads.size());
    for (const Face& face : soup.faces) {
        for (int second = 1; second + 1 < face.size; ++second) {
            for (const int i : {0, second, second + 1}) {
                const std::size_t corner = face.first + static_cast<std::size_t>(i);
                geometry.corners.push_back(
                    {toFloat(soup.point(face, i)), toFloat(normals[corner]),
                     pointColours.empty() ? Vec3f{1, 1, 1} : pointColours[soup.corners[corner]]});
            }
        }
    }
    forEachEdge(sides, [&](std::size_t begin, std::size_t) {
        geometry.segments.push_back({toFloat(soup.points[sides[begin].low]), toFloat(soup.points[sides[begin].high])});
    });
    return geometry;
}

} // namespace vdbcage::render
