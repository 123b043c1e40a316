// Based on: shared ideas of Sander et al., "Silhouette Clipping", 2000 (hulls kept outside while decimating), and Sacht
// et al., "Nested Cages", 2015.
// Differs: moves are vetoed one star at a time by exact or error-bounded tests; nothing is projected or re-inflated.

#include <vdbcage/bounding/bounding_guard.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include <tbb/blocked_range.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/bounding/detail/guard_model.h>

namespace vdbcage {

namespace detail {

namespace {

constexpr double pi = 3.14159265358979323846;

double clamp01(double t)
{
    return std::min(1.0, std::max(0.0, t));
}

/// The nearest points of two segments (Ericson, Real-Time Collision Detection, 5.1.9).
Nearness segmentNearness(const Vec3d& p1, const Vec3d& q1, const Vec3d& p2, const Vec3d& q2)
{
    const Vec3d d1 = q1 - p1, d2 = q2 - p2, r = p1 - p2;
    const double a = d1.dot(d1), e = d2.dot(d2), f = d2.dot(r);
    double s = 0, t = 0;
    if (a <= 0 && e <= 0) {
        s = t = 0;
    } else if (a <= 0) {
        t = clamp01(f / e);
    } else {
        const double c = d1.dot(r);
        if (e <= 0) {
            s = clamp01(-c / a);
        } else {
            const double b = d1.dot(d2), determinant = a * e - b * b;
            // Nearly parallel: any point of the first will do, the second follows from it; the ends are also compared
            // as vertices against the other triangle.
            s = determinant > 1e-14 * a * e ? clamp01((b * f - c * e) / determinant) : 0.0;
            t = (b * s + f) / e;
            if (t < 0) {
                t = 0;
                s = clamp01(-c / a);
            } else if (t > 1) {
                t = 1;
                s = clamp01((b - c) / a);
            }
        }
    }
    Nearness result;
    result.onFirst = p1 + s * d1;
    result.onSecond = p2 + t * d2;
    result.squaredDistance = (result.onFirst - result.onSecond).lengthSqr();
    return result;
}

double volume(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d)
{
    return (b - a).cross(c - a).dot(d - a);
}

/// Whether an edge of `from` crosses the inside of `t`, far enough from every border that rounding cannot matter; the
/// rest is covered by distances between vertices, edges and faces.
bool pierces(const Corners& from, const Corners& t)
{
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const std::array<bool, 3> above{normal.dot(from[0] - t[0]) > 0, normal.dot(from[1] - t[0]) > 0,
                                    normal.dot(from[2] - t[0]) > 0};
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        if (above[i] == above[j]) continue;
        const Vec3d &p = from[i], &q = from[j];
        const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
        if ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0)) return true;
    }
    return false;
}

/// Distances between two sets of points along an axis that is the cross product of u and v. Never wrongly yes.
class Axis {
public:
    Axis(const Vec3d& u, const Vec3d& v)
        : direction_(u.cross(v)), length2_(direction_.lengthSqr()), product2_(u.lengthSqr() * v.lengthSqr())
    {
    }
    double along(const Vec3d& p) const { return direction_.dot(p); }
    /// Whether a gap, computed of vectors no longer than the root of `size2`, is wider than `reach` for sure.
    bool isWider(double gap, double reach, double size2) const
    {
        // The error is below 1e-14 |u| |v| size; (r + e)^2 < 1.001 r^2 + 1001 e^2.
        return gap > 0 && gap * gap > 1.001 * length2_ * reach * reach + 2e-25 * product2_ * size2;
    }

private:
    Vec3d direction_;
    double length2_, product2_;
};

/// The plane of a triangle, to tell quickly that another triangle is far on one side of it.
class Separator {
public:
    explicit Separator(const Corners& t)
        : corner_(t[0]), normal_(t[1] - t[0], t[2] - t[0]),
          size2_(std::max((t[1] - t[0]).lengthSqr(), (t[2] - t[0]).lengthSqr()))
    {
    }
    /// Whether all corners of `other` lie on one side, farther than `reach`.
    bool separates(const Corners& other, double reach) const
    {
        const Vec3d u = other[0] - corner_, v = other[1] - corner_, w = other[2] - corner_;
        const double a = normal_.along(u), b = normal_.along(v), c = normal_.along(w);
        const double height = std::max(std::min({a, b, c}), -std::max({a, b, c}));
        return normal_.isWider(height, reach, size2_ + std::max({u.lengthSqr(), v.lengthSqr(), w.lengthSqr()}));
    }

private:
    Vec3d corner_;
    Axis normal_;
    double size2_;
};

/// Whether a pair of planes along an edge of each keeps the triangles farther apart than `reach`.
bool edgesSeparate(const Corners& first, const Corners& second, double reach)
{
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d edge = first[(i + 1) % 3] - first[i], arm = first[(i + 2) % 3] - first[i];
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3d otherEdge = second[(j + 1) % 3] - second[j], otherArm = second[(j + 2) % 3] - second[j];
            const Vec3d across = second[j] - first[i];
            const Axis axis(edge, otherEdge);
            const double from = axis.along(arm), to = axis.along(otherArm), between = axis.along(across);
            const double gap = std::max(between + std::min(0.0, to) - std::max(0.0, from),
                                        std::min(0.0, from) - between - std::max(0.0, to));
            const double size2 = std::max(
                {edge.lengthSqr(), arm.lengthSqr(), otherEdge.lengthSqr(), otherArm.lengthSqr(), across.lengthSqr()});
            if (axis.isWider(gap, reach, size2)) return true;
        }
    }
    return false;
}

/// The signed solid angle of a triangle seen from p (van Oosterom and Strackee 1983).
double solidAngle(const Corners& t, const Vec3d& p)
{
    const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = a.length(), lb = b.length(), lc = c.length();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

} // namespace

Nearness nearness(const Corners& first, const Corners& second)
{
    Nearness best;
    best.squaredDistance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d onSecond = closestPointOnTriangle(first[i], second);
        const double d = (first[i] - onSecond).lengthSqr();
        if (d < best.squaredDistance) best = {first[i], onSecond, d};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d onFirst = closestPointOnTriangle(second[i], first);
        const double d = (second[i] - onFirst).lengthSqr();
        if (d < best.squaredDistance) best = {onFirst, second[i], d};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Nearness edges = segmentNearness(first[i], first[(i + 1) % 3], second[j], second[(j + 1) % 3]);
            if (edges.squaredDistance < best.squaredDistance) best = edges;
        }
    }
    if (pierces(first, second) || pierces(second, first)) best.squaredDistance = 0;
    return best;
}

bool comeWithin(const Corners& first, const Corners& second, double distance)
{
    return !edgesSeparate(first, second, distance) && nearness(first, second).squaredDistance < distance * distance;
}

namespace {

bool comesTooNear(const Corners& triangle, const Separator& separator, const Corners& other, double clearance)
{
    return !separator.separates(other, clearance) && !Separator(other).separates(triangle, clearance) &&
           comeWithin(triangle, other, clearance);
}

/// Adds the mirror image in a plane, and leaves out the triangles behind it, where coordinates are less.
void addMirrorImage(const SymmetryPlane& plane, std::vector<Vec3d>& points, std::vector<Vec3I>& triangles)
{
    const auto count = static_cast<openvdb::Index32>(points.size());
    points.reserve(2 * points.size());
    for (openvdb::Index32 i = 0; i < count; ++i) {
        points.push_back(points[i]);
        points.back()[plane.axis] = 2 * plane.offset - points[i][plane.axis];
    }
    std::vector<Vec3I> kept;
    kept.reserve(2 * triangles.size());
    for (const Vec3I& t : triangles) {
        const auto [low, high] =
            std::minmax({points[t[0]][plane.axis], points[t[1]][plane.axis], points[t[2]][plane.axis]});
        if (high >= plane.offset) kept.push_back(t);
        if (low < plane.offset) kept.emplace_back(t[0] + count, t[2] + count, t[1] + count);
    }
    triangles = std::move(kept);
}

/// The faces of a model as triangles, and how far the model reaches beyond them at most.
struct Faces {
    std::vector<Vec3I> triangles;
    double beyond = 0;
};

/// Both splits of each quad count, but of many quads the second is left out where it is within `reach` of the first.
/// It is as near as the points p and q of the diagonals that are nearest to each other: the four triangles from q to
/// the quad's edges are the second split, those from p are the first, and what maps one onto the other moves no point
/// by more than |p - q|.
Faces facesOf(const Mesh& model, const std::vector<Vec3d>& points, double reach)
{
    constexpr std::size_t many = std::size_t(1) << 18; // fewer cost too little to give away any clearance for
    if (model.quads.size() < many) return {everySplit(model), 0};
    Faces faces;
    faces.triangles = triangulate(model);
    double squared = 0;
    for (const openvdb::Vec4I& q : model.quads) {
        const double apart = segmentNearness(points[q[0]], points[q[2]], points[q[1]], points[q[3]]).squaredDistance;
        if (apart <= reach * reach) {
            squared = std::max(squared, apart);
        } else {
            faces.triangles.emplace_back(q[0], q[1], q[3]);
            faces.triangles.emplace_back(q[1], q[2], q[3]);
        }
    }
    faces.triangles.insert(faces.triangles.end(), model.alternatives.begin(), model.alternatives.end());
    faces.beyond = std::sqrt(squared);
    return faces;
}

} // namespace

GuardModel::GuardModel(const Mesh& model, const GuardOptions& options, Interrupter* interrupter)
{
    requireUsable(model, "model");
    const auto require = [](const char* name, double value, double least, double most) {
        if (value >= least && value <= most) return;
        std::ostringstream text;
        text << name << ": " << value << " is not allowed; it must be " << least << " to " << most;
        throw InputError(text.str());
    };
    require("clearance", options.clearance, 1e-7, 0.1);
    require("min angle", options.minAngleDegrees, 0, 30);
    openvdb::BBoxd box = boundingBox(model);
    if (options.symmetry) {
        const int axis = options.symmetry->axis;
        if (axis < 0 || axis > 2) {
            throw InputError("symmetry axis: " + std::to_string(axis) + " is not allowed; it must be 0, 1 or 2");
        }
        const double twice = 2 * options.symmetry->offset;
        openvdb::Vec3d low = box.min(), high = box.max();
        low[axis] = twice - box.max()[axis];
        high[axis] = twice - box.min()[axis];
        box.expand(openvdb::BBoxd(low, high));
    }
    const double side = box.extents()[static_cast<int>(box.maxExtent())];
    scale_ = std::ldexp(1.0, -std::ilogb(side));
    clearance_ = options.clearance * side * scale_;
    // Below the least sine the orientation tests have no room.
    minSine_ = std::max(1e-6, std::sin(options.minAngleDegrees * pi / 180));
    roundsToFloat_ = fitsFloat(box);
    if (roundsToFloat_) clearance_ = std::max(clearance_, 4 * floatRounding(box) * scale_);
    spacing_ = {2e-3 * side * scale_, 0.05, std::sin(1 * pi / 180)};
    std::vector<Vec3d> points;
    points.reserve(model.points.size());
    for (const Vec3d& p : model.points) points.push_back(scaled(p));
    auto [triangles, beyond] = facesOf(model, points, clearance_ / 4);
    clearance_ += beyond;
    if (options.symmetry) {
        // Surfaces reach little farther than the model: multiples of the step up to four times as far are floats, or
        // doubles with some bits to spare for the rounding of points that are to be symmetric.
        step_ = std::ldexp(scale_, std::ilogb(farthest(box)) + (roundsToFloat_ ? 2 - 23 : 2 - 50));
        const double offset = step_ * std::round(options.symmetry->offset * scale_ / step_);
        symmetry_ = SymmetryPlane{options.symmetry->axis, offset};
        addMirrorImage(*symmetry_, points, triangles);
    }
    tree_ = TriangleBvh(points, triangles, interrupter, TriangleBvh::Copies::drop);

    UnionFind sets(points.size());
    for (const Vec3I& t : triangles) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
    }
    std::vector<bool> seen(points.size(), false);
    std::vector<Vec3I> partPoints;
    for (const Vec3I& t : triangles) {
        const std::uint32_t root = sets.find(t[0]);
        if (!seen[root]) partPoints.emplace_back(t[0], t[0], t[0]);
        seen[root] = true;
    }
    parts_ = TriangleBvh(std::move(points), partPoints, interrupter, TriangleBvh::Copies::drop);
}

Vec3d GuardModel::scaled(const Vec3d& p) const
{
    return p * scale_;
}

Vec3d GuardModel::unscaled(const Vec3d& p) const
{
    return p / scale_;
}

Vec3d GuardModel::rounded(const Vec3d& p) const
{
    Vec3d rounded = p;
    if (roundsToFloat_) {
        rounded = {nearestFloat(p[0] / scale_) * scale_, nearestFloat(p[1] / scale_) * scale_,
                   nearestFloat(p[2] / scale_) * scale_};
    }
    if (symmetry_) {
        const auto [axis, offset] = *symmetry_;
        rounded[axis] = offset + step_ * std::round((p[axis] - offset) / step_);
    }
    return rounded;
}

Vec3d GuardModel::mirrored(Vec3d p) const
{
    p[symmetry_->axis] = 2 * symmetry_->offset - p[symmetry_->axis];
    return p;
}

bool GuardModel::clear(const Corners& triangle, std::uint32_t hint, std::uint32_t* blocker) const
{
    const Separator separator(triangle);
    const auto blocks = [&](const TriangleBvh::Item& item) {
        return comesTooNear(triangle, separator, tree_.corners(item), clearance_);
    };
    const auto found = [&](const TriangleBvh::Item& item) {
        if (blocker) *blocker = static_cast<std::uint32_t>(&item - tree_.items().data());
        return false;
    };
    if (hint != TriangleBvh::none && blocks(tree_.items()[hint])) return found(tree_.items()[hint]);
    return tree_.traverse(tree_.near(triangle, clearance_),
                          [&](const TriangleBvh::Item& item) { return !blocks(item) || found(item); });
}

void GuardModel::forEachBlocker(const Corners& triangle, const std::function<bool(const Corners&)>& visit) const
{
    const Separator separator(triangle);
    tree_.traverse(tree_.near(triangle, clearance_), [&](const TriangleBvh::Item& item) {
        const Corners other = tree_.corners(item);
        return !comesTooNear(triangle, separator, other, clearance_) || visit(other);
    });
}

bool GuardModel::mayHoldPart(const Box& box) const
{
    return !parts_.forEachOverlap(box, [](const TriangleBvh::Item&) { return false; });
}

bool GuardModel::swept(const std::vector<Corners>& surface, const Box& box) const
{
    return !parts_.forEachOverlap(box, [&](const TriangleBvh::Item& item) {
        // The point keeps its distance to both stars, so the sum is near a whole multiple of 4 pi.
        const Vec3d& point = parts_.points()[item.corners[0]];
        double angle = 0;
        for (const Corners& t : surface) angle += solidAngle(t, point);
        return std::abs(angle) < 2 * pi;
    });
}

} // namespace detail

BoundingGuard::BoundingGuard(const Mesh& model, const GuardOptions& options, Interrupter* interrupter)
    : model_(std::make_unique<const detail::GuardModel>(model, options, interrupter))
{
}
BoundingGuard::~BoundingGuard() = default;
BoundingGuard::BoundingGuard(BoundingGuard&&) noexcept = default;
BoundingGuard& BoundingGuard::operator=(BoundingGuard&&) noexcept = default;

double BoundingGuard::clearance() const
{
    return model_->unscaled(openvdb::Vec3d(model_->clearance()))[0];
}

std::vector<std::size_t> BoundingGuard::facesTooNear(const Mesh& surface) const
{
    const auto isClear = [&](const detail::Corners& t) {
        if (!model_->clear(t, detail::TriangleBvh::none, nullptr)) return false;
        // What is behind the plane of symmetry comes as near as its mirror image.
        return !model_->symmetry() ||
               model_->clear({model_->mirrored(t[0]), model_->mirrored(t[1]), model_->mirrored(t[2])},
                             detail::TriangleBvh::none, nullptr);
    };
    const auto place = [&](openvdb::Index32 i) { return model_->rounded(model_->scaled(surface.points[i])); };
    const std::size_t triangles = surface.triangles.size();
    const auto isFaceClear = [&](std::size_t face) {
        if (face < triangles) {
            const openvdb::Vec3I& t = surface.triangles[face];
            return isClear({place(t[0]), place(t[1]), place(t[2])});
        }
        const openvdb::Vec4I& q = surface.quads[face - triangles];
        const detail::Vec3d a = place(q[0]), b = place(q[1]), c = place(q[2]), d = place(q[3]);
        return isClear({a, b, c}) && isClear({a, c, d}) && isClear({a, b, d}) && isClear({b, c, d});
    };
    using Faces = std::vector<std::size_t>;
    return detail::parallelReduce(
        tbb::blocked_range<std::size_t>(0, faceCount(surface), 256), Faces{},
        [&](const tbb::blocked_range<std::size_t>& range, Faces faces) {
            for (std::size_t face = range.begin(); face < range.end(); ++face) {
                if (!isFaceClear(face)) faces.push_back(face);
            }
            return faces;
        },
        [](Faces before, const Faces& after) {
            before.insert(before.end(), after.begin(), after.end());
            return before;
        });
}

std::optional<SymmetryPlane> BoundingGuard::symmetry() const
{
    auto plane = model_->symmetry();
    if (plane) plane->offset = model_->unscaled(openvdb::Vec3d(plane->offset))[0];
    return plane;
}

Mesh BoundingGuard::symmetrized(const Mesh& surface, double snap) const
{
    using openvdb::Index32;
    const int axis = model_->symmetry()->axis;
    const double offset = model_->symmetry()->offset;
    const double least = offset + model_->scaled(openvdb::Vec3d(snap))[0];
    std::vector<openvdb::Vec3d> places;
    places.reserve(surface.points.size());
    for (const openvdb::Vec3d& point : surface.points) {
        openvdb::Vec3d p = model_->scaled(point);
        if (p[axis] <= least) p[axis] = offset;
        places.push_back(model_->rounded(p));
    }
    const auto isBeyond = [&](Index32 i) { return places[i][axis] > offset; };
    // The number of each point and of its mirror image, once a face has asked for them.
    constexpr Index32 unused = ~Index32(0);
    std::vector<std::array<Index32, 2>> numbers(places.size(), {unused, unused});
    Mesh result;
    const auto number = [&](Index32 i, std::size_t side) {
        auto& known = numbers[i];
        if (known[side] == unused) {
            known[side] = static_cast<Index32>(result.points.size());
            result.points.push_back(model_->unscaled(side == 0 ? places[i] : model_->mirrored(places[i])));
            if (!isBeyond(i)) known[1 - side] = known[side];
        }
        return known[side];
    };
    for (const openvdb::Vec3I& t : surface.triangles) {
        if (!isBeyond(t[0]) && !isBeyond(t[1]) && !isBeyond(t[2])) continue;
        result.triangles.emplace_back(number(t[0], 0), number(t[1], 0), number(t[2], 0));
        result.triangles.emplace_back(number(t[0], 1), number(t[2], 1), number(t[1], 1));
    }
    for (const openvdb::Vec4I& q : surface.quads) {
        if (!isBeyond(q[0]) && !isBeyond(q[1]) && !isBeyond(q[2]) && !isBeyond(q[3])) continue;
        result.quads.emplace_back(number(q[0], 0), number(q[1], 0), number(q[2], 0), number(q[3], 0));
        result.quads.emplace_back(number(q[0], 1), number(q[3], 1), number(q[2], 1), number(q[1], 1));
    }
    return result;
}

} // namespace vdbcage
