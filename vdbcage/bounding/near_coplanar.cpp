// Why: Si, "TetGen, a Delaunay-Based Quality Tetrahedral Mesh Generator", 2015 (its triangles; version 1.5 merges
// triangles that meet at 179.9 degrees or more into one).

#include <vdbcage/bounding/near_coplanar.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/core/error.h>

namespace vdbcage {

namespace {

using detail::GuardedMesh;
using detail::StarChange;
using openvdb::Vec3d;

constexpr double bent = 1.92e-3; // the tangent of 0.11 degrees
constexpr double flat = 3e-5;    // of the model's longest side

/// The triangles around a vertex and those next to them.
class Bends {
public:
    Bends(const GuardedMesh& surface, std::uint32_t v) : surface_(surface), star_(starOf(surface, v))
    {
        const Vec3d size = surface.guard().tree().box().hi - surface.guard().tree().box().lo;
        leastOff_ = flat * std::max({size[0], size[1], size[2]});
        for (const auto& edge : star_.link) {
            Side side{star_.link.size(), true, normalAcross(edge)};
            for (std::size_t i = 0; i < star_.link.size(); ++i) {
                if (star_.link[i][0] == edge[1]) side.next = i;
                if (star_.link[i][1] == edge[0]) side.isFirst = false;
            }
            sides_.push_back(side);
        }
    }

    const StarChange& star() const { return star_; }

    /// Returns the number of edges that are neither flat nor bent with the centre at `p`, those along the link
    /// included.
    int between(const Vec3d& p) const
    {
        boost::container::small_vector<Vec3d, 16> normals;
        for (const auto& edge : star_.link) {
            normals.push_back((surface_.point(edge[0]) - p).cross(surface_.point(edge[1]) - p));
        }
        int count = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const Side& side = sides_[i];
            const Vec3d &n = normals[i], &a = surface_.point(star_.link[i][0]), &b = surface_.point(star_.link[i][1]);
            count += isBetween(n, side.across ? *side.across : mirrored(n), b - a);
            count += isBetween(n, side.next < normals.size() ? normals[side.next] : mirrored(n), b - p);
            count += side.isFirst && isBetween(n, mirrored(n), a - p);
        }
        return count;
    }

    /// Returns the nearest places for the centre where one of the edges would be flat.
    std::vector<Vec3d> flatPlaces() const
    {
        std::vector<Vec3d> places;
        const auto add = [&](const Vec3d& onPlane, const Vec3d& normal) {
            const Vec3d& p = surface_.point(star_.centre);
            if (normal.lengthSqr() > 0) places.push_back(p + normal * (normal.dot(onPlane - p) / normal.lengthSqr()));
        };
        for (std::size_t i = 0; i < sides_.size(); ++i) {
            const Vec3d& a = surface_.point(star_.link[i][0]);
            const Vec3d along = surface_.point(star_.link[i][1]) - a;
            const Side& side = sides_[i];
            if (side.across) add(a, *side.across);
            if (side.next < sides_.size()) add(a, along.cross(surface_.point(star_.link[side.next][1]) - a));
            const bool isAtPlane = side.isFirst || side.next == sides_.size() || !side.across;
            if (isAtPlane) add(a, along.cross(mirrored(along) - along));
        }
        return places;
    }

    /// Returns the mean length of the edges at the centre.
    double size() const
    {
        double sum = 0;
        for (const auto& edge : star_.link) sum += (surface_.point(edge[0]) - surface_.point(star_.centre)).length();
        return sum / static_cast<double>(star_.link.size());
    }

private:
    /// Returns whether two triangles with these normals, twice their areas long, meet in an edge that is neither flat
    /// nor bent.
    bool isBetween(const Vec3d& a, const Vec3d& b, const Vec3d& edge) const
    {
        const double cosine = a.dot(b); // times both lengths, as the sine
        const double sine2 = a.cross(b).lengthSqr();
        if (!(cosine > 0 && sine2 < bent * bent * cosine * cosine)) return false;
        const double off2 = sine2 / std::max(a.lengthSqr(), b.lengthSqr()); // times the edge's length
        return off2 > leastOff_ * leastOff_ * edge.lengthSqr();
    }

    /// The neighbours of one of the triangles. In half a star the first and the last have edges on the plane of
    /// symmetry.
    struct Side {
        std::size_t next; ///< the triangle at its link edge's end; the number of triangles for the last
        bool isFirst;
        std::optional<Vec3d> across; ///< the normal of the one across its link edge; none if that is on the plane
    };

    std::optional<Vec3d> normalAcross(const std::array<std::uint32_t, 2>& edge) const
    {
        const std::uint32_t f = detail::faceAt(surface_, edge[1], edge[0]);
        if (f == GuardedMesh::none) return std::nullopt;
        return detail::areaNormal(surface_, f);
    }

    Vec3d mirrored(Vec3d normal) const
    {
        normal[surface_.guard().symmetry()->axis] *= -1;
        return normal;
    }

    const GuardedMesh& surface_;
    StarChange star_;
    double leastOff_; // from the other's plane, for corners of triangles that are not flat together
    boost::container::small_vector<Side, 16> sides_; // by link edge
};

/// Returns a near place for a vertex that leaves fewer edges neither flat nor bent, if there is one.
std::optional<Vec3d> betterPlace(const GuardedMesh& surface, const Bends& bends)
{
    const StarChange& star = bends.star();
    const Vec3d& now = surface.point(star.centre);
    const int count = bends.between(now);
    if (count == 0) return std::nullopt;
    const double unit = bent * bends.size();
    const auto steps = {0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0};
    const Vec3d normal = outward(surface, star);
    std::vector<Vec3d> places = bends.flatPlaces();
    for (const double step : steps) {
        for (const double side : {-unit, unit}) places.push_back(now + side * step * normal);
    }
    const auto isFar = [&](const Vec3d& p) { return (p - now).length() > 4 * unit; };
    places.erase(std::remove_if(places.begin(), places.end(), isFar), places.end());
    // The place farthest inward comes first.
    std::stable_sort(places.begin(), places.end(),
                     [&](const Vec3d& a, const Vec3d& b) { return (a - now).dot(normal) < (b - now).dot(normal); });
    // A smallest angle or the model that forbids all these may allow places where an edge gets shorter as well.
    for (const double step : steps) {
        for (const double side : {-unit, unit}) {
            for (const auto& edge : star.link) {
                Vec3d along = surface.point(edge[0]) - now;
                along.normalize();
                places.push_back(now + step * (side * normal + unit * along));
            }
        }
    }
    for (const Vec3d& p : places) {
        const Vec3d place = rounded(surface, star, p);
        if (bends.between(place) < count && allows(surface, star, place)) return place;
    }
    return std::nullopt;
}

} // namespace

Mesh bendNearCoplanarEdges(const Mesh& surface, const BoundingGuard& guard, Interrupter* interrupter)
{
    constexpr int passes = 8;
    if (!surface.quads.empty()) throw InputError("surface", "it has quads, which is not allowed; only triangles are");
    GuardedMesh guarded(surface, detail::modelOf(guard));
    bool hasMoved = true;
    for (int i = 0; hasMoved && i < passes; ++i) {
        throwIfInterrupted(interrupter);
        hasMoved = false;
        for (std::uint32_t v = 0; v < guarded.vertices(); ++v) {
            if (!guarded.isVertex(v)) continue;
            const Bends bends(guarded, v);
            const std::optional<Vec3d> place = betterPlace(guarded, bends);
            if (!place) continue;
            guarded.apply(bends.star(), *place);
            hasMoved = true;
        }
    }
    return guarded.mesh();
}

} // namespace vdbcage
