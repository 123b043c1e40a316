#include <vdbcage/bounding/detail/fit/drawn_shape.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <vdbcage/bounding/detail/triangles/relax.h>
#include <vdbcage/bounding/detail/triangles/sweep.h>

namespace vdbcage::detail {

void moveBack(GuardedMesh& surface, const std::vector<Vec3d>& drawn, Interrupter* interrupter)
{
    constexpr int sweeps = 16, gentleSweeps = 6; // which leave their neighbours room
    constexpr double leastGain = 1e-3;           // of all ways, in a sweep
    const std::vector<std::uint32_t> vertices = allVertices(surface);
    const auto ways = [&] {
        double sum = 0;
        for (const std::uint32_t v : vertices) sum += (surface.point(v) - drawn[v]).length();
        return sum;
    };
    double before = ways();
    for (int i = 0; i < sweeps; ++i) {
        std::vector<std::uint32_t> away;
        std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(away),
                     [&](std::uint32_t v) { return surface.point(v) != drawn[v]; });
        sweep(surface, away, interrupter, [&](std::uint32_t v, const StarChange& star) -> std::optional<Vec3d> {
            if (allows(surface, star, drawn[v])) return drawn[v];
            const Vec3d way = surface.point(v) - drawn[v];
            Quadratic change;
            change.curvature = openvdb::Mat3d::identity();
            change.slope = way;
            double radius = 0;
            for (const auto& edge : star.link)
                radius = std::max(radius, (surface.point(edge[0]) - surface.point(v)).length());
            Vec3d place = surface.point(v);
            const auto isNearer = [&](const Vec3d& p) { return (p - drawn[v]).length() < (1 - 1e-4) * way.length(); };
            if (!descend(surface, star, place, change, {radius, i < gentleSweeps ? 0.5 : 1.0, 1e-5}, isNearer)) {
                return std::nullopt;
            }
            return place;
        });
        const double after = ways();
        if (after == 0 || before - after < leastGain * before) return;
        before = after;
    }
}

DrawnShapeTerm::DrawnShapeTerm(const GuardedMesh& surface, const std::vector<Vec3d>& drawn, double weight)
    : drawn_(drawn)
{
    constexpr double wayShare = 0.1;
    const std::vector<std::uint32_t> vertices = allVertices(surface);
    double edges = 0;
    std::size_t count = 0;
    for (const std::uint32_t v : vertices) {
        for (const std::uint32_t w : surface.neighbours(v)) {
            edges += (surface.point(w) - surface.point(v)).length();
            ++count;
        }
    }
    const double areaOfVertex = area(surface) / static_cast<double>(std::max<std::size_t>(vertices.size(), 1));
    const double meanEdge = edges / static_cast<double>(std::max<std::size_t>(count, 1));
    ofDifference_ = meanEdge > 0 ? weight * areaOfVertex / meanEdge : 0;
    ofWay_ = wayShare * ofDifference_;
}

double DrawnShapeTerm::add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
                           Quadratic& change) const
{
    const Vec3d way = centre - drawn_[star.centre];
    double sum = 0;
    const auto addSquare = [&](double weight, const Vec3d& v) {
        sum += weight * v.lengthSqr();
        for (int i = 0; i < 3; ++i) {
            if (star.onPlane && i == surface.guard().symmetry()->axis) continue;
            change.curvature[i][i] += 2 * weight;
            change.slope[i] += 2 * weight * v[i];
        }
    };
    addSquare(ofWay_, way);
    const GuardedMesh::Vertices around = surface.neighbours(star.centre);
    for (const std::uint32_t w : around)
        addSquare(ofDifference_ / static_cast<double>(around.size()), way - (surface.point(w) - drawn_[w]));
    return sum;
}

} // namespace vdbcage::detail
