#pragma once

#include <cstddef>

#include <boost/container/small_vector.hpp>
#include <vdbcage/mesh/detail/triangle_tree.h>

/// How the triangles of one surface touch each other, decided exactly.
namespace vdbcage::detail {

/// The plane of a triangle, to tell sides without exact arithmetic where that is safe.
class Plane {
public:
    explicit Plane(const Corners& t) : corner_(t[0])
    {
        const Vec3d u = t[1] - t[0], v = t[2] - t[0];
        normal_ = u.cross(v);
        error2_ = 1e-28 * u.lengthSqr() * v.lengthSqr();
    }
    /// -1, 0, 1: on which side p lies; 0 where rounding could decide.
    int side(const Vec3d& p) const
    {
        const Vec3d w = p - corner_;
        const double volume = normal_.dot(w);
        if (!(volume * volume > error2_ * w.lengthSqr())) return 0;
        return volume > 0 ? 1 : -1;
    }

    /// Twice the area long.
    const Vec3d& normal() const { return normal_; }

private:
    Vec3d corner_, normal_;
    double error2_;
};

/// A triangle of a surface.
struct Facet {
    Vec3I ids;
    Corners corners;
    Plane plane;

    Facet(const Vec3I& vertices, const Corners& places) : ids(vertices), corners(places), plane(places) {}
    const Vec3d& corner(int i) const { return corners[static_cast<std::size_t>(i % 3)]; }
};

using Facets = boost::container::small_vector<Facet, 16>;

/// Whether a triangle has no area, exactly.
bool hasNoArea(const Corners& t);

/// The sine of the smallest angle of a triangle; 0 for one without an area. Rounded.
double minSine(const Corners& t);

/// Whether two triangles of a surface meet in more than the vertices that they share. Exact.
bool meetBeyondShared(const Facet& a, const Facet& b);

/// Whether, seen along some direction, a fan lies spread out around its centre, corner 0 of all, without overlap: then
/// no two of its triangles can meet beyond what they share. No answer but false where rounding could matter.
bool spreadOut(const Facets& fan);

} // namespace vdbcage::detail
