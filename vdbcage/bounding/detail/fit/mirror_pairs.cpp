#include <vdbcage/bounding/detail/fit/mirror_pairs.h>

#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include <vdbcage/bounding/detail/guard/guard_model.h>
#include <vdbcage/core/error.h>

namespace vdbcage::detail {

std::vector<std::uint32_t> mirrorPairs(const std::vector<Vec3d>& points, const std::vector<std::uint32_t>& vertices,
                                       const SymmetryPlane& plane, double tolerance)
{
    using Cell = std::array<std::int64_t, 3>;
    constexpr std::uint32_t none = ~std::uint32_t(0);
    const auto cellOf = [&](const Vec3d& p) {
        Cell cell{};
        for (const std::size_t i : {0U, 1U, 2U})
            cell[i] = static_cast<std::int64_t>(std::floor(p[static_cast<int>(i)] / tolerance));
        return cell;
    };
    std::map<Cell, std::vector<std::uint32_t>> cells;
    for (const std::uint32_t v : vertices) cells[cellOf(points[v])].push_back(v);
    std::vector<std::uint32_t> pairs(points.size());
    std::iota(pairs.begin(), pairs.end(), 0U);
    for (const std::uint32_t v : vertices) {
        const Vec3d image = mirrored(plane, points[v]);
        const Cell middle = cellOf(image);
        double least = tolerance;
        pairs[v] = none;
        for (int k = 0; k < 27; ++k) {
            const auto found = cells.find({middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
            if (found == cells.end()) continue;
            for (const std::uint32_t w : found->second) {
                const double distance = (points[w] - image).length();
                if (distance > least) continue;
                least = distance;
                pairs[v] = w;
            }
        }
    }
    for (const std::uint32_t v : vertices) {
        if (pairs[v] == none || pairs[pairs[v]] != v) {
            throw InputError("cage",
                             "it is not symmetric: point " + std::to_string(v) + " has no mirror image of its own");
        }
    }
    return pairs;
}

} // namespace vdbcage::detail
