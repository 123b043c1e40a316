#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <vdbcage/core/interrupter.h>
#include <vdbcage/geometry/bvh_space.h>
#include <vdbcage/geometry/floats.h>
#include <vdbcage/geometry/triangle.h>

namespace vdbcage::detail {

/// Returns a box of floats around a box in the tree's units.
inline FloatBox roundedOutward(const Box& box)
{
    return {Floats{roundedDown(box.lo[0]), roundedDown(box.lo[1]), roundedDown(box.lo[2]), 0},
            Floats{roundedUp(box.hi[0]), roundedUp(box.hi[1]), roundedUp(box.hi[2]), 0}};
}

/// The triangles from which a tree is built, in the tree's units.
class BvhTriangles {
public:
    /// Refers to both lists, which must outlive it.
    /// \pre there are triangles
    /// \throw Cancelled
    BvhTriangles(const std::vector<Vec3d>& points, const std::vector<Vec3I>& triangles, Interrupter* interrupter);

    std::size_t size() const { return triangles_.size(); }
    const Vec3I& operator[](std::size_t triangle) const { return triangles_[triangle]; }
    /// Returns the box of everything.
    const Box& box() const { return box_; }
    const BvhUnits& units() const { return units_; }

    Corners corners(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }
    Corners cornersInUnits(std::size_t triangle) const
    {
        const Vec3I& t = triangles_[triangle];
        return {units_.of(points_[t[0]]), units_.of(points_[t[1]]), units_.of(points_[t[2]])};
    }
    /// Returns the box, along other axes, of triangles that follow each other.
    FloatBox boxAlong(const BvhFrame& frame, std::uint32_t first, std::uint32_t count) const;

private:
    Box boxOfAll(Interrupter* interrupter) const;

    const std::vector<Vec3d>& points_;
    const std::vector<Vec3I>& triangles_;
    Box box_;
    BvhUnits units_;
};

} // namespace vdbcage::detail
