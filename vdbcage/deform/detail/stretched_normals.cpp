#include <vdbcage/deform/detail/stretched_normals.h>

#include <cmath>

#include <vdbcage/core/detail/longest_side.h>

namespace vdbcage::detail {

using openvdb::Vec3d;

namespace {

/// Returns the normal of the parallelogram of two edges `a` and `b`, counter-clockwise, that became `posedA` and
/// `posedB`.
Vec3d stretchedNormal(const Vec3d& a, const Vec3d& b, const Vec3d& posedA, const Vec3d& posedB)
{
    const Vec3d normal = posedA.cross(posedB);
    const double length = normal.length();
    if (!(length > 0)) return Vec3d(0);
    // The norm of the matrix posedA b^T - posedB a^T. It does not cancel for slivers, unlike its expansion.
    double square = 0;
    for (int i = 0; i < 3; ++i) square += (posedA[i] * b - posedB[i] * a).lengthSqr();
    return std::sqrt(0.5 * square) / length * normal;
}

} // namespace

void addStretchedNormals(const Mesh& cage, const std::vector<Vec3d>& posed, const std::vector<openvdb::Vec3I>& corners,
                         std::vector<Vec3d>& handles)
{
    const double size = longestSide(boundingBox(cage));
    for (const openvdb::Vec3I& corner : corners) {
        const auto edge = [&](const std::vector<Vec3d>& points, int to) {
            return points[corner[to]] / size - points[corner[0]] / size;
        };
        handles.push_back(size *
                          stretchedNormal(edge(cage.points, 1), edge(cage.points, 2), edge(posed, 1), edge(posed, 2)));
    }
}

void addNormalReach(const Mesh& cage, const std::vector<openvdb::Vec3I>& corners, std::vector<float>& reach)
{
    const double size = longestSide(boundingBox(cage));
    for (const openvdb::Vec3I& corner : corners) {
        const auto edge = [&](int to) {
            return (cage.points[corner[to]] / size - cage.points[corner[0]] / size).length();
        };
        // Not less than the edges' product, and not zero if one of them is not.
        const double mean = 0.5 * (edge(1) + edge(2));
        reach.push_back(static_cast<float>(mean * mean));
    }
}

} // namespace vdbcage::detail
