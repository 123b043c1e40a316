#include <vdbcage/check/detail/measures.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/core/detail/asker.h>
#include <vdbcage/core/detail/parallel.h>
#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

namespace {

double area(const std::vector<Vec3d>& points, const Vec3I& t)
{
    return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]).length();
}

// Returns the k-th point of a sequence that fills the triangle evenly: the plastic number's lattice (Roberts, 2018),
// folded from the square onto the triangle.
Vec3d pointWithin(const std::vector<Vec3d>& points, const Vec3I& t, std::size_t k)
{
    const double n = static_cast<double>(k);
    double u = 0.5 + n * 0.7548776662466927, v = 0.5 + n * 0.5698402909980532;
    u -= std::floor(u);
    v -= std::floor(v);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const Vec3d& a = points[t[0]];
    return a + u * (points[t[1]] - a) + v * (points[t[2]] - a);
}

// Systematic sampling: equal shares of area with a sample in the middle of each, so that every triangle gets its share
// to within one sample. Samples come one by one: a caller that wants very many need not hold them.
class EvenSamples {
public:
    EvenSamples(const std::vector<Vec3d>& points, const FaceTriangles& faces, std::size_t count,
                Interrupter* interrupter)
        : points_(points), faces_(faces), count_(count)
    {
        Asker ask(interrupter);
        double total = 0;
        for (std::size_t t = 0; t < faces.size(); ++t) {
            ask();
            total += area(points, faces[t]) * (faces.ofQuad(t) ? 0.5 : 1.0);
            areaUpTo_.push_back(total);
        }
        if (!(total > 0) || !std::isfinite(total)) count_ = 0;
    }

    std::size_t count() const { return count_; }

    Vec3d next()
    {
        const double target = (static_cast<double>(index_++) + 0.5) / static_cast<double>(count_) * areaUpTo_.back();
        while (triangle_ + 1 < faces_.size() && areaUpTo_[triangle_] < target) {
            ++triangle_;
            within_ = 0;
        }
        return pointWithin(points_, faces_[triangle_], within_++);
    }

private:
    const std::vector<Vec3d>& points_;
    const FaceTriangles& faces_;
    std::size_t count_;
    std::vector<double> areaUpTo_;
    std::size_t index_ = 0, triangle_ = 0, within_ = 0; // of the next sample
};

std::vector<double> distancesOf(const std::vector<Vec3d>& from, const TriangleBvh& tree, Interrupter* interrupter)
{
    std::vector<double> result(from.size());
    // Blocks of fixed size: each result is the next one's seed, and a seed may change the last bit.
    constexpr std::size_t block = 64;
    parallelFor(std::size_t(0), (from.size() + block - 1) / block, [&](std::size_t b) {
        throwIfInterrupted(interrupter);
        std::uint32_t seed = TriangleBvh::none;
        for (std::size_t i = b * block; i < std::min(from.size(), (b + 1) * block); ++i) {
            const TriangleBvh::Closest closest = tree.closest(from[i], seed);
            seed = closest.item;
            result[i] = std::sqrt(closest.squaredDistance);
        }
    });
    return result;
}

// Returns the points that faces use, in order.
std::vector<Vec3d> usedPoints(const std::vector<Vec3d>& points, const FaceTriangles& faces)
{
    std::vector<char> used(points.size(), 0);
    for (const Vec3I& t : faces.triangles()) used[t[0]] = used[t[1]] = used[t[2]] = 1;
    std::vector<Vec3d> result;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (used[i]) result.push_back(points[i]);
    }
    return result;
}

double angleDegrees(const Vec3d& at, const Vec3d& b, const Vec3d& c)
{
    Vec3d u = b - at, v = c - at;
    u.normalize(); // leaves a zero vector unchanged
    v.normalize();
    return std::atan2(u.cross(v).length(), u.dot(v)) * (180 / pi);
}

} // namespace

double volume(const std::vector<Vec3d>& points, const FaceTriangles& faces)
{
    if (faces.size() == 0) return 0;
    const Vec3d origin = points[faces[0][0]];
    double sum = 0;
    for (std::size_t t = 0; t < faces.size(); ++t) {
        const Vec3I& corners = faces[t];
        const Vec3d a = points[corners[0]] - origin, b = points[corners[1]] - origin, c = points[corners[2]] - origin;
        sum += a.dot(b.cross(c)) * (faces.ofQuad(t) ? 0.5 : 1.0);
    }
    return sum / 6;
}

Angles angles(const std::vector<Vec3d>& points, const FaceTriangles& faces, Interrupter* interrupter)
{
    if (faces.size() == 0) return {};
    std::vector<double> all;
    all.reserve(3 * faces.size());
    Asker ask(interrupter);
    for (const Vec3I& t : faces.triangles()) {
        ask();
        for (int i = 0; i < 3; ++i) {
            all.push_back(angleDegrees(points[t[i]], points[t[(i + 1) % 3]], points[t[(i + 2) % 3]]));
        }
    }
    const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
    std::nth_element(all.begin(), middle, all.end());
    const double median = *middle;
    const auto percentile = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 100);
    std::nth_element(all.begin(), percentile, middle + 1);
    return {*std::min_element(all.begin(), percentile + 1), *percentile, median};
}

Distances distances(const std::vector<Vec3d>& points, const FaceTriangles& faces, const TriangleBvh& tree,
                    std::size_t samples, Interrupter* interrupter)
{
    if (faces.size() == 0) return {};
    const std::vector<double> corners = distancesOf(usedPoints(points, faces), tree, interrupter);
    Distances result;
    const auto [least, most] = std::minmax_element(corners.begin(), corners.end());
    result.least = *least;
    result.most = *most;
    constexpr std::size_t mostAtATime = 1U << 16; // a multiple of the blocks of distancesOf
    EvenSamples even(points, faces, samples, interrupter);
    for (std::size_t left = even.count(); left > 0;) {
        std::vector<Vec3d> some(std::min(left, mostAtATime));
        for (Vec3d& p : some) p = even.next();
        for (const double distance : distancesOf(some, tree, interrupter)) {
            result.mean += distance;
            result.least = std::min(result.least, distance);
            result.most = std::max(result.most, distance);
        }
        left -= some.size();
    }
    if (even.count() > 0) result.mean /= static_cast<double>(even.count());
    return result;
}

} // namespace vdbcage::detail
