// Based on: Baerentzen and Aanaes, "Signed Distance Computation Using the Angle Weighted Pseudonormal", 2005.

#include <vdbcage/bounding/detail/fit/demands.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>
#include <unordered_set>

#include <boost/container/small_vector.hpp>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/core/detail/parallel.h>

namespace vdbcage::detail {

namespace {

/// Returns the weights of t's corners for a point of it.
Vec3d weightsAt(const Vec3d& p, const Corners& t)
{
    const Vec3d weights = barycentric(p, t);
    const double b = std::clamp(weights[1], 0.0, 1.0), c = std::clamp(weights[2], 0.0, 1.0 - b);
    return {1 - b - c, b, c};
}

Vec3d unit(const Vec3d& v)
{
    const double length = v.length();
    return length > 0 ? v / length : Vec3d(0.0);
}

} // namespace

/// A surface of triangles, for signed distances.
class DemandFinder::SplitSurface {
public:
    /// `faces` are the numbers of the triangles that demands have.
    SplitSurface(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles,
                 std::vector<std::uint32_t> faces, const std::optional<SymmetryPlane>& plane)
        : plane_(plane), faces_(std::move(faces)), vertexNormals_(points.size(), Vec3d(0.0)), tree_(points, triangles)
    {
        for (const Vec3I& ids : triangles) {
            const Corners t{points[ids[0]], points[ids[1]], points[ids[2]]};
            normals_.push_back(unit((t[1] - t[0]).cross(t[2] - t[0])));
            for (const int i : {0, 1, 2}) {
                const Vec3d u = points[ids[(i + 1) % 3]] - points[ids[i]],
                            w = points[ids[(i + 2) % 3]] - points[ids[i]];
                vertexNormals_[ids[i]] += std::atan2(u.cross(w).length(), u.dot(w)) * normals_.back();
            }
        }
        for (std::uint32_t i = 0; i < triangles.size(); ++i) {
            for (const int k : {0, 1, 2}) {
                const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
                edges_.push_back({std::min(a, b), std::max(a, b), i});
            }
        }
        std::sort(edges_.begin(), edges_.end());
        // Where half of a symmetric surface ends, the other half has the mirror images of these normals.
        for (std::size_t i = 0; plane && i < edges_.size(); ++i) {
            if (isPaired(i)) continue;
            for (const std::uint32_t v : {edges_[i].a, edges_[i].b}) vertexNormals_[v][plane->axis] = 0;
        }
    }
    /// Returns a surface with its quads split in one of the two ways.
    static SplitSurface of(const std::vector<Vec3d>& points, const GuardedMesh& surface, bool alternates)
    {
        std::vector<Vec3I> triangles;
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < surface.faces(); ++f) {
            const bool isShown = surface.isInQuad(f) ? surface.isFace(f) != alternates : surface.isFace(f);
            if (!isShown) continue;
            triangles.push_back(surface.face(f));
            faces.push_back(f);
        }
        return {points, triangles, std::move(faces), surface.guard().symmetry()};
    }

    struct Nearest {
        Vec3d point, weights, direction; ///< outward, of length 1
        Vec3I corners;
        std::uint32_t face;
        double height; ///< of the sample above the surface; negative inside
    };
    Nearest nearest(const Vec3d& sample) const
    {
        constexpr double least = 1e-9;
        const TriangleBvh::Closest closest = tree_.closest(sample);
        const TriangleBvh::Item& item = tree_.items()[closest.item];
        Nearest found{
            closest.point, weightsAt(closest.point, tree_.corners(item)), {}, item.corners, faces_[item.triangle], 0};
        Vec3d normal = normals_[item.triangle];
        int zeros = 0, zero = 0, one = 0;
        for (int i = 0; i < 3; ++i) {
            if (found.weights[i] < least) {
                ++zeros;
                zero = i;
            } else {
                one = i;
            }
        }
        if (zeros == 2) normal = vertexNormals_[item.corners[one]];
        if (zeros == 1) normal = ofEdge(item.corners[(zero + 1) % 3], item.corners[(zero + 2) % 3]);
        const Vec3d away = sample - closest.point;
        const double distance = std::sqrt(closest.squaredDistance);
        const bool isInside = away.dot(normal) < 0;
        found.height = isInside ? -distance : distance;
        found.direction = distance > 1e-12 ? away / found.height : unit(normal);
        return found;
    }

private:
    struct Edge {
        std::uint32_t a, b, triangle;
        bool operator<(const Edge& other) const
        {
            return std::tie(a, b, triangle) < std::tie(other.a, other.b, other.triangle);
        }
    };
    Vec3d ofEdge(std::uint32_t a, std::uint32_t b) const
    {
        if (a > b) std::swap(a, b);
        Vec3d sum(0.0);
        int count = 0;
        for (auto i = std::lower_bound(edges_.begin(), edges_.end(), Edge{a, b, 0});
             i != edges_.end() && i->a == a && i->b == b; ++i) {
            sum += normals_[i->triangle];
            ++count;
        }
        if (plane_ && count == 1) sum[plane_->axis] = 0;
        return sum;
    }
    /// Returns whether another triangle has the same edge.
    bool isPaired(std::size_t edge) const
    {
        const auto isSame = [&](std::size_t other) {
            return other < edges_.size() && edges_[other].a == edges_[edge].a && edges_[other].b == edges_[edge].b;
        };
        return isSame(edge + 1) || (edge > 0 && isSame(edge - 1));
    }

    std::optional<SymmetryPlane> plane_;
    std::vector<std::uint32_t> faces_;
    std::vector<Vec3d> normals_, vertexNormals_;
    std::vector<Edge> edges_;
    TriangleBvh tree_;
};

DemandFinder::DemandFinder(const GuardModel& model, Interrupter* interrupter)
    : model_(model), margin_(std::max(4 * model.clearance(), 2e-4))
{
    constexpr double cells = 64; // along the longest side
    const Box& box = model.tree().box();
    const Vec3d size = box.hi - box.lo;
    const double cell = std::max({size[0], size[1], size[2]}) / cells;
    std::unordered_set<std::uint64_t> taken;
    // Of a symmetric model half is enough, the one that a guarded surface is around.
    const auto take = [&](const Vec3d& p) {
        if (isBehind(p)) return;
        std::uint64_t key = 0;
        for (int i = 0; i < 3; ++i) key = key << 20 | static_cast<std::uint64_t>((p[i] - box.lo[i]) / cell);
        if (taken.insert(key).second) samples_.push_back(p);
    };
    throwIfInterrupted(interrupter);
    // Once no face cuts the model, each part is inside if this point of it is.
    for (const TriangleBvh::Item& item : model.parts().items()) {
        const Vec3d p = model.parts().corners(item)[0];
        samples_.push_back(isBehind(p) ? model.mirrored(p) : p);
    }
    for (const TriangleBvh::Item& item : model.tree().items()) {
        const Corners t = model.tree().corners(item);
        for (const Vec3d& p : t) take(p);
        const double longest =
            std::sqrt(std::max({(t[1] - t[0]).lengthSqr(), (t[2] - t[1]).lengthSqr(), (t[0] - t[2]).lengthSqr()}));
        const int k = static_cast<int>(std::ceil(longest / cell));
        for (int i = 0; k > 1 && i <= k; ++i) {
            for (int j = 0; i + j <= k; ++j) {
                const double b = static_cast<double>(i) / k, c = static_cast<double>(j) / k;
                take((1 - b - c) * t[0] + b * t[1] + c * t[2]);
            }
        }
    }
}

bool DemandFinder::isBehind(const Vec3d& p) const
{
    return symmetry() && p[symmetry()->axis] < symmetry()->offset;
}

double DemandFinder::distanceToModel(const Vec3d& p) const
{
    return std::sqrt(model_.tree().closest(isBehind(p) ? model_.mirrored(p) : p).squaredDistance);
}

std::vector<Demand> DemandFinder::ofSamples(const GuardedMesh& surface)
{
    std::vector<Vec3d> points;
    points.reserve(surface.vertices());
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) points.push_back(surface.point(v));
    if (surface.faces() > faces_) before_.clear();
    faces_ = surface.faces();
    const SplitSurface first = SplitSurface::of(points, surface, false);
    if (surface.quads() == 0) return ofSamples(points, first, nullptr);
    const SplitSurface second = SplitSurface::of(points, surface, true);
    return ofSamples(points, first, &second);
}

std::vector<Demand> DemandFinder::ofSamples(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles)
{
    std::vector<std::uint32_t> numbers(triangles.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    return ofSamples(points, SplitSurface(points, triangles, std::move(numbers), model_.symmetry()), nullptr);
}

std::vector<Demand> DemandFinder::ofSamples(const std::vector<Vec3d>& points, const SplitSurface& first,
                                            const SplitSurface* second)
{
    if (before_.size() != points.size()) {
        safeUntil_.assign(samples_.size(), -1);
        before_ = points;
        moved_ = 0;
    }
    double farthest2 = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        farthest2 = std::max(farthest2, (points[i] - before_[i]).lengthSqr());
    before_ = points;
    moved_ += std::sqrt(farthest2);
    std::vector<std::optional<Demand>> found(samples_.size());
    parallelFor(std::size_t(0), samples_.size(), [&](std::size_t i) {
        if (safeUntil_[i] > moved_) return;
        SplitSurface::Nearest nearest = first.nearest(samples_[i]);
        if (second) {
            const SplitSurface::Nearest other = second->nearest(samples_[i]);
            if (other.height > nearest.height) nearest = other;
        }
        safeUntil_[i] = moved_ - nearest.height;
        if (!(nearest.height > 0)) return;
        found[i] = Demand{nearest.corners, nearest.weights, nearest.direction,
                          nearest.direction.dot(samples_[i]) + margin_, nearest.face};
    });
    std::vector<Demand> demands;
    for (const auto& demand : found) {
        if (demand) demands.push_back(*demand);
    }
    return demands;
}

namespace {

using Polygon = boost::container::small_vector<Vec3d, 8>;

/// Cuts away the part of a polygon where normal . p is less than `offset`.
Polygon cut(const Polygon& polygon, const Vec3d& normal, double offset)
{
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double a = normal.dot(p) - offset, b = normal.dot(q) - offset;
        if (a >= 0) kept.push_back(p);
        if ((a > 0 && b < 0) || (a < 0 && b > 0)) kept.push_back(p + a / (a - b) * (q - p));
    }
    return kept;
}

} // namespace

std::vector<Demand> DemandFinder::ofContacts(const GuardedMesh& surface) const
{
    constexpr int most = 64; // of each face; others show up in the next round
    const double clearance = 1.5 * model_.clearance();
    std::vector<std::optional<Demand>> found(surface.faces());
    parallelFor(std::uint32_t(0), surface.faces(), [&](std::uint32_t f) {
        if ((!surface.isFace(f) && !surface.isInQuad(f)) || !surface.mayCut(f)) return;
        const Corners t = surface.corners(f);
        const Vec3d normal = unit((t[1] - t[0]).cross(t[2] - t[0]));
        int count = 0;
        double highest = -1;
        Vec3d place;
        model_.forEachBlocker(t, [&](const Corners& other) {
            Polygon polygon(other.begin(), other.end());
            for (std::size_t i = 0; i < 3 && !polygon.empty(); ++i) {
                const Vec3d in = unit(normal.cross(t[(i + 1) % 3] - t[i]));
                polygon = cut(polygon, in, in.dot(t[i]) - clearance);
            }
            for (const Vec3d& p : polygon) {
                const double height = normal.dot(p - t[0]);
                if (height > highest) {
                    highest = height;
                    place = p;
                }
            }
            return ++count < most;
        });
        if (count == 0 || highest < -clearance) return;
        found[f] =
            Demand{surface.face(f), weightsAt(place - highest * normal, t), normal, normal.dot(place) + clearance, f};
    });
    std::vector<Demand> demands;
    for (const auto& demand : found) {
        if (demand) demands.push_back(*demand);
    }
    return demands;
}

} // namespace vdbcage::detail
