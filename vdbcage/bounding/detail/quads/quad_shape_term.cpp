#include <vdbcage/bounding/detail/quads/quad_shape_term.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <vdbcage/bounding/detail/guard/face_queries.h>
#include <vdbcage/geometry/quad_shape.h>
#include <vdbcage/geometry/triangle_pair.h>

namespace vdbcage::detail {

namespace {

/// A sum of squares of functions that are linear in a place, to first order.
struct SquareSum {
    void add(double weight, double value, const Vec3d& slope)
    {
        sum += weight * value * value;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) change.curvature[i][j] += 2 * weight * slope[i] * slope[j];
            change.slope[i] += 2 * weight * value * slope[i];
        }
    }

    Quadratic& change;
    double sum = 0;
};

/// Adds the corner at p with the sides `one` and `other`; `moving` is the index of the point that moves.
void addCorner(const ShapeWeights& weights, const std::array<Vec3d, 3>& corner, std::size_t moving, SquareSum& sum)
{
    Vec3d u = corner[1] - corner[0], w = corner[2] - corner[0];
    const double lengthU = u.length(), lengthW = w.length();
    if (!(lengthU > 0 && lengthW > 0)) return;
    u /= lengthU;
    w /= lengthW;
    constexpr double bad = 0.6; // 37 degrees off square
    const double cosine = u.dot(w), size = std::abs(cosine);
    if (!(size > weights.free)) return;
    const Vec3d ofOne = (w - cosine * u) / lengthU, ofOther = (u - cosine * w) / lengthW;
    const Vec3d slope = moving == 0 ? -(ofOne + ofOther) : moving == 1 ? ofOne : ofOther;
    sum.add(weights.corners, size - weights.free, cosine > 0 ? slope : -slope);
    if (size > bad) sum.add(weights.bad, size - bad, cosine > 0 ? slope : -slope);
}

/// Adds the height of the diagonals above each other, in parts of half a mean side; corner 0 moves.
void addFold(const ShapeWeights& weights, const std::array<Vec3d, 4>& p, SquareSum& sum)
{
    const Vec3d first = p[2] - p[0], second = p[3] - p[1];
    Vec3d normal = first.cross(second);
    const double length = normal.length();
    if (!(length > 0)) return;
    normal /= length;
    const double half = 0.25 * (first.length() + second.length()) / std::sqrt(2.0);
    // The normal turns as well, but perpendicular to the height.
    const double opposite = second.cross(p[1] - p[2]).dot(normal) / length; // along its diagonal, where they pass
    sum.add(weights.flat, normal.dot(p[0] - p[1]) / half, std::clamp(opposite, -1.0, 1.0) / half * normal);
}

} // namespace

bool isFit(const GuardedMesh& surface, const std::array<Vec3d, 4>& p)
{
    double deviation;
    if (!isConvexQuad(p, surface.leastQuadCosine(), deviation)) return false;
    const double least = std::min({minSine({p[0], p[1], p[2]}), minSine({p[0], p[2], p[3]}),
                                   minSine({p[0], p[1], p[3]}), minSine({p[1], p[2], p[3]})});
    constexpr double leastSine = 0.087; // of 5 degrees
    return least >= std::max(surface.guard().minSine(), leastSine);
}

double QuadShapeTerm::add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
                          Quadratic& change) const
{
    Quadratic own;
    SquareSum sum{own};
    for (const std::uint32_t q : table_.quadsOf(star.centre)) {
        const Vec4I& ids = table_.corners(q);
        int i = 0;
        while (ids[i] != star.centre) ++i;
        const auto corner = [&](int k) { return surface.point(ids[(i + k) % 4]); };
        const Vec3d next = corner(1), across = corner(2), last = corner(3);
        addCorner(weights_, {centre, next, last}, 0, sum);
        addCorner(weights_, {next, centre, across}, 1, sum);
        addCorner(weights_, {last, centre, across}, 1, sum);
        addFold(weights_, {centre, next, across, last}, sum);
        if (weights_.unfit > 0 && !isFit(surface, {centre, next, across, last})) sum.sum += weights_.unfit;
    }
    const auto hold =
        std::lower_bound(holds_.begin(), holds_.end(), star.centre,
                         [](const PlaneHold& entry, std::uint32_t vertex) { return entry.vertex < vertex; });
    if (hold != holds_.end() && hold->vertex == star.centre) {
        sum.add(weights_.hold, (hold->normal.dot(centre) - hold->offset) / hold->width, hold->normal / hold->width);
    }
    if (star.onPlane) {
        const int across = surface.guard().symmetry()->axis;
        for (int i = 0; i < 3; ++i) own.curvature[i][across] = own.curvature[across][i] = 0;
        own.slope[across] = 0;
    }
    change.curvature += own.curvature;
    change.slope += own.slope;
    return sum.sum;
}

double QuadShapeTerm::of(const GuardedMesh& surface, std::uint32_t quad) const
{
    Quadratic change;
    SquareSum sum{change};
    const std::array<Vec3d, 4> p = pointsOf(surface, table_.corners(quad));
    for (std::size_t i = 0; i < 4; ++i) addCorner(weights_, {p[i], p[(i + 1) % 4], p[(i + 3) % 4]}, 0, sum);
    addFold(weights_, p, sum);
    if (weights_.unfit > 0 && !isFit(surface, p)) sum.sum += weights_.unfit;
    return sum.sum;
}

bool QuadShapeTerm::keepsFit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre) const
{
    for (const std::uint32_t q : table_.quadsOf(star.centre)) {
        const Vec4I& ids = table_.corners(q);
        std::array<Vec3d, 4> corners = pointsOf(surface, ids);
        const bool wasFit = isFit(surface, corners);
        int i = 0;
        while (ids[i] != star.centre) ++i;
        corners[static_cast<std::size_t>(i)] = centre;
        if (wasFit && !isFit(surface, corners)) return false;
    }
    return true;
}

CornerAngles cornerAngles(const GuardedMesh& surface, const QuadTable& table)
{
    std::vector<double> deviations;
    double sum = 0;
    for (std::uint32_t q = 0; q < table.quads(); ++q) {
        if (!table.isQuad(q)) continue;
        const Vec4I& ids = table.corners(q);
        for (int i = 0; i < 4; ++i) {
            const Vec3d& p = surface.point(ids[i]);
            const double corner =
                angleDegrees(surface.point(ids[(i + 1) % 4]) - p, surface.point(ids[(i + 3) % 4]) - p);
            deviations.push_back(std::abs(corner - 90));
            sum += deviations.back();
        }
    }
    if (deviations.empty()) return {};
    const std::size_t at = deviations.size() * 95 / 100;
    std::nth_element(deviations.begin(), deviations.begin() + static_cast<std::ptrdiff_t>(at), deviations.end());
    return {sum / static_cast<double>(deviations.size()), deviations[at]};
}

} // namespace vdbcage::detail
