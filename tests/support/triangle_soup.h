#pragma once

#include <cstdint>
#include <vector>

#include <vdbcage/geometry/triangle_bvh.h>

namespace vdbcage::test {

/// Triangles in the form that trees take.
struct TriangleSoup {
    std::vector<openvdb::Vec3d> points;
    std::vector<openvdb::Vec3I> triangles;

    /// Adds a triangle with three points of its own.
    void add(const detail::Corners& corners)
    {
        const auto first = static_cast<std::uint32_t>(points.size());
        points.insert(points.end(), corners.begin(), corners.end());
        triangles.emplace_back(first, first + 1, first + 2);
    }
    detail::Corners corners(std::size_t t) const
    {
        return {points[triangles[t][0]], points[triangles[t][1]], points[triangles[t][2]]};
    }
};

} // namespace vdbcage::test
