// Based on: Huang et al., "L1-Based Construction of Polycube Maps from Complex Shapes", 2014 (the L1 norm of normals).
// Differs: the model is turned as a whole, so that there are three unknowns and no deformation.

#include <vdbcage/mesh/detail/aligned_axes.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <vdbcage/core/detail/longest_side.h>
#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

using openvdb::Mat3d;
using openvdb::Vec3d;

/// Returns the area vectors of the faces, without regard to sides, those of about one direction added up.
std::vector<Vec3d> areaVectors(const Mesh& model, Interrupter* interrupter)
{
    constexpr int cells = 24; // along each side of a cube of directions
    const openvdb::BBoxd box = boundingBox(model);
    const double side = longestSide(box);
    std::vector<Vec3d> sums(std::size_t(3) * cells * cells, Vec3d(0, 0, 0));
    std::size_t visited = 0;
    for (const openvdb::Vec3I& t : triangulate(model)) {
        if (visited++ % 65536 == 0) throwIfInterrupted(interrupter);
        const Vec3d &a = model.points[t[0]], &b = model.points[t[1]], &c = model.points[t[2]];
        Vec3d vector = ((b - a) / side).cross((c - a) / side);
        const auto along = static_cast<int>(openvdb::math::MaxIndex(openvdb::math::Abs(vector)));
        if (!(std::abs(vector[along]) > 0)) continue;
        if (vector[along] < 0) vector = -vector;
        const auto cell = [&](int axis) {
            const double place = 0.5 * (vector[axis % 3] / vector[along] + 1) * cells;
            return static_cast<std::size_t>(std::min(cells - 1, static_cast<int>(place)));
        };
        sums[(static_cast<std::size_t>(along) * cells + cell(along + 1)) * cells + cell(along + 2)] += vector;
    }
    const auto isNone = [](const Vec3d& sum) { return sum.isZero(); };
    sums.erase(std::remove_if(sums.begin(), sums.end(), isNone), sums.end());
    return sums;
}

double projectedArea(const Mat3d& axes, const std::vector<Vec3d>& vectors)
{
    double sum = 0;
    for (const Vec3d& vector : vectors) {
        const Vec3d seen = openvdb::math::Abs(axes * vector);
        sum += seen[0] + seen[1] + seen[2];
    }
    return sum;
}

/// Turns two axes about the third to the least projected area. Between the angles at which some vector is square to one
/// of them the area is concave, so the best angle is one of these.
void turnAbout(int third, const std::vector<Vec3d>& vectors, Mat3d& axes)
{
    constexpr double quarter = pi / 2;
    const Vec3d u = axes.row((third + 1) % 3), v = axes.row((third + 2) % 3);
    struct Seen {
        double angle, length; // in the plane of both axes, within the first quarter
    };
    std::vector<Seen> seen;
    for (const Vec3d& vector : vectors) {
        const double x = std::abs(vector.dot(u)), y = std::abs(vector.dot(v));
        // A vector (x, -y), turned by a quarter, is (y, x).
        const bool isTurned = (vector.dot(u) < 0) != (vector.dot(v) < 0);
        seen.push_back({isTurned ? std::atan2(x, y) : std::atan2(y, x), std::hypot(x, y)});
        if (seen.back().angle >= quarter) seen.back().angle = 0;
    }
    std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
        return a.angle != b.angle ? a.angle < b.angle : a.length < b.length;
    });
    double cosines = 0, sines = 0;
    for (const Seen& s : seen) {
        cosines += s.length * std::cos(s.angle);
        sines += s.length * std::sin(s.angle);
    }
    const double before = cosines + sines;
    double best = before * (1 - 1e-12), bestAngle = 0;
    double passedCosines = 0, passedSines = 0; // of those at smaller angles
    for (const Seen& s : seen) {
        const double cosine = std::cos(s.angle), sine = std::sin(s.angle);
        const double leftCosines = cosines - 2 * passedCosines, leftSines = sines - 2 * passedSines;
        const double area = cosines * cosine + sines * sine + leftSines * cosine - leftCosines * sine;
        if (area < best) {
            best = area;
            bestAngle = s.angle;
        }
        passedCosines += s.length * cosine;
        passedSines += s.length * sine;
    }
    if (bestAngle == 0) return;
    axes.setRow((third + 1) % 3, std::cos(bestAngle) * u + std::sin(bestAngle) * v);
    axes.setRow((third + 2) % 3, std::cos(bestAngle) * v - std::sin(bestAngle) * u);
}

/// Returns right-handed axes, the last one along `direction`, which may have any length above 0.
Mat3d axesWith(Vec3d direction)
{
    direction /= openvdb::math::Abs(direction)[openvdb::math::MaxIndex(openvdb::math::Abs(direction))];
    direction.normalize();
    const auto least = static_cast<int>(openvdb::math::MinIndex(openvdb::math::Abs(direction)));
    Vec3d other(0, 0, 0);
    other[least] = 1;
    Vec3d u = other.cross(direction);
    u.normalize();
    Mat3d axes;
    axes.setRow(0, u);
    axes.setRow(1, direction.cross(u));
    axes.setRow(2, direction);
    return axes;
}

} // namespace

AlignedAxes alignedAxes(const Mesh& model, std::optional<int> kept, Interrupter* interrupter)
{
    constexpr std::size_t mostStarts = 16;
    constexpr int rounds = 10;
    constexpr double converged = 1 - 1e-9, better = 1 - 1e-6;
    std::vector<Vec3d> vectors = areaVectors(model, interrupter);
    std::stable_sort(vectors.begin(), vectors.end(),
                     [](const Vec3d& a, const Vec3d& b) { return a.lengthSqr() > b.lengthSqr(); });
    const AlignedAxes world;
    const double worldArea = projectedArea(world.rows, vectors);
    std::vector<Mat3d> starts{world.rows};
    if (!kept) {
        for (std::size_t i = 0; i < std::min(mostStarts, vectors.size()); ++i) starts.push_back(axesWith(vectors[i]));
    }
    AlignedAxes best = world;
    for (Mat3d axes : starts) {
        throwIfInterrupted(interrupter);
        double area = projectedArea(axes, vectors);
        for (int round = 0; round < rounds; ++round) {
            for (const int third : {0, 1, 2}) {
                if (!kept || third == *kept) turnAbout(third, vectors, axes);
            }
            const double before = area;
            area = projectedArea(axes, vectors);
            if (!(area < before * converged)) break;
        }
        const double share = area / worldArea;
        if (share < best.share * better) best = {axes, share};
    }
    return best;
}

} // namespace vdbcage::detail
