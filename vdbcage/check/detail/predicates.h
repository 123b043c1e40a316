#pragma once

#include <cstdint>
#include <vector>

#include <openvdb/Types.h>
#include <vdbcage/geometry/triangle_bvh.h>

/// Exact answers about triangles with the coordinates given (any finite doubles). All sets are closed: a touch counts.
namespace vdbcage::detail {

/// The three corners lie on a line (or are one point).
bool isDegenerate(const Corners& triangle);

/// The two triangles, degenerate or not, have a point in common.
bool trianglesMeet(const Corners& s, const Corners& t);

/// Triangles that are not degenerate and have their corners s[0] = t[0] in common: they share another point too.
bool meetBeyondCorner(const Corners& s, const Corners& t);

/// Triangles a, b, c and a, b, d, not degenerate: they share more than the edge a, b. That is, they lie in one plane
/// and on the same side of the edge.
bool foldOver(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// The triangle, degenerate or not, contains `p`.
bool contains(const Corners& triangle, const Vec3d& p);

/// What a triangle adds to the winding number, around p, of the surface that it belongs to: +1 if the ray from p along
/// +x leaves through its back, -1 if it comes in through its front, 0 if it misses. The ray is moved by an
/// infinitesimal amount so that it meets no edge; hence over all triangles of a surface without boundary the sum is the
/// winding number, if p does not lie on one of them. 0 for a degenerate triangle.
int rayCrossing(const Corners& triangle, const Vec3d& p);

/// Positive, zero or negative as d lies above (a, b, c counter-clockwise), in or below the plane of a, b, c.
int sideOfPlane(const Vec3d& a, const Vec3d& b, const Vec3d& c, const Vec3d& d);

/// The sign of the volume within triangles that together have no boundary.
int volumeSign(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles);

} // namespace vdbcage::detail
