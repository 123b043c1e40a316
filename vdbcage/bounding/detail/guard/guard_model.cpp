#include <vdbcage/bounding/detail/guard/guard_model.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/nearest_float.h>
#include <vdbcage/core/detail/pi.h>
#include <vdbcage/core/error.h>
#include <vdbcage/geometry/union_find.h>
#include <vdbcage/mesh/detail/precision.h>

namespace vdbcage::detail {

namespace {

/// Returns the signed solid angle of a triangle seen from p (van Oosterom and Strackee 1983).
double solidAngle(const Corners& t, const Vec3d& p)
{
    const Vec3d a = t[0] - p, b = t[1] - p, c = t[2] - p;
    const double la = a.length(), lb = b.length(), lc = c.length();
    return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

bool comesTooNear(const Corners& triangle, const Separator& separator, const Corners& other, double clearance)
{
    return !separator.separates(other, clearance) && !Separator(other).separates(triangle, clearance) &&
           comeWithin(triangle, other, clearance);
}

/// Adds the mirror image in a plane, and leaves out the triangles behind the plane, where coordinates are less.
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

/// The faces of a model as triangles, and the largest distance of the model beyond them.
struct Faces {
    std::vector<Vec3I> triangles;
    double beyond = 0;
};

/// Takes both splits of each quad. In a model of many quads it leaves out the second where it is within `maxDistance`
/// of the first. Their distance is that of the nearest points p and q of the diagonals: the four triangles from q to
/// the quad's edges are the second split, those from p are the first, and the map from one onto the other moves no
/// point by more than |p - q|.
Faces facesOf(const Mesh& model, const std::vector<Vec3d>& points, double maxDistance)
{
    constexpr std::size_t many = std::size_t(1) << 18; // for fewer, the gain is not worth any clearance
    if (model.quads.size() < many) return {everySplit(model), 0};
    Faces faces;
    faces.triangles = triangulate(model);
    double squared = 0;
    for (const openvdb::Vec4I& q : model.quads) {
        const double apart = segmentNearness(points[q[0]], points[q[2]], points[q[1]], points[q[3]]).squaredDistance;
        if (apart <= maxDistance * maxDistance) {
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
    requireWithin(GuardOptions::clearances, options.clearance, "clearance");
    requireWithin(GuardOptions::minAngles, options.minAngleDegrees, "min angle");
    requireWithin(GuardOptions::spacings, options.spacing, "spacing");
    box_ = boundingBox(model);
    if (options.symmetry) {
        const int axis = options.symmetry->axis;
        if (axis < 0 || axis > 2) {
            throw InputError("symmetry axis", std::to_string(axis) + " is not allowed; it must be 0, 1 or 2");
        }
        const double twice = 2 * options.symmetry->offset;
        openvdb::Vec3d low = box_.min(), high = box_.max();
        low[axis] = twice - box_.max()[axis];
        high[axis] = twice - box_.min()[axis];
        box_.expand(openvdb::BBoxd(low, high));
    }
    const double side = longestSide(box_);
    scale_ = std::ldexp(1.0, -std::ilogb(side));
    clearance_ = options.clearance * side * scale_;
    // With a lesser sine the orientation tests have no room.
    minSine_ = std::max(1e-6, std::sin(options.minAngleDegrees * pi / 180));
    requireHeld(options.precision, box_);
    roundsToFloat_ = areFloats(options.precision, box_);
    if (roundsToFloat_) clearance_ = std::max(clearance_, 4 * floatRounding(box_) * scale_);
    const double narrowness = options.spacing / GuardOptions{}.spacing; // of triangles to each other, over the usual
    spacing_ = {options.spacing * side * scale_, 0.05 * narrowness, std::sin(narrowness * pi / 180)};
    std::vector<Vec3d> points;
    points.reserve(model.points.size());
    for (const Vec3d& p : model.points) points.push_back(scaled(p));
    auto [triangles, beyond] = facesOf(model, points, clearance_ / 4);
    clearance_ += beyond;
    throwIfInterrupted(interrupter);
    if (options.symmetry) {
        // Surfaces are little larger than the model: multiples of the step up to four times as far are floats, or
        // doubles with some bits to spare for the rounding of symmetric points.
        step_ = std::ldexp(scale_, std::ilogb(farthest(box_)) + (roundsToFloat_ ? 2 - 23 : 2 - 50));
        const double offset = step_ * std::round(options.symmetry->offset * scale_ / step_);
        symmetry_ = SymmetryPlane{options.symmetry->axis, offset};
        addMirrorImage(*symmetry_, points, triangles);
    }
    tree_ = TriangleBvh(points, triangles, interrupter, TriangleBvh::Copies::drop);
    UnionFind sets(points.size());
    Asker ask(interrupter);
    for (const Vec3I& t : triangles) {
        ask();
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

bool GuardModel::clear(const Corners& triangle, std::uint32_t hint, std::uint32_t* blocker) const
{
    const Separator separator(triangle);
    const auto blocks = [&](const TriangleBvh::Item& item) {
        return comesTooNear(triangle, separator, tree_.corners(item), clearance_);
    };
    const auto takeBlocker = [&](const TriangleBvh::Item& item) {
        if (blocker) *blocker = static_cast<std::uint32_t>(&item - tree_.items().data());
        return false;
    };
    if (hint != TriangleBvh::none && blocks(tree_.items()[hint])) return takeBlocker(tree_.items()[hint]);
    return tree_.traverse(tree_.near(triangle, clearance_),
                          [&](const TriangleBvh::Item& item) { return !blocks(item) || takeBlocker(item); });
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

} // namespace vdbcage::detail
