// Based on: Möller and Trumbore, Fast, minimum storage ray/triangle intersection, JGT 2(1), 1997.
#include <tools/edit/picking.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include <vdbcage/core/error.h>
#include <vdbcage/mesh/detail/degenerate.h>

namespace vdbcage::edit {

namespace {

using detail::Corners;
using detail::TriangleBvh;
using openvdb::Vec2d;
using openvdb::Vec3d;

/// A face that is so little in front of a place does not hide it: models are drawn, and hide, in single precision.
constexpr double slack = 1e-6;

/// The fraction of its size by which a triangle is met outside, too: nothing is visible between two.
constexpr double seam = 1e-9;

/// Returns the place where the segment meets the triangle, from 0 at `from` to 1 at `to`; none if they do not meet.
std::optional<double> meet(const Vec3d& from, const Vec3d& to, const Corners& triangle)
{
    const Vec3d direction = to - from, ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
    const Vec3d across = direction.cross(ac);
    const double determinant = ab.dot(across);
    if (determinant == 0) return std::nullopt;
    const Vec3d offset = from - triangle[0];
    const double u = offset.dot(across) / determinant;
    if (!(u >= -seam && u <= 1 + seam)) return std::nullopt;
    const Vec3d normal = offset.cross(ab);
    const double v = direction.dot(normal) / determinant;
    if (!(v >= -seam && u + v <= 1 + seam)) return std::nullopt;
    const double t = ac.dot(normal) / determinant;
    return t >= 0 && t <= 1 ? std::optional(t) : std::nullopt;
}

/// Calls `visit(triangle's number, place, 0 to 1)` for each triangle that the segment meets, until it returns false;
/// returns false if it did.
template <typename Visit>
bool forEachMeeting(const TriangleBvh& tree, const Vec3d& from, const Vec3d& to, const Visit& visit)
{
    constexpr double thickness = 1e-4; // of its length
    // A tetrahedron around the segment, which joins the middles of two of its edges: its slabs exclude more than boxes
    // would.
    const Vec3d along = to - from;
    const int least = std::abs(along.x()) < std::abs(along.y()) ? (std::abs(along.x()) < std::abs(along.z()) ? 0 : 2)
                                                                : (std::abs(along.y()) < std::abs(along.z()) ? 1 : 2);
    Vec3d axis(0.0);
    axis[least] = 1;
    const double half = thickness * along.length();
    const Vec3d one = half * along.cross(axis).unitSafe(), other = half * along.cross(one).unitSafe();
    const auto query = tree.inTetrahedron({from - one, from + one, to - other, to + other});
    return tree.traverse(query, [&](const TriangleBvh::Item& item) {
        const auto where = meet(from, to, tree.corners(item));
        return !where || visit(item.triangle, *where);
    });
}

/// Clips [first, last] to the part of [0, 1] where the value is not negative; it goes evenly from `atStart` to `atEnd`.
void clip(double atStart, double atEnd, double& first, double& last)
{
    if (atStart < 0 && atEnd < 0) {
        first = 1;
        last = 0;
    } else if (atStart < 0) {
        first = std::max(first, atStart / (atStart - atEnd));
    } else if (atEnd < 0) {
        last = std::min(last, atStart / (atStart - atEnd));
    }
}

bool isInside(const Vec2d& p, const std::vector<Vec2d>& polygon)
{
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a.y() > p.y()) == (b.y() > p.y())) continue;
        if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
    }
    return inside;
}

Vec3d toDouble(const draw::Vec3f& v)
{
    return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// Returns whether it has an area: without one it hides nothing, and rounding would have it met anywhere.
bool hasArea(const std::vector<Vec3d>& points, const openvdb::Vec3I& triangle)
{
    return !detail::isDegenerate(points[triangle[0]], points[triangle[1]], points[triangle[2]]);
}

TriangleBvh treeOf(const draw::Geometry& geometry)
{
    std::vector<Vec3d> points;
    points.reserve(geometry.positions().size());
    for (const draw::Vec3f& p : geometry.positions()) points.push_back(toDouble(p));
    std::vector<openvdb::Vec3I> triangles;
    triangles.reserve(geometry.triangles().size());
    for (const auto& t : geometry.triangles()) {
        if (hasArea(points, {t[0], t[1], t[2]})) triangles.emplace_back(t[0], t[1], t[2]);
    }
    return {std::move(points), triangles};
}

} // namespace

Occluder::Occluder(const draw::Geometry& geometry) : tree_(treeOf(geometry))
{
}

Picking::Picking(const Elements& elements, std::vector<Vec3d> points, const PickView& view, const Occluder* occluder)
    : elements_(elements), points_(std::move(points)), view_(view), occluder_(occluder)
{
    if (points_.size() != elements.count(Element::point)) {
        throw InputError("picking", std::to_string(points_.size()) + " points were given for a mesh of " +
                                        std::to_string(elements.count(Element::point)) + "; one for each is needed");
    }
    for (Index i = 0; i < points_.size(); ++i) {
        if (!elements.isUsed(i) || points_[i].isFinite()) continue;
        throw InputError("picking", "point " + std::to_string(i) + " is not finite; a point of a face must be");
    }
    std::vector<openvdb::Vec3I> triangles;
    for (Index face = 0; face < elements.count(Element::face); ++face) {
        const Ids corners = elements.pointsOfFace(face);
        for (std::size_t i = 2; i < corners.size(); ++i) {
            const openvdb::Vec3I triangle(corners[0], corners[i - 1], corners[i]);
            if (!hasArea(points_, triangle)) continue;
            triangles.push_back(triangle);
            faceOfTriangle_.push_back(face);
        }
    }
    tree_ = TriangleBvh(points_, triangles);
}

bool Picking::isCut(const Vec3d& point) const
{
    return view_.section && view_.section->normal.dot(point) < view_.section->offset;
}

std::optional<Picking::Spot> Picking::spotAt(const Vec3d& point) const
{
    const Vec3d place = draw::project(view_.eye, point);
    if (!(place.z() >= view_.eye.nearest) || isCut(point)) return std::nullopt;
    return Spot{point, {0.5 * (1 + place.x()) * view_.width, 0.5 * (1 - place.y()) * view_.height}, place.z()};
}

/// Returns the point of the edge that looks nearest to the pixel.
std::optional<Picking::Spot> Picking::spotOnEdge(Index edge, const Vec2d& pixel) const
{
    const Vec3d a = points_[elements_.edges()[edge].first], along = points_[elements_.edges()[edge].second] - a;
    const auto depth = [&](const Vec3d& p) { return draw::project(view_.eye, p).z(); };
    double first = 0, last = 1;
    clip(depth(a) - view_.eye.nearest, depth(a + along) - view_.eye.nearest, first, last);
    if (view_.section) {
        const draw::Section& section = *view_.section;
        clip(section.normal.dot(a) - section.offset, section.normal.dot(a + along) - section.offset, first, last);
    }
    if (!(first <= last)) return std::nullopt;
    const auto spot = [&](double t) { // its ends are visible up to rounding, which does not matter
        const Vec3d point = a + t * along, place = draw::project(view_.eye, point);
        return Spot{point, {0.5 * (1 + place.x()) * view_.width, 0.5 * (1 - place.y()) * view_.height}, place.z()};
    };
    const Spot from = spot(first), to = spot(last);
    const Vec2d across = to.pixel - from.pixel;
    const double length = across.lengthSqr();
    if (!(length > 0)) return from.depth <= to.depth ? from : to; // seen from its end
    const double share = std::clamp((pixel - from.pixel).dot(across) / length, 0.0, 1.0);
    // Perspective: equal steps in the picture are longer the deeper they are.
    const bool isPerspective = view_.eye.projection == draw::Projection::perspective;
    const double part = isPerspective ? share * from.depth / (to.depth + share * (from.depth - to.depth)) : share;
    return spot(first + part * (last - first));
}

std::optional<Picking::Spot> Picking::middleOf(Element kind, Index id) const
{
    if (kind == Element::point) return elements_.isUsed(id) ? spotAt(points_[id]) : std::nullopt;
    if (kind == Element::edge) {
        const auto [a, b] = elements_.edges()[id];
        return spotAt(0.5 * (points_[a] + points_[b]));
    }
    Vec3d sum(0.0);
    const Ids corners = elements_.pointsOfFace(id);
    for (const Index corner : corners) sum += points_[corner];
    return spotAt(sum / static_cast<double>(corners.size()));
}

/// Returns the faces that an element belongs to, which do not hide it.
Ids Picking::facesAt(Element kind, const Index& id) const
{
    switch (kind) {
    case Element::point:
        return elements_.facesOfPoint(id);
    case Element::edge:
        return elements_.facesOfEdge(id);
    case Element::face:
        break;
    }
    return {&id, &id + 1};
}

/// Returns the beginning of the line of sight to the place.
Vec3d Picking::startTowards(const Spot& spot) const
{
    const draw::Eye& eye = view_.eye;
    if (eye.projection == draw::Projection::orthographic) return spot.point + (spot.depth - eye.nearest) * eye.back;
    return eye.position + eye.nearest / spot.depth * (spot.point - eye.position);
}

/// Returns whether a triangle of the tree is in front of `to`, seen from `from`. Triangles for which `isOwn` is true do
/// not count.
template <typename IsOwn>
bool Picking::isBehind(const TriangleBvh& tree, const Vec3d& from, const Vec3d& to, const IsOwn& isOwn) const
{
    const double length = (to - from).length();
    return !forEachMeeting(tree, from, to, [&](std::uint32_t triangle, double where) {
        return !(where * length < length - slack) || isOwn(triangle) || isCut(from + where * (to - from));
    });
}

bool Picking::isBehindOccluder(const Vec3d& from, const Vec3d& to) const
{
    return occluder_ != nullptr && isBehind(occluder_->tree_, from, to, [](std::uint32_t) { return false; });
}

bool Picking::isHidden(const Spot& spot, Ids own) const
{
    if (view_.seeThrough) return false;
    const Vec3d from = startTowards(spot);
    const auto isOwn = [&](std::uint32_t triangle) {
        return std::binary_search(own.begin(), own.end(), faceOfTriangle_[triangle]);
    };
    return isBehind(tree_, from, spot.point, isOwn) || isBehindOccluder(from, spot.point);
}

std::optional<Index> Picking::faceAt(const Vec2d& pixel) const
{
    const draw::Eye& eye = view_.eye;
    const draw::Ray ray = draw::rayThrough(eye, 2 * pixel.x() / view_.width - 1, 1 - 2 * pixel.y() / view_.height);
    double farthest = eye.nearest;
    for (Index i = 0; i < points_.size(); ++i) {
        if (elements_.isUsed(i)) farthest = std::max(farthest, draw::project(eye, points_[i]).z());
    }
    const double steepness = -eye.back.dot(ray.direction);
    const Vec3d from = ray.from + eye.nearest / steepness * ray.direction;
    const Vec3d to = ray.from + (farthest + slack) / steepness * ray.direction;
    double first = 2;
    Index face = none;
    forEachMeeting(tree_, from, to, [&](std::uint32_t triangle, double where) {
        const Index other = faceOfTriangle_[triangle];
        if (std::tie(where, other) < std::tie(first, face) && !isCut(from + where * (to - from))) {
            first = where;
            face = other;
        }
        return true;
    });
    if (face == none) return std::nullopt;
    const bool isSeen = view_.seeThrough || !isBehindOccluder(from, from + first * (to - from));
    return isSeen ? std::optional(face) : std::nullopt;
}

struct Picking::Candidate {
    double squaredPixels;
    Spot spot;
    Index id;

    bool operator<(const Candidate& other) const
    {
        return std::tie(squaredPixels, spot.depth, id) < std::tie(other.squaredPixels, other.spot.depth, other.id);
    }
};

std::optional<Index> Picking::at(Element kind, double x, double y, double radius) const
{
    const Vec2d pixel(x, y);
    if (kind == Element::face) return faceAt(pixel);
    std::vector<Candidate> candidates;
    for (Index id = 0; id < elements_.count(kind); ++id) {
        const auto spot = kind == Element::edge ? spotOnEdge(id, pixel) : middleOf(kind, id);
        if (!spot) continue;
        const double squaredPixels = (spot->pixel - pixel).lengthSqr();
        if (squaredPixels <= radius * radius) candidates.push_back({squaredPixels, *spot, id});
    }
    std::sort(candidates.begin(), candidates.end());
    for (const Candidate& candidate : candidates) {
        if (!isHidden(candidate.spot, facesAt(kind, candidate.id))) return candidate.id;
    }
    return std::nullopt;
}

std::vector<Index> Picking::within(Element kind, const std::vector<Vec2d>& polygon) const
{
    const auto isSpotInside = [&](const std::optional<Spot>& spot) { return spot && isInside(spot->pixel, polygon); };
    std::vector<Index> ids;
    for (Index id = 0; id < elements_.count(kind); ++id) {
        const auto middle = middleOf(kind, id);
        if (!middle) continue;
        bool isWithin = false;
        if (kind == Element::edge) {
            const auto [a, b] = elements_.edges()[id];
            isWithin = isSpotInside(spotAt(points_[a])) && isSpotInside(spotAt(points_[b]));
        } else {
            isWithin = isSpotInside(middle);
        }
        if (isWithin && !isHidden(*middle, facesAt(kind, id))) ids.push_back(id);
    }
    return ids;
}

} // namespace vdbcage::edit
