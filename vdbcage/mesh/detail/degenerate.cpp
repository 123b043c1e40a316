#include <vdbcage/mesh/detail/degenerate.h>

#include <cmath>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace vdbcage::detail {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Returns whether the 2x2 determinant ux vy - uy vx of rounded differences is certainly not zero. Each product has
/// three roundings and the difference one more: an error below 5 * 2^-53 times the sum of the products' sizes, plus the
/// loss by underflow (below 1e-320). The bounds below are wider than both, and infinite or NaN after an overflow.
bool certainlyNonzero(double ux, double uy, double vx, double vy)
{
    const double first = ux * vy;
    const double second = uy * vx;
    const double size = std::abs(first) + std::abs(second);
    return std::abs(first - second) > 1e-15 * size + 1e-300;
}

} // namespace

bool isDegenerate(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& c)
{
    // The points are on a line if and only if their projections on all three coordinate planes are.
    const openvdb::Vec3d u = b - a;
    const openvdb::Vec3d v = c - a;
    if (certainlyNonzero(u.x(), u.y(), v.x(), v.y())) return false;
    if (certainlyNonzero(u.y(), u.z(), v.y(), v.z())) return false;
    if (certainlyNonzero(u.z(), u.x(), v.z(), v.x())) return false;
    return CGAL::collinear(Kernel::Point_3(a.x(), a.y(), a.z()), Kernel::Point_3(b.x(), b.y(), b.z()),
                           Kernel::Point_3(c.x(), c.y(), c.z()));
}

bool isDegenerate(const Mesh& mesh, const openvdb::Vec3I& triangle)
{
    return isDegenerate(mesh.points[triangle[0]], mesh.points[triangle[1]], mesh.points[triangle[2]]);
}

} // namespace vdbcage::detail
