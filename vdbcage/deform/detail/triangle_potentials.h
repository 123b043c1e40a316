#pragma once

#include <array>

#include <openvdb/Types.h>
#include <vdbcage/core/detail/pi.h>

namespace vdbcage::detail {

/// The terms of the closed forms of integrals over a triangle, seen from the origin: see Wilton and others, "Potential
/// Integrals for Uniform and Linear Source Distributions on Polygonal and Polyhedral Domains", 1984.
///
/// Edge i begins at corner i.
struct TrianglePotentials {
    openvdb::Vec3d normal;               ///< of length 1
    double area;                         ///< twice the triangle's
    double height;                       ///< of its plane above the origin, along the normal
    double solid;                        ///< the solid angle, with the sign of the height
    std::array<double, 3> hatSolid;      ///< the solid angle by each corner's barycentric coordinate
    double single;                       ///< the integral of 1 / distance
    std::array<double, 3> edge;          ///< of 1 / distance along the edge; 0 where it would be infinite
    std::array<openvdb::Vec3d, 3> along; ///< the edges' directions, of length 1
    std::array<double, 3> foot;          ///< from the origin's foot on the plane to the edge's line, outward

    /// Returns the edge's outward direction in the plane, of length 1.
    openvdb::Vec3d outward(std::size_t i) const { return along[i].cross(normal); }
};

/// Computes the potentials. `corners` are counter-clockwise, and not in line. `onFace`: the origin lies on the
/// triangle, whose solid angle and height are then left out.
TrianglePotentials trianglePotentials(const std::array<openvdb::Vec3d, 3>& corners, bool onFace);

/// The solid angle of all directions.
constexpr double fourPi = 4 * pi;

/// The width of a triangle over its longest side below which closed forms lose too many digits.
constexpr double sliverWidth = 1e-7;

/// Returns whether the triangle of the sides `a` and `b` is that narrow.
bool isSliver(const openvdb::Vec3d& a, const openvdb::Vec3d& b);

/// Returns half the solid angle of the triangle that has these corners, seen from the origin: van Oosterom, Strackee
/// 1983. `determinant` is that of the corners; the angle has its sign.
double halfSolidAngle(const openvdb::Vec3d& a, const openvdb::Vec3d& b, const openvdb::Vec3d& c, double determinant);

} // namespace vdbcage::detail
