#include <vdbcage/geometry/quad_shape.h>

#include <algorithm>
#include <cmath>

#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

double angleDegrees(const Vec3d& a, const Vec3d& b)
{
    constexpr double degrees = 180 / pi;
    return std::atan2(a.cross(b).length(), a.dot(b)) * degrees;
}

bool isConvexQuad(const std::array<Vec3d, 4>& corners, double leastCosine, double& largestDeviation)
{
    constexpr double largestCornerDegrees = 160;
    std::array<Vec3d, 4> normals; // of the triangle at each corner: two for each diagonal
    Vec3d mean(0.0);
    largestDeviation = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d next = corners[(i + 1) % 4] - corners[i], previous = corners[(i + 3) % 4] - corners[i];
        normals[i] = next.cross(previous);
        const double corner = angleDegrees(next, previous);
        if (corner > largestCornerDegrees) return false;
        largestDeviation = std::max(largestDeviation, std::abs(corner - 90));
        if (!normals[i].normalize(0)) return false;
        mean += normals[i];
    }
    return std::all_of(normals.begin(), normals.end(), [&](const Vec3d& normal) { return normal.dot(mean) > 0; }) &&
           normals[0].dot(normals[2]) > leastCosine && normals[1].dot(normals[3]) > leastCosine;
}

} // namespace vdbcage::detail
