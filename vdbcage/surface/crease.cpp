// Why: Si, "TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator", 2015 (its facets; version 1.5 merges
// triangles that meet at 179.9 degrees or more into one).

#include <vdbcage/surface/crease.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/core/error.h>
#include <vdbcage/surface/detail/guarded_surface.h>

namespace vdbcage {

namespace {

using detail::Fan;
using detail::GuardedSurface;
using openvdb::Vec3d;

constexpr double bent = 1.92e-3; // the tangent of 0.11 degrees
constexpr double flat = 3e-5;    // of the model's longest side

/// The triangles around a vertex and those next to them.
class Star {
public:
    Star(const GuardedSurface& surface, std::uint32_t v) : surface_(surface), fan_(surface.fanOf(v))
    {
        const Vec3d size = surface.guard().tree().box().hi - surface.guard().tree().box().lo;
        leastOff_ = flat * std::max({size[0], size[1], size[2]});
        for (const auto& edge : fan_.rim) {
            Side side{fan_.rim.size(), true, normalAcross(edge)};
            for (std::size_t i = 0; i < fan_.rim.size(); ++i) {
                if (fan_.rim[i][0] == edge[1]) side.next = i;
                if (fan_.rim[i][1] == edge[0]) side.isFirst = false;
            }
            sides_.push_back(side);
        }
    }

    const Fan& fan() const { return fan_; }

    /// How many edges are neither flat nor bent with the centre at `p`, those along the rim, too.
    int between(const Vec3d& p) const
    {
        boost::container::small_vector<Vec3d, 16> normals;
        for (const auto& edge : fan_.rim) {
            normals.push_back((surface_.point(edge[0]) - p).cross(surface_.point(edge[1]) - p));
        }
        int count = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const Side& side = sides_[i];
            const Vec3d &n = normals[i], &a = surface_.point(fan_.rim[i][0]), &b = surface_.point(fan_.rim[i][1]);
            count += isBetween(n, side.across ? *side.across : mirrored(n), b - a);
            count += isBetween(n, side.next < normals.size() ? normals[side.next] : mirrored(n), b - p);
            count += side.isFirst && isBetween(n, mirrored(n), a - p);
        }
        return count;
    }

    /// The nearest places for the centre where one of the edges would be flat.
    std::vector<Vec3d> flatPlaces() const
    {
        std::vector<Vec3d> places;
        const auto add = [&](const Vec3d& onPlane, const Vec3d& normal) {
            const Vec3d& p = surface_.point(fan_.centre);
            if (normal.lengthSqr() > 0) places.push_back(p + normal * (normal.dot(onPlane - p) / normal.lengthSqr()));
        };
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            const Vec3d& a = surface_.point(fan_.rim[i][0]);
            const Vec3d along = surface_.point(fan_.rim[i][1]) - a;
            const Side& side = sides_[i];
            if (side.across) add(a, *side.across);
            if (side.next < sides_.size()) add(a, along.cross(surface_.point(fan_.rim[side.next][1]) - a));
            const bool isAtPlane = side.isFirst || side.next == sides_.size() || !side.across;
            if (isAtPlane) add(a, along.cross(mirrored(along) - along));
        }
        return places;
    }

    /// The mean length of the edges at the centre.
    double size() const
    {
        double sum = 0;
        for (const auto& edge : fan_.rim) sum += (surface_.point(edge[0]) - surface_.point(fan_.centre)).length();
        return sum / static_cast<double>(fan_.rim.size());
    }

private:
    /// Whether two triangles with these normals, twice their areas long, meet in an edge that is neither flat nor bent.
    bool isBetween(const Vec3d& a, const Vec3d& b, const Vec3d& edge) const
    {
        const double cosine = a.dot(b); // times both lengths, as the sine
        const double sine2 = a.cross(b).lengthSqr();
        if (!(cosine > 0 && sine2 < bent * bent * cosine * cosine)) return false;
        const double off2 = sine2 / std::max(a.lengthSqr(), b.lengthSqr()); // times the edge's length
        return off2 > leastOff_ * leastOff_ * edge.lengthSqr();
    }

    /// What is around one of the triangles. In half a fan the first and the last have edges on the plane of symmetry.
    struct Side {
        std::size_t next; ///< the triangle at its rim edge's end; as many as there are for the last
        bool isFirst;
        std::optional<Vec3d> across; ///< the normal of the one across its rim edge; none if that is on the plane
    };

    std::optional<Vec3d> normalAcross(const std::array<std::uint32_t, 2>& edge) const
    {
        const auto [a, b] = edge;
        for (const std::uint32_t f : surface_.facesOf(a)) {
            const auto& t = surface_.face(f);
            for (int k = 0; k < 3; ++k) {
                if (t[k] != b || t[(k + 1) % 3] != a) continue;
                const detail::Corners c = surface_.corners(f);
                return (c[1] - c[0]).cross(c[2] - c[0]);
            }
        }
        return std::nullopt;
    }

    Vec3d mirrored(Vec3d normal) const
    {
        normal[surface_.guard().symmetry()->axis] *= -1;
        return normal;
    }

    const GuardedSurface& surface_;
    Fan fan_;
    double leastOff_; // the other's plane, for corners of triangles that are not flat together
    boost::container::small_vector<Side, 16> sides_; // by rim edge
};

/// A near place for a vertex that leaves fewer edges neither flat nor bent, if there is one.
std::optional<Vec3d> betterPlace(const GuardedSurface& surface, const Star& star)
{
    const Fan& fan = star.fan();
    const Vec3d& now = surface.point(fan.centre);
    const int count = star.between(now);
    if (count == 0) return std::nullopt;
    const double unit = bent * star.size();
    const auto steps = {0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0};
    const Vec3d outward = surface.outward(fan);
    std::vector<Vec3d> places = star.flatPlaces();
    for (const double step : steps) {
        for (const double side : {-unit, unit}) places.push_back(now + side * step * outward);
    }
    const auto isFar = [&](const Vec3d& p) { return (p - now).length() > 4 * unit; };
    places.erase(std::remove_if(places.begin(), places.end(), isFar), places.end());
    // The one farthest inward first.
    std::stable_sort(places.begin(), places.end(),
                     [&](const Vec3d& a, const Vec3d& b) { return (a - now).dot(outward) < (b - now).dot(outward); });
    // What is in the way of all these, a smallest angle or the model, may not be where an edge gets shorter as well.
    for (const double step : steps) {
        for (const double side : {-unit, unit}) {
            for (const auto& edge : fan.rim) {
                Vec3d along = surface.point(edge[0]) - now;
                along.normalize();
                places.push_back(now + step * (side * outward + unit * along));
            }
        }
    }
    for (const Vec3d& p : places) {
        const Vec3d place = surface.rounded(fan, p);
        if (star.between(place) < count && surface.allows(fan, place)) return place;
    }
    return std::nullopt;
}

} // namespace

Mesh crease(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter)
{
    constexpr int passes = 8;
    if (!surface.quads.empty()) throw InputError("surface: it has quads, which is not allowed; only triangles are");
    GuardedSurface guarded(surface, guard.model());
    bool hasMoved = true;
    for (int i = 0; hasMoved && i < passes; ++i) {
        throwIfInterrupted(interrupter);
        hasMoved = false;
        for (std::uint32_t v = 0; v < guarded.vertices(); ++v) {
            if (!guarded.isVertex(v)) continue;
            const Star star(guarded, v);
            const std::optional<Vec3d> place = betterPlace(guarded, star);
            if (!place) continue;
            guarded.apply(star.fan(), *place);
            hasMoved = true;
        }
    }
    return guarded.mesh();
}

} // namespace vdbcage
