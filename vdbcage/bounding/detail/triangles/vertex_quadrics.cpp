#include <vdbcage/bounding/detail/triangles/vertex_quadrics.h>

#include <vdbcage/bounding/detail/guard/admissible.h>
#include <vdbcage/bounding/detail/guard/vertex_placement.h>

namespace vdbcage::detail {

VertexQuadrics::VertexQuadrics(const GuardedMesh& surface) : surface_(surface), quadrics_(surface.vertices())
{
    if (surface.vertices() > 0) origin_ = surface.point(0);
    if (surface.guard().symmetry()) origin_ = surface.ontoPlane(origin_);
    const Wishes& wishes = surface.wishes();
    const auto weightAt = [&](const Vec3d& p) {
        return wishes.hasDensity() ? wishes.quadricWeight(surface.guard().tree().closest(p).point) : 1;
    };
    for (std::uint32_t v = 0; v < surface.vertices(); ++v) {
        for (const std::uint32_t f : surface.facesOf(v)) {
            const Corners t = surface.corners(f);
            Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
            const double twiceArea = normal.length();
            if (!(twiceArea > 0)) continue;
            normal /= twiceArea;
            const Vec3d middle = (t[0] + t[1] + t[2]) / 3.0;
            const double weight = twiceArea / 6 * weightAt(middle);
            quadrics_[v].addPlane(normal, t[0] - origin_, weight);
            quadrics_[v].addSpread(middle - origin_, weight);
        }
    }
}

Quadric VertexQuadrics::sum(std::uint32_t u, std::uint32_t v) const
{
    Quadric q = quadrics_[u];
    q += quadrics_[v];
    const bool uOnPlane = surface_.isOnPlane(u), vOnPlane = surface_.isOnPlane(v);
    if (uOnPlane || vOnPlane) q.symmetrize(surface_.guard().symmetry()->axis);
    if (uOnPlane && vOnPlane) q += Quadric(q); // both halves, since it saves as many faces as others do in one half
    return q;
}

double VertexQuadrics::cost(const Quadric& q, const Vec3d& p) const
{
    constexpr double spreadWeight = 1e-3;
    return q.cost(p - origin_, spreadWeight);
}

Vec3d VertexQuadrics::optimum(const Quadric& q, std::uint32_t u, std::uint32_t v) const
{
    Vec3d place;
    const bool found = q.bestPlace(stiffness, place);
    return optimum(found, place, u, v);
}

Vec3d VertexQuadrics::optimum(bool found, const Vec3d& best, std::uint32_t u, std::uint32_t v) const
{
    const Vec3d a = surface_.point(u), b = surface_.point(v);
    const bool onPlane = surface_.isOnPlane(u) || surface_.isOnPlane(v);
    const Vec3d middle = onPlane ? surface_.ontoPlane(0.5 * (a + b)) : 0.5 * (a + b);
    if (!found) return middle;
    const Vec3d place = best + origin_;
    return (place - middle).length() > 2 * (a - b).length() ? middle : place;
}

std::optional<Vec3d> VertexQuadrics::findPlace(const StarChange& star, const Quadric& q, bool slides) const
{
    const Vec3d a = surface_.point(star.centre), b = surface_.point(star.removed), middle = 0.5 * (a + b);
    const Vec3d best = optimum(q, star.centre, star.removed);
    const Vec3d up = outward(surface_, star) * (a - b).length();
    Obstacle obstacle;
    for (const Vec3d& at : {best, best + 0.1 * up, best + 0.25 * up, best + 0.5 * up, a, b, middle + 0.1 * up,
                            middle + 0.35 * up, middle + 0.8 * up}) {
        Vec3d place = rounded(surface_, star, at);
        if (!allows(surface_, star, place, &obstacle)) continue;
        if (slides && at != best) slide(star, q, best, place);
        return place;
    }
    return std::nullopt;
}

/// Moves an allowed place towards the best one along the planes of its contacts.
void VertexQuadrics::slide(const StarChange& star, const Quadric& q, const Vec3d& best, Vec3d& place) const
{
    Quadratic change;
    change.curvature = q.planes();
    const double damping = 0.01 * change.curvature.trace();
    for (int i = 0; i < 3; ++i) change.curvature[i][i] += damping;
    change.slope = change.curvature * (place - best);
    const double before = cost(q, place);
    const double edge = (surface_.point(star.centre) - surface_.point(star.removed)).length();
    descend(surface_, star, place, change, {4 * (edge + (place - best).length())},
            [&](const Vec3d& target) { return cost(q, target) < before; });
}

} // namespace vdbcage::detail
