#include <vdbcage/bounding/detail/corner_shape.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <vdbcage/geometry/quad_shape.h>

namespace vdbcage::detail {

double CornerShape::add(const GuardedMesh& surface, const StarChange& star, const Vec3d& centre,
                        Quadratic& change) const
{
    double sum = 0;
    const auto pointOf = [&](std::uint32_t v) { return v == star.centre ? centre : surface.point(v); };
    // The corner at `at` between the ways to `one` and `other`.
    const auto addCorner = [&](std::uint32_t at, std::uint32_t one, std::uint32_t other) {
        const Vec3d p = pointOf(at);
        Vec3d u = pointOf(one) - p, w = pointOf(other) - p;
        const double lengthU = u.length(), lengthW = w.length();
        if (!(lengthU > 0 && lengthW > 0)) return;
        u /= lengthU;
        w /= lengthW;
        const double cosine = u.dot(w), beyond = std::abs(cosine) - free_;
        if (!(beyond > 0)) return;
        sum += weight_ * beyond * beyond;
        const Vec3d ofOne = (w - cosine * u) / lengthU, ofOther = (u - cosine * w) / lengthW;
        Vec3d slope = at == star.centre ? -(ofOne + ofOther) : one == star.centre ? ofOne : ofOther;
        if (star.onPlane) slope[surface.guard().symmetry()->axis] = 0;
        const double side = cosine > 0 ? 1 : -1;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) change.curvature[i][j] += 2 * weight_ * slope[i] * slope[j];
            change.slope[i] += 2 * weight_ * beyond * side * slope[i];
        }
    };
    for (const std::uint32_t q : table_.quadsOf(star.centre)) {
        const Vec4I& ids = table_.corners(q);
        int i = 0;
        while (ids[i] != star.centre) ++i;
        const std::uint32_t next = ids[(i + 1) % 4], across = ids[(i + 2) % 4], last = ids[(i + 3) % 4];
        addCorner(star.centre, next, last);
        addCorner(next, star.centre, across);
        addCorner(last, star.centre, across);
    }
    return sum;
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
