// Based on: Seidel, "Small-Dimensional Linear Programming and Convex Hulls Made Easy", 1991 (half-spaces put in one
//           after the other; here for the nearest point, and not in random order);
//           Weiszfeld, "Sur le point pour lequel la somme des distances de n points donnes est minimum", 1937
//           (reweighted least squares for sums of distances).
// Differs: constraints are contacts with the model and the surface itself, looked for only where a try fails.

#include <vdbcage/bounding/detail/guard/vertex_placement.h>

#include <vdbcage/bounding/detail/guard/admissible.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace vdbcage::detail {

namespace {

/// Returns the point nearest to `wish` with normal . x >= offset for every half-space (of unit normals); nothing if
/// rounding leaves no such point. Half-spaces are added one after the other. Where the result so far violates a new
/// one, the next result lies on its plane, and so on down to lines. Expected O(n), since violations are rare.
std::optional<Vec3d> nearestInside(const Vec3d& wish, const std::vector<HalfSpace>& halfSpaces)
{
    const auto lacks = [&](std::size_t i, const Vec3d& x) {
        return halfSpaces[i].offset - halfSpaces[i].normal.dot(x);
    };
    const double slack = 1e-14 * wish.length();
    Vec3d x = wish;
    for (std::size_t i = 0; i < halfSpaces.size(); ++i) {
        if (!(lacks(i, x) > slack)) continue;
        const Vec3d& n = halfSpaces[i].normal;
        const double toFirst = lacks(i, wish);
        x = wish + toFirst * n;
        for (std::size_t j = 0; j < i; ++j) {
            if (!(lacks(j, x) > slack)) continue;
            const Vec3d& m = halfSpaces[j].normal;
            const double toSecond = lacks(j, wish), c = n.dot(m);
            const Vec3d line = n.cross(m);
            const double sine2 = line.lengthSqr();
            if (!(sine2 > 1e-20)) return std::nullopt;
            const Vec3d foot = wish + (toFirst - c * toSecond) / sine2 * n + (toSecond - c * toFirst) / sine2 * m;
            double low = -std::numeric_limits<double>::infinity(), high = -low;
            for (std::size_t k = 0; k < j; ++k) {
                const double slope = halfSpaces[k].normal.dot(line), t = lacks(k, foot) / slope;
                if (slope > 0) low = std::max(low, t);
                if (slope < 0) high = std::min(high, t);
            }
            if (!(low <= high)) return std::nullopt;
            x = foot + std::clamp(0.0, low, high) * line;
        }
    }
    return x;
}

/// Returns the delta of least delta A delta / 2 + g delta with normal . (from + delta) >= offset for every half-space;
/// A = R^T R.
std::optional<Vec3d> solve(const openvdb::Mat3d& inverseR, const Vec3d& g, const std::vector<HalfSpace>& halfSpaces,
                           const Vec3d& from)
{
    // With y = R delta the objective is the distance to a point.
    const openvdb::Mat3d transposed = inverseR.transpose();
    std::vector<HalfSpace> scaled;
    scaled.reserve(halfSpaces.size());
    for (const HalfSpace& h : halfSpaces) {
        const Vec3d normal = transposed * h.normal;
        const double length = normal.length();
        scaled.push_back({normal / length, (h.offset - h.normal.dot(from)) / length});
    }
    const auto y = nearestInside(transposed * (-g), scaled);
    if (!y) return std::nullopt;
    return inverseR * *y;
}

/// Returns the inverse of the upper triangular R with A = R^T R; nothing if A is not positive definite.
std::optional<openvdb::Mat3d> inverseCholesky(const openvdb::Mat3d& a)
{
    openvdb::Mat3d r = openvdb::Mat3d::zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            double sum = a[i][j];
            for (int k = 0; k < i; ++k) sum -= r[k][i] * r[k][j];
            if (j == i) {
                if (!(sum > 0)) return std::nullopt;
                r[i][i] = std::sqrt(sum);
            } else {
                r[i][j] = sum / r[i][i];
            }
        }
    }
    return r.inverse(0.0);
}

/// Returns a change that has its least value where coordinates stay that may not move.
Quadratic restricted(Quadratic change, const MoveLimit* limit)
{
    for (int i = 0; limit && i < 3; ++i) {
        if (limit->mayMove[static_cast<std::size_t>(i)]) continue;
        for (const int j : {0, 1, 2}) change.curvature[i][j] = change.curvature[j][i] = 0;
        change.curvature[i][i] = 1;
        change.slope[i] = 0;
    }
    return change;
}

} // namespace

bool descend(const GuardedMesh& surface, const StarChange& star, Vec3d& p, const Quadratic& change,
             const StepLimit& limit, const std::function<bool(const Vec3d&)>& accepts)
{
    constexpr int attempts = 8;
    const Quadratic free = restricted(change, surface.limitOf(star.centre));
    const auto inverse = inverseCholesky(free.curvature);
    if (!inverse) return false;
    std::vector<HalfSpace> halfSpaces;
    double share = limit.share;
    Obstacle obstacle;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        const auto solution = solve(*inverse, free.slope, halfSpaces, p);
        if (!solution) return false;
        Vec3d delta = *solution;
        const double length = delta.length();
        if (length > 0.5 * limit.radius) delta *= 0.5 * limit.radius / length;
        delta *= share;
        if (!(delta.length() > limit.least * limit.radius)) return false;
        const Vec3d target = rounded(surface, star, p + delta);
        if (!allows(surface, star, target, &obstacle)) {
            const std::size_t before = halfSpaces.size();
            contacts(surface, star, p, target, obstacle, halfSpaces);
            if (halfSpaces.size() == before || attempt >= attempts / 2) share *= 0.5;
            continue;
        }
        if (accepts(target)) {
            p = target;
            return true;
        }
        share *= 0.4;
    }
    return false;
}

template <typename Visit>
void DistanceMeasure::forEachSample(const Corners& t, std::uint32_t& seed, const Visit& visit) const
{
    constexpr int most = 12;
    constexpr double slack = 0.03; // exact distances make no tighter cages
    const double area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length();
    const double wanted = std::ceil(std::sqrt(area / areaPerSample_));
    const int k = wanted >= most ? most : std::max(1, static_cast<int>(wanted));
    const double third = 1.0 / (3 * k), weight = area / (k * k);
    const auto sample = [&](double b1, double b2) {
        const double b0 = 1 - b1 - b2;
        const Vec3d s = b0 * t[0] + b1 * t[1] + b2 * t[2];
        const TriangleBvh::Closest closest = guard_.tree().closest(s, seed, slack);
        if (closest.item != TriangleBvh::none) seed = closest.item;
        visit(weight * wishes_.distanceWeight(closest.point), b0, s - closest.point,
              std::sqrt(closest.squaredDistance));
    };
    for (int i = 0; i < k; ++i) {
        for (int j = 0; i + j < k; ++j) {
            sample((3 * i + 1) * third, (3 * j + 1) * third);
            if (i + j + 1 < k) sample((3 * i + 2) * third, (3 * j + 2) * third);
        }
    }
}

double DistanceMeasure::integral(const Corners& t, std::uint32_t& seed) const
{
    double sum = 0;
    forEachSample(t, seed, [&](double weight, double /*b0*/, const Vec3d& /*away*/, double d) { sum += weight * d; });
    return sum;
}

DistanceMeasure::Fit DistanceMeasure::fit(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
                                          std::uint32_t& seed) const
{
    const double least = 0.1 * guard_.clearance(); // smaller distances count as this
    Fit fit;
    double weights = 0;
    for (std::size_t k = 0; k < star.link.size(); ++k) {
        const auto& edge = star.link[k];
        const double share = surface.weight(star.keptFaces[k]);
        const Corners t{centre, surface.point(edge[0]), surface.point(edge[1])};
        fit.radius = std::max({fit.radius, (t[1] - centre).length(), (t[2] - centre).length()});
        forEachSample(t, seed, [&](double sampleWeight, double b0, const Vec3d& away, double d) {
            const double weight = share * sampleWeight;
            fit.integral += weight * d;
            if (!(d > 0)) return;
            // The sample's condition is d + b0 n delta = 0.
            const Vec3d n = away / d;
            const double w = weight / std::max(d, least);
            const double wb = w * b0, wbb = wb * b0;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) fit.change.curvature[i][j] += wbb * n[i] * n[j];
                fit.change.slope[i] += wb * d * n[i];
            }
            weights += wbb;
        });
    }
    if (star.onPlane) {
        // With the other half, forces across the plane cancel.
        const int across = guard_.symmetry()->axis;
        for (int i = 0; i < 3; ++i) {
            if (i != across) fit.change.curvature[i][across] = fit.change.curvature[across][i] = 0;
        }
        fit.change.slope[across] = 0;
    }
    if (shape_) {
        const double before = fit.change.curvature.trace();
        fit.integral += shape_->add(surface, star, centre, fit.change);
        weights += std::max(0.0, fit.change.curvature.trace() - before);
    }
    // Flat stars do not resist moves along themselves: a little stiffness keeps these small.
    for (int i = 0; i < 3; ++i) fit.change.curvature[i][i] += 0.01 * weights;
    return fit;
}

bool DistanceMeasure::improve(const GuardedMesh& surface, const StarChange& star, Vec3d& p, Fit& fit,
                              std::uint32_t& seed, const Pace& pace) const
{
    Fit there;
    const bool found =
        descend(surface, star, p, fit.change, {fit.radius, pace.share, pace.least}, [&](const Vec3d& target) {
            there = this->fit(surface, star, target, seed);
            return there.integral < fit.integral * (1 - pace.gain);
        });
    if (found) fit = there;
    return found;
}

} // namespace vdbcage::detail
