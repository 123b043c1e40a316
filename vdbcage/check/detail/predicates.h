#pragma once

#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/triangle.h>

/// Exact predicates of triangles with any finite doubles as coordinates. All sets are closed: a touch counts.
namespace vdbcage::detail {

/// Returns whether the three corners lie on a line, or are one point.
bool isDegenerate(const Corners& triangle);

/// Returns whether the two triangles, degenerate or not, have a point in common.
bool trianglesMeet(const Corners& s, const Corners& t);

/// Returns whether the two triangles share another point than their common corner.
/// \pre s[0] == t[0]; neither is degenerate
bool meetBeyondCorner(const Corners& s, const Corners& t);

/// Returns whether the triangles a, b, c and a, b, d share more than the edge a, b: they lie in one plane and on the
/// same side of the edge. \pre neither is degenerate
bool foldOver(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// Returns whether the triangle, degenerate or not, contains `p`.
bool contains(const Corners& triangle, const Vec3d& p);

/// Returns the share of a triangle in the winding number of its surface around p.
///
/// It is +1 if the ray from p along +x leaves through the triangle's back, and -1 if it enters through its front. It is
/// 0 if the ray misses the triangle, and for a degenerate one. The ray is moved by an infinitesimal amount so that it
/// meets no edge. The sum over all triangles of a surface is the winding number.
/// \pre for the sum: the surface has no boundary, and p does not lie on it
int rayCrossing(const Corners& triangle, const Vec3d& p);

/// Returns a positive number, 0 or a negative one as d lies above (a, b, c counter-clockwise), in or below the plane of
/// a, b, c.
int sideOfPlane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// Returns the sign of the volume within the triangles.
/// \pre together they have no boundary
/// \throw Cancelled
int volumeSign(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Interrupter* interrupter);

} // namespace vdbcage::detail
